//! The first-mismatch report.

use super::run::{Ran, Setting};
use crate::memory::MemoryFault;
use crate::numbers::counted;
use crate::shell::{command_line, operand};
use crate::{Difference, Fault, Library, Mismatch, Outcome, Place, Probe};
use serde::Serialize;
use std::ffi::OsStr;
use std::fmt;
use std::path::PathBuf;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::interface::{Beat, Direction};
use wheatstone_golden::pipeline::observer::Unit;
use wheatstone_golden::pipeline::{Mode, Op, Pixel, PrimaryBeat, Request, Setup};
use wheatstone_golden::record::Recording;
use wheatstone_golden::targets::{unit_of, Target};
use wheatstone_golden::text::printable_path;

/// A pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Location {
    /// Whose view.
    #[serde(serialize_with = "eye_name")]
    pub eye: Eye,
    /// Display column.
    pub x: u32,
    /// Display row.
    pub y: u32,
}

fn eye_name<S: serde::Serializer>(eye: &Eye, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(eye.name())
}

/// The first difference of a case, ready to be told.
#[derive(Clone, Debug, Serialize)]
pub struct Failure {
    /// Unit or system that was run.
    pub target: &'static str,
    /// The case.
    pub case: String,
    /// The difference, in a sentence.
    pub what: String,
    /// The pixel, where one is concerned.
    pub pixel: Option<Location>,
    /// Id of the polygon being drawn, in a scene.
    pub polygon: Option<u32>,
    /// The field that differs first.
    pub field: Option<String>,
    /// Its value in the golden model.
    pub expected: Option<String>,
    /// Its value in the Verilog.
    pub actual: Option<String>,
    /// The earliest unit that differs.
    pub unit: String,
    /// The stream in which it shows.
    pub stream: Option<String>,
    /// Cycle after the reset.
    pub cycle: Option<u64>,
    /// Seed.
    pub seed: u64,
    /// Idle and back-pressure pattern.
    pub stalls: [&'static str; 2],
    /// Command that repeats the case.
    pub repeat: String,
    /// Waveforms around the cycle.
    pub waves: Option<PathBuf>,
    /// The reason why there are none.
    pub waves_error: Option<String>,
}

impl Failure {
    /// The report of a run that failed; `repeat` is the command that repeats it.
    pub(super) fn new(
        target: Target,
        case: &str,
        setting: &Setting,
        repeat: String,
        ran: &Ran,
    ) -> Failure {
        let target = target.name();
        let Setting { library, seed, stalls, .. } = *setting;
        let mut failure = Failure {
            target,
            case: case.into(),
            what: ran.outcome.to_string(),
            pixel: None,
            polygon: None,
            field: None,
            expected: None,
            actual: None,
            unit: target.into(),
            stream: None,
            cycle: None,
            seed,
            stalls: [stalls.idle.name(), stalls.back_pressure.name()],
            repeat,
            waves: None,
            waves_error: None,
        };
        match &ran.outcome {
            Outcome::Mismatch(mismatch) => {
                failure.mismatch(mismatch, ran.recording.as_deref());
                // What comes into a unit wrong is not the unit's fault.
                if goes_in(library, &mismatch.place) {
                    failure.unit = target.into();
                }
            }
            Outcome::Hung(hung) => failure.cycle = Some(hung.cycle),
            Outcome::Passed(_) => {}
        }
        // All pixels before the first mismatch were right, so a stale read is its cause; a wrong
        // frame buffer is its consequence.
        let fault = match &ran.outcome {
            Outcome::Passed(_) => ran.memory.first(),
            _ => ran.memory.iter().find(|fault| matches!(fault, MemoryFault::Stale { .. })),
        };
        if let Some(fault) = fault {
            failure.memory(fault);
        }
        failure
    }

    fn mismatch(&mut self, mismatch: &Mismatch, recording: Option<&Recording>) {
        self.cycle = Some(mismatch.cycle);
        self.stream = Some(mismatch.place.stream.into());
        if let Some(instance) = &mismatch.place.instance {
            let name = instance.split('.').next_back().unwrap_or(instance);
            self.unit = name.strip_prefix("u_").unwrap_or(name).into();
        }
        self.difference(&mismatch.differences);
        if mismatch.fault == Fault::Flag {
            return;
        }
        self.pixel = match (mismatch.place.stream, &mismatch.place.instance) {
            ("left" | "right", None) if !mismatch.expected.is_empty() => {
                let pixel = Pixel::read(&mismatch.expected);
                Some(location(pixel.eye, pixel.x, pixel.y))
            }
            ("request", None) if !mismatch.expected.is_empty() => {
                let request = Request::read(&mismatch.expected);
                Some(location(request.eye, request.x, request.y))
            }
            (_, Some(instance)) => recording.and_then(|r| locate(r, instance, mismatch.beat, self)),
            _ => None,
        };
    }

