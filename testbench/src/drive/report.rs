//! What a run tells when it ends: the counts, or where and how it failed.

use super::{Lane, Run, State};
use crate::layout::StreamSignals;
use crate::model::{Model, Seen};
use crate::outcome::{
    Counts, Difference, Fault, Hung, Mismatch, Outcome, Place, StreamCount, StreamState,
};
use wheatstone_golden::interface::{Field, Interface};

/// The fields of the beat on a stream's signals.
pub(super) fn payload(model: &Model, stream: &StreamSignals) -> Vec<u64> {
    (0..stream.width).map(|field| model.peek(stream.field(field))).collect()
}

fn differences(fields: &[Field], expected: &[u64], actual: &[u64]) -> Vec<Difference> {
    let values = expected.iter().zip(actual);
    fields
        .iter()
        .zip(values)
        .filter(|(_, (expected, actual))| expected != actual)
        .map(|(field, (&expected, &actual))| Difference { field: field.clone(), expected, actual })
        .collect()
}

fn mismatch(
    fault: Fault,
    place: Place,
    lane: &Lane<'_>,
    cycle: u64,
    fields: &[Field],
    actual: Vec<u64>,
) -> Outcome {
    let expected = match fault {
        Fault::Surplus => Vec::new(),
        _ => lane.row().to_vec(),
    };
    let differences = differences(fields, &expected, &actual);
    let beat = lane.done;
    Outcome::Mismatch(Box::new(Mismatch {
        fault,
        place,
        beat,
        cycle,
        differences,
        expected,
        actual,
    }))
}

impl Run<'_> {
    /// The lowest of the faulty streams, or why the model stopped.
    #[cold]
    pub(super) fn fault(
        &self,
        model: &Model,
        cycle: u64,
        state: &State,
        faulty: u64,
        seen: u32,
    ) -> Outcome {
        let library = model.library();
        if faulty & Seen::STOPPED != 0 {
            let fault = Fault::Stopped(model.stopped().unwrap_or_default());
            let place = Place { instance: None, stream: library.interface().module };
            return Outcome::Mismatch(Box::new(Mismatch {
                fault,
                place,
                beat: 0,
                cycle,
                differences: Vec::new(),
                expected: Vec::new(),
                actual: Vec::new(),
            }));
        }
        let number = faulty.trailing_zeros() as usize;
        let bit = 1u32 << number;
        let fault = if state.held & !seen & bit != 0 {
            Fault::Withdrawn
        } else if state.exhausted & bit != 0 {
            Fault::Surplus
        } else if state.held & bit != 0 {
            Fault::Unstable
        } else {
            Fault::Value
        };
        let stream = &library.interface().streams[number];
        let place = Place { instance: None, stream: stream.name };
        let actual = payload(model, &library.layout().streams[number]);
        let fields = if fault == Fault::Withdrawn { &[][..] } else { &stream.fields };
        mismatch(fault, place, &self.lanes[number], cycle, fields, actual)
    }

    #[cold]
    pub(super) fn probe_fault(&self, model: &Model, cycle: u64, number: usize) -> Outcome {
        let (place, fields) = probe(model, number);
        let fault = match self.probes_exhausted >> number & 1 {
            0 => Fault::Value,
            _ => Fault::Surplus,
        };
        let actual = payload(model, &model.library().layout().probed[number].1);
        mismatch(fault, place, &self.probes[number], cycle, fields, actual)
    }

    #[cold]
    pub(super) fn hung(&self, model: &Model, cycle: u64, waited: u64) -> Outcome {
        let library = model.library();
        let state = |place, direction, lane: &Lane<'_>, signals: &StreamSignals| StreamState {
            place,
            direction,
            done: lane.done,
            total: lane.total,
            valid: model.peek(signals.valid()) != 0,
            ready: model.peek(signals.ready()) != 0,
        };
        let layout = library.layout();
        let streams = library.interface().streams.iter().zip(&self.lanes).zip(&layout.streams);
        let own = streams.map(|((stream, lane), signals)| {
            let place = Place { instance: None, stream: stream.name };
            state(place, stream.direction, lane, signals)
        });
        let probes = self.probes.iter().zip(&layout.probed).enumerate();
        let watched = probes.map(|(number, (lane, (_, signals)))| {
            state(probe(model, number).0, signals.direction, lane, signals)
        });
        let streams = own.chain(watched).collect();
        Outcome::Hung(Box::new(Hung { cycle, waited, streams }))
    }

    /// What is looked at when everything has drained: probes without their last beats, flags.
    pub fn check_end(&self, model: &Model, cycle: u64, flags: &[u64]) -> Result<(), Outcome> {
        let missing = self.probed & !self.probes_exhausted;
        if missing != 0 {
            let number = missing.trailing_zeros() as usize;
            let (place, _) = probe(model, number);
            let lane = &self.probes[number];
            return Err(mismatch(Fault::Missing, place, lane, cycle, &[], Vec::new()));
        }
        let (interface, layout) = (model.library().interface(), model.library().layout());
        for (index, (field, &expected)) in interface.flags.iter().zip(flags).enumerate() {
            let expected = expected & field.mask();
            let actual = model.peek(layout.flag(index));
            if actual != expected {
                let field = field.clone();
                return Err(Outcome::Mismatch(Box::new(Mismatch {
                    fault: Fault::Flag,
                    place: Place { instance: None, stream: field.name },
                    beat: 0,
                    cycle,
                    differences: vec![Difference { field, expected, actual }],
                    expected: vec![expected],
                    actual: vec![actual],
                })));
            }
        }
        Ok(())
    }

    /// The counts of a run from cycle `start` to before cycle `end`.
    pub fn counts(&self, start: u64, end: u64, interface: &Interface) -> Counts {
        let moved = self.lanes.iter().filter(|lane| lane.done > 0);
        let clocks = moved.map(|lane| lane.last + 1 - start).max().unwrap_or(0);
        let streams = interface.streams.iter().zip(&self.lanes);
        let streams = streams.map(|(stream, lane)| StreamCount {
            name: stream.name,
            direction: stream.direction,
            accepted: lane.done,
            stalled: lane.stalled,
            idle: clocks.saturating_sub(lane.done + lane.stalled),
            active: if lane.done > 0 { lane.last + 1 - start } else { 0 },
            first: (lane.done > 0).then_some(lane.first),
            last: (lane.done > 0).then_some(lane.last),
        });
        let streams = streams.collect();
        Counts { clocks, simulated: end - start, streams, probed: self.compared }
    }
}

/// Place and fields of a probed stream.
fn probe(model: &Model, number: usize) -> (Place, &[Field]) {
    let library = model.library();
    let (owner, _) = library.layout().probed[number];
    let probe = &library.probes()[owner];
    let before = library.layout().probed[..number].iter().filter(|(o, _)| *o == owner).count();
    let stream = &probe.streams[before];
    let place = Place { instance: Some(probe.instance.clone()), stream: stream.name };
    (place, &stream.fields)
}
