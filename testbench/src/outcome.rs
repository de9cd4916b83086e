//! Outcome of a run: everything equal, the first difference, or a model that hangs.

use std::fmt;
use wheatstone_golden::interface::{Direction, Field};

/// Result of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
#[must_use]
pub enum Outcome {
    /// All beats were compared and equal, none was missing and none too many.
    Passed(Counts),
    /// The first difference.
    Mismatch(Box<Mismatch>),
    /// No stream moved although there was work left.
    Hung(Box<Hung>),
}

impl Outcome {
    /// The counts, if the run passed.
    pub fn passed(&self) -> Option<&Counts> {
        match self {
            Outcome::Passed(counts) => Some(counts),
            _ => None,
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Outcome::Passed(counts) => write!(f, "passed: {} clocks", counts.clocks),
            Outcome::Mismatch(mismatch) => mismatch.fmt(f),
            Outcome::Hung(hung) => hung.fmt(f),
        }
    }
}

/// Counts of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Clocks from the start of the run to the last handshake, both included.
    pub clocks: u64,
    /// Clocks simulated, with the quiet ones at the end.
    pub simulated: u64,
    /// The module's streams, in the order of its interface.
    pub streams: Vec<StreamCount>,
    /// Beats compared on the streams of probes.
    pub probed: u64,
}

impl Counts {
    /// The counts of the stream of that name.
    pub fn stream(&self, name: &str) -> Option<&StreamCount> {
        self.streams.iter().find(|stream| stream.name == name)
    }

    /// Beats of all outputs.
    pub fn compared(&self) -> u64 {
        let outputs = self.streams.iter().filter(|s| s.direction == Direction::Output);
        outputs.map(|s| s.accepted).sum()
    }

    /// Adds the counts of a later run of the same model.
    pub fn add(&mut self, later: &Counts) {
        self.clocks += later.clocks;
        self.simulated += later.simulated;
        self.probed += later.probed;
        if self.streams.is_empty() {
            self.streams.clone_from(&later.streams);
            return;
        }
        for (sum, stream) in self.streams.iter_mut().zip(&later.streams) {
            sum.accepted += stream.accepted;
            sum.stalled += stream.stalled;
            sum.idle += stream.idle;
            sum.active += stream.active;
            sum.first = sum.first.or(stream.first);
            sum.last = stream.last.or(sum.last);
        }
    }
}

/// Counts of one stream.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StreamCount {
    /// Name of the stream.
    pub name: &'static str,
    /// Seen from the module.
    pub direction: Direction,
    /// Clocks on which a beat was taken.
    pub accepted: u64,
    /// Clocks on which a beat waited.
    pub stalled: u64,
    /// Clocks, up to the run's last handshake, without a beat.
    pub idle: u64,
    /// Clocks from the start of the run to the stream's last beat, both included.
    pub active: u64,
    /// Cycle of the first beat.
    pub first: Option<u64>,
    /// Cycle of the last beat.
    pub last: Option<u64>,
}

impl StreamCount {
    /// The share of its active clocks on which the stream moved: its throughput.
    pub fn throughput(&self) -> f64 {
        if self.active == 0 {
            1.0
        } else {
            self.accepted as f64 / self.active as f64
        }
    }
}

/// A stream, of the module itself or of a unit inside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The instance of the unit, if it is not the module itself.
    pub instance: Option<String>,
    /// The stream, or the flag.
    pub stream: &'static str,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.instance {
            Some(instance) => write!(f, "{instance}.{}", self.stream),
            None => write!(f, "{}", self.stream),
        }
    }
}

/// A kind of difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A beat has other fields than expected.
    Value,
    /// A beat that waited changed before it was taken.
    Unstable,
    /// A beat that waited was taken back.
    Withdrawn,
    /// A beat came after the last one expected.
    Surplus,
    /// A beat never came, although the module's outputs are complete: only of probes.
    Missing,
    /// A flag has another value than expected when all is done.
    Flag,
    /// The model stopped: `$finish`, a failed assertion or a fatal error.
    Stopped(String),
}

