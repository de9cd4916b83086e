//! The first-mismatch report, and the run that repeats it with waveforms.

use super::run::{MemoryFault, Ran};
use super::{Plan, RegressionError, Waves};
use crate::{waves, Fault, Library, Mismatch, Outcome, Place, Probe, Stalls, TraceWindow};
use serde::Serialize;
use std::fmt;
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::interface::{Beat, Direction};
use wheatstone_golden::pipeline::observer::Unit;
use wheatstone_golden::pipeline::{Mode, Op, Pixel, PrimaryBeat, Request, Setup};
use wheatstone_golden::record::Recording;
use wheatstone_golden::targets::Target;

/// Cycles shown before a difference.
const BEFORE: u64 = 100;
/// Cycles shown after it.
const AFTER: u64 = 20;

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
    /// What is wrong, in a sentence.
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
}

impl Failure {
    /// The report of a run that failed; `again` repeats it with waveforms.
    #[allow(clippy::too_many_arguments)] // One call site, and each argument is a different thing.
    pub(super) fn new(
        plan: &Plan,
        target: Target,
        case: &str,
        seed: u64,
        stalls: Stalls,
        ran: Ran,
        library: &Library,
        again: impl FnOnce(TraceWindow) -> Result<(), RegressionError>,
    ) -> Result<Failure, RegressionError> {
        let mut failure = Failure {
            target: target.name(),
            case: case.into(),
            what: ran.outcome.to_string(),
            pixel: None,
            polygon: None,
            field: None,
            expected: None,
            actual: None,
            unit: target.name().into(),
            stream: None,
            cycle: None,
            seed,
            stalls: [stalls.idle.name(), stalls.back_pressure.name()],
            repeat: repeat(plan, target, seed),
            waves: None,
        };
        match &ran.outcome {
            Outcome::Mismatch(mismatch) => {
                failure.mismatch(mismatch, ran.recording.as_deref());
                // What comes into a unit wrong is not the unit's fault.
                if goes_in(library, &mismatch.place) {
                    failure.unit = target.name().into();
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
        if plan.waves != Waves::Never {
            if let Some(cycle) = failure.cycle {
                let window =
                    window(plan, target, seed, cycle.saturating_sub(BEFORE)..=cycle + AFTER)?;
                again(window.clone())?;
                view(library, &window, Some(cycle), "first mismatch")?;
                failure.waves = Some(window.path);
            }
        }
        Ok(failure)
    }

    fn mismatch(&mut self, mismatch: &Mismatch, recording: Option<&Recording>) {
        self.cycle = Some(mismatch.cycle);
        self.stream = Some(mismatch.place.stream.into());
        if let Some(instance) = &mismatch.place.instance {
            let name = instance.split('.').next_back().unwrap_or(instance);
            self.unit = name.strip_prefix("u_").unwrap_or(name).into();
        }
        if let Some(first) = mismatch.differences.first() {
            self.field = Some(first.field.name.into());
            self.expected = Some(first.field.display(first.expected));
            self.actual = Some(first.field.display(first.actual));
        }
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
        match fault {
            MemoryFault::Stale { read, expected, actual } => {
                self.what = format!("background read {read} gave a stale value");
                self.unit = "slot_queue".into();
                self.stream = Some("response".into());
                self.field = None;
                self.expected = Some(format!("{expected:?}"));
                self.actual = Some(format!("{actual:?}"));
            }
            MemoryFault::Pixel { eye, x, y, expected, actual, count } => {
                self.what = format!("{count} pixels of the {} frame buffer differ", eye.name());
                self.pixel = Some(Location { eye: *eye, x: *x, y: *y });
                self.expected = Some(format!("{expected:?}"));
                self.actual = Some(format!("{actual:?}"));
            }
        }
    }
}

/// Whether a stream is an input of a unit inside a system.
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
    let unit = Unit::ALL.into_iter().find(|u| u.instance() == instance)?;
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

/// The command that repeats a case from its seed.
fn repeat(plan: &Plan, target: Target, seed: u64) -> String {
    let mut words = vec!["wheatstone cosim".to_owned(), target.name().to_owned()];
    words.extend(plan.words.iter().cloned());
    words.push(format!("--seed {seed}"));
    words.join(" ")
}

/// A window of cycles in a new waveform file of a target.
pub(super) fn window(
    plan: &Plan,
    target: Target,
    seed: u64,
    cycles: RangeInclusive<u64>,
) -> Result<TraceWindow, RegressionError> {
    let at = |path: &Path| {
        let path = path.to_owned();
        move |source| RegressionError::File { path, source }
    };
    fs::create_dir_all(&plan.out).map_err(at(&plan.out))?;
    let path = plan.out.join(format!("{}-{seed}.fst", target.name()));
    Ok(TraceWindow { path, from_cycle: *cycles.start(), to_cycle: *cycles.end() })
}

/// Writes the views beside a waveform file.
pub(super) fn view(
    library: &Library,
    window: &TraceWindow,
    marker: Option<u64>,
    name: &str,
) -> Result<(), RegressionError> {
    let (interface, units) = (library.interface(), library.probes());
    let marker = marker.map(|cycle| (cycle, name));
    waves::write_views(&window.path, &waves::View { interface, units, marker })?;
    Ok(())
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
        if let Some(waves) = &self.waves {
            line("waveforms", Some(&waves.display()))?;
            line(
                "open with",
                Some(&format!("gtkwave {}", waves.with_extension("gtkw").display())),
            )?;
        }
        Ok(())
    }
}
