//! Cases of what a system, or a unit in it, did for a job.

use super::case::Case;
use super::primary;
use wheatstone_golden::interface::{Direction, Table};
use wheatstone_golden::pipeline::observer::Unit;
use wheatstone_golden::record::{Recording, Tape};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::{probes, Target};

/// The case of what a system did for a job, or for a part of it.
pub fn recorded(target: Target, job: &Job, name: &str, recording: &Recording) -> Case {
    let mut case = Case::empty(target, &job.config, name);
    let interface = case.interface();
    case.statics = vec![job.width.into(), job.height.into(), job.options.single.into(), 0];
    let table = |stream: &str| recording.streams.get(stream).cloned().unwrap_or_default();
    let of = |direction: Direction| {
        let streams = interface.streams.iter().filter(move |s| s.direction == direction);
        streams.map(|s| table(s.name)).collect::<Vec<Table>>()
    };
    case.inputs = of(Direction::Input);
    case.outputs = of(Direction::Output);
    case.flags = vec![recording.error.into()];
    for probe in probes(target, &job.config) {
        let empty = || Table::new(&probe.stream.fields);
        let tables = match probe.stream.direction {
            Direction::Input => &recording.inputs,
            Direction::Output => &recording.outputs,
        };
        let table = match probe.unit {
            Unit::Primary => recording.streams.get("beat").cloned(),
            unit => tables.get(&unit).cloned(),
        };
        let table = table.unwrap_or_else(empty);
        case.probes.push((probe, table));
    }
    case
}

/// The instance of a unit that stands for it in a system.
fn instance(target: Target) -> Option<Unit> {
    Some(match target {
        Target::XInterpolator => Unit::XInterpolator,
        Target::YInterpolator => Unit::YInterpolator,
        Target::EdgeInterpolator => Unit::Edge0,
        Target::Sampler => Unit::Sampler,
        Target::Filter => Unit::Filter,
        Target::Coverage => Unit::Coverage,
        Target::Blend => Unit::Blend,
        Target::Display => Unit::Display,
        Target::Redirect => Unit::Redirect,
        Target::Traversal | Target::Primary | Target::Mono => return None,
        Target::Minimal | Target::Hybrid | Target::Stereo => return None,
    })
}

/// The case of what a unit did inside the hybrid, or in the primary pipeline before it.
pub fn recorded_unit(target: Target, job: &Job, name: &str, recording: &Recording) -> Case {
    if let Target::Traversal | Target::Primary | Target::Mono = target {
        return primary::recorded(target, job, name, recording);
    }
    let mut case = Case::empty(target, &job.config, name);
    let Some(unit) = instance(target) else { return case };
    if let Some(table) = recording.inputs.get(&unit) {
        case.inputs = vec![table.clone()];
    }
    if let Some(table) = recording.outputs.get(&unit) {
        case.outputs = vec![table.clone()];
    }
    if target == Target::Redirect {
        case.outputs = ["left", "right"].map(|stream| recording.streams[stream].clone()).to_vec();
    }
    case.statics = match target {
        Target::XInterpolator | Target::Display => vec![job.width.into()],
        Target::YInterpolator => vec![job.height.into()],
        Target::Redirect => vec![job.options.single.into()],
        _ => Vec::new(),
    };
    case
}

/// Number of the beat that a unit gives for a secondary pixel, by its place on the display.
pub fn output_number(target: Target, recording: &Recording, x: u32, y: u32) -> Option<u64> {
    let table = |unit: Unit| recording.outputs.get(&unit);
    let at = |row: &[u64]| row[0] == u64::from(x) && row[1] == u64::from(y);
    let (place, xs, ys) =
        (table(Unit::Display)?, table(Unit::XInterpolator)?, table(Unit::YInterpolator)?);
    let ends = |n: &usize| xs.row(*n)[7] | ys.row(*n)[3] == 1;
    let beat = (0..place.len()).filter(ends).find(|&n| at(place.row(n)))?;
    match target {
        Target::Sampler | Target::Filter => Some((0..beat).filter(ends).count() as u64),
        Target::Blend => {
            let requests = recording.streams.get("request")?;
            (0..requests.len()).find(|&n| at(&requests.row(n)[1..])).map(|n| n as u64)
        }
        Target::Redirect => {
            let slots = recording.inputs.get(&Unit::Redirect)?;
            // Fields 9 and 10: the secondary's place.
            (0..slots.len()).find(|&n| at(&slots.row(n)[9..])).map(|n| n as u64)
        }
        _ => Some(beat as u64),
    }
}

/// The case of all that is on a tape.
pub(super) fn whole(target: Target, job: &Job, name: &str, mut tape: Tape) -> Case {
    let before = job.frames(target == Target::Minimal);
    let mut case = recorded(target, job, name, &tape.take());
    case.memory = Some(Box::new([before, tape.frames().clone()]));
    case
}

/// The case of a job that is drawn as it is.
pub(super) fn simply(target: Target, job: &Job, name: &str) -> Case {
    let minimal = target == Target::Minimal;
    let mut tape = Tape::new(job, minimal, false);
    job.run(minimal, tape.sink());
    whole(target, job, name, tape)
}