/// A field that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The field.
    pub field: Field,
    /// Bits expected; before, where a beat was unstable.
    pub expected: u64,
    /// Bits found.
    pub actual: u64,
}

impl Difference {
    /// The fields in which two rows differ.
    pub(crate) fn all(fields: &[Field], expected: &[u64], actual: &[u64]) -> Vec<Difference> {
        let values = expected.iter().zip(actual);
        fields
            .iter()
            .zip(values)
            .filter(|(_, (expected, actual))| expected != actual)
            .map(|(field, (&expected, &actual))| Difference {
                field: field.clone(),
                expected,
                actual,
            })
            .collect()
    }

    /// All of them in a line.
    pub(crate) fn list(differences: &[Difference]) -> String {
        differences.iter().map(Difference::to_string).collect::<Vec<_>>().join("; ")
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference { field, expected, actual } = self;
        let (expected, actual) = (field.display(*expected), field.display(*actual));
        write!(f, "{} expected {expected}, got {actual}", field.name)
    }
}

/// The first difference of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// Kind of the difference.
    pub fault: Fault,
    /// Its place.
    pub place: Place,
    /// Number of the beat in its stream, from 0, counted from the start of the run.
    pub beat: u64,
    /// Cycle, counted from the first after the reset; [`crate::TraceWindow`] counts so too.
    pub cycle: u64,
    /// The fields that differ.
    pub differences: Vec<Difference>,
    /// All fields of the beat expected; empty where none was.
    pub expected: Vec<u64>,
    /// All fields of the beat found.
    pub actual: Vec<u64>,
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Mismatch { place, beat, cycle, .. } = self;
        match &self.fault {
            Fault::Value => write!(f, "{place}, beat {beat}, cycle {cycle}: ")?,
            Fault::Unstable => {
                write!(f, "{place}, beat {beat} changed while it waited, cycle {cycle}: ")?
            }
            Fault::Withdrawn => {
                write!(f, "{place}, beat {beat} was taken back while it waited, cycle {cycle}")?
            }
            Fault::Surplus => write!(f, "{place}, beat {beat} is one too many, cycle {cycle}")?,
            Fault::Missing => write!(f, "{place}, beat {beat} never came, cycle {cycle}")?,
            Fault::Flag => write!(f, "flag at the end, cycle {cycle}: ")?,
            Fault::Stopped(why) => write!(f, "the model stopped, cycle {cycle}: {why}")?,
        }
        write!(f, "{}", Difference::list(&self.differences))
    }
}

/// A model on which nothing moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hung {
    /// Cycle in which the watchdog gave up.
    pub cycle: u64,
    /// Clocks since the last handshake.
    pub waited: u64,
    /// The module's streams, then those of the probes.
    pub streams: Vec<StreamState>,
}

/// The state of a stream when the watchdog gave up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StreamState {
    /// The stream.
    pub place: Place,
    /// Seen from the module.
    pub direction: Direction,
    /// Beats taken.
    pub done: u64,
    /// Beats that there are in all, where it is known.
    pub total: Option<u64>,
    /// Signal `valid`.
    pub valid: bool,
    /// Signal `ready`.
    pub ready: bool,
}

impl fmt::Display for Hung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "nothing moved for {} clocks, cycle {}:", self.waited, self.cycle)?;
        for (number, stream) in self.streams.iter().enumerate() {
            let StreamState { place, done, valid, ready, .. } = stream;
            write!(f, "{} {place} {done}", if number > 0 { "," } else { "" })?;
            if let Some(total) = stream.total {
                write!(f, "/{total}")?;
            }
            write!(f, " (valid {}, ready {})", u8::from(*valid), u8::from(*ready))?;
        }
        Ok(())
    }
}