    fn memory(&mut self, fault: &MemoryFault) {
        let differences = fault.differences();
        let list = Difference::list(&differences);
        match fault {
            MemoryFault::Stale { read, .. } => {
                self.what = format!("background read {read} gave a stale value: {list}");
                self.unit = "slot_queue".into();
                self.stream = Some("response".into());
            }
            MemoryFault::Pixel { eye, x, y, count, .. } => {
                let (pixels, eye_name) = (counted(*count, "pixel"), eye.name());
                let differ = if *count == 1 { "differs" } else { "differ" };
                self.what =
                    format!("{pixels} of the {eye_name} frame buffer {differ}; first: {list}");
                self.pixel = Some(Location { eye: *eye, x: *x, y: *y });
            }
        }
        self.difference(&differences);
    }

    /// The field that differs first.
    fn difference(&mut self, differences: &[Difference]) {
        let first = differences.first();
        self.field = first.map(|d| d.field.name.into());
        self.expected = first.map(|d| d.field.display(d.expected));
        self.actual = first.map(|d| d.field.display(d.actual));
    }
}

/// True if a stream is an input of a unit inside a system.
fn goes_in(library: &Library, place: &Place) -> bool {
    let of_unit = |probe: &&Probe| place.instance.as_ref() == Some(&probe.instance);
    let mut streams = library.probes().iter().filter(of_unit).flat_map(|probe| &probe.streams);
    streams.any(|s| s.name == place.stream && s.direction == Direction::Input)
}

fn location(
    eye: Eye,
    x: impl wheatstone_golden::formats::Quantity,
    y: impl wheatstone_golden::formats::Quantity,
) -> Location {
    Location { eye, x: x.raw() as u32, y: y.raw() as u32 }
}

/// The secondary pixel that beat `number` of a unit's output belongs to.
fn locate(
    recording: &Recording,
    instance: &str,
    number: u64,
    failure: &mut Failure,
) -> Option<Location> {
    let unit = unit_of(instance)?;
    let table = |unit: Unit| recording.outputs.get(&unit);
    let (x, y) = (table(Unit::XInterpolator)?, table(Unit::YInterpolator)?);
    let beat = match unit {
        Unit::Sampler | Unit::Filter => {
            // One output a secondary pixel: find the beat that ends it (fields `end`).
            let ends = (0..x.len()).filter(|&n| x.row(n)[7] | y.row(n)[3] == 1);
            ends.into_iter().nth(number as usize)? as u64
        }
        Unit::Blend => {
            let requests = recording.streams.get("request")?;
            let request = Request::read(
                (number as usize).lt(&requests.len()).then(|| requests.row(number as usize))?,
            );
            return Some(location(request.eye, request.x, request.y));
        }
        _ => number,
    };
    let after =
        recording.polygons.partition_point(|&(first, _)| first <= recording.first_beat + beat);
    failure.polygon = recording.polygons.get(after.checked_sub(1)?).map(|&(_, id)| id);
    let beats = recording.streams.get("beat")?;
    let loads = (0..=beat as usize)
        .filter(|&n| n < beats.len() && PrimaryBeat::read(beats.row(n)).op == Op::Load);
    let setup = recording.streams.get("setup")?;
    let mode: Mode = Setup::read(setup.row(loads.count().checked_sub(1)?)).mode;
    let place = table(Unit::Display)?;
    let row = ((beat as usize) < place.len()).then(|| place.row(beat as usize))?;
    let eye = if mode.is_binocular() { mode.primary().other() } else { mode.primary() };
    Some(Location { eye, x: row[0] as u32, y: row[1] as u32 })
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut line = |name: &str, value: Option<&dyn fmt::Display>| match value {
            Some(value) => writeln!(f, "  {name:<14}{value}"),
            None => Ok(()),
        };
        line("target", Some(&format!("{} ({})", self.target, self.case)))?;
        line("earliest unit", Some(&self.unit))?;
        if let Some(Location { eye, x, y }) = &self.pixel {
            line("pixel", Some(&format!("{} eye, x {x}, y {y}", eye.name())))?;
        }
        line("polygon", self.polygon.as_ref().map(|p| p as &dyn fmt::Display))?;
        line("stream", self.stream.as_ref().map(|s| s as &dyn fmt::Display))?;
        line("field", self.field.as_ref().map(|s| s as &dyn fmt::Display))?;
        line("expected", self.expected.as_ref().map(|s| s as &dyn fmt::Display))?;
        line("actual", self.actual.as_ref().map(|s| s as &dyn fmt::Display))?;
        line("what", Some(&self.what))?;
        line("cycle", self.cycle.as_ref().map(|c| c as &dyn fmt::Display))?;
        let stalls =
            format!("{} (idle {}, back-pressure {})", self.seed, self.stalls[0], self.stalls[1]);
        line("seed", Some(&stalls))?;
        line("repeat with", Some(&self.repeat))?;
        if let Some(error) = &self.waves_error {
            line("waveforms", Some(&format!("failed because {error}")))?;
        }
        if let Some(waves) = &self.waves {
            line("waveforms", Some(&printable_path(waves)))?;
            let view = waves.with_extension("gtkw");
            let command = command_line([OsStr::new("gtkwave"), &operand(&view)]);
            line("open with", Some(&command))?;
        }
        Ok(())
    }
}
