//! The end of a run: the counts, or where and how it failed.

use super::run::{bits, payload, Run, State};
use crate::model::{Model, Seen};
use crate::outcome::{
    Counts, Difference, Fault, Hung, Mismatch, Outcome, Place, StreamCount, StreamState,
};
use wheatstone_golden::interface::{Field, Interface};

fn stopped(fault: Fault, stream: &'static str, cycle: u64) -> Mismatch {
    Mismatch {
        fault,
        place: Place { instance: None, stream },
        beat: 0,
        cycle,
        differences: Vec::new(),
        expected: Vec::new(),
        actual: Vec::new(),
    }
}

impl Run<'_> {
    /// The row that a stream, counted with the probes, has come to; empty if there is none.
    fn row(&self, number: usize) -> &[u64] {
        let done = self.cursors[number].done as usize;
        let table = self.tables[number].filter(|table| done < table.len());
        table.map_or(&[], |table| table.row(done))
    }

    /// A fault on a stream, counted with the probes.
    fn mismatch(
        &self,
        fault: Fault,
        (number, place): (usize, Place),
        cycle: u64,
        fields: &[Field],
        actual: Vec<u64>,
    ) -> Outcome {
        let (beat, expected) = (self.cursors[number].done, self.row(number).to_vec());
        let differences = Difference::all(fields, &expected, &actual);
        let mismatch = Mismatch { fault, place, beat, cycle, differences, expected, actual };
        Outcome::Mismatch(Box::new(mismatch))
    }

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
            let mismatch = stopped(fault, library.interface().module, cycle);
            return Outcome::Mismatch(Box::new(mismatch));
        }
        // A beat that waits shows at once where it leads without a register: look at its unit first.
        if let Some(probed) = self.suspect(model) {
            return self.probe_fault(model, cycle, 1 << probed);
        }
        let number = faulty.trailing_zeros() as usize;
        let bit = 1u32 << number;
        let fault = if state.held & !seen & bit != 0 {
            Fault::Withdrawn
        } else if self.row(number).is_empty() {
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
        self.mismatch(fault, (number, place), cycle, fields, actual)
    }

    /// The first probed stream that offers a wrong beat, not taken yet: those taken were compared.
    fn suspect(&self, model: &Model) -> Option<usize> {
        let layout = model.library().layout();
        bits(self.watched).find(|&probed| {
            let (_, stream) = &layout.probed[probed];
            let waits = model.peek(stream.valid()) != 0 && model.peek(stream.ready()) == 0;
            let row = self.row(self.streams(model) + probed);
            waits && !row.is_empty() && payload(model, stream) != row
        })
    }

    /// The lowest of the faulty probed streams.
    #[cold]
    pub(super) fn probe_fault(&self, model: &Model, cycle: u64, faulty: u64) -> Outcome {
        let probed = faulty.trailing_zeros() as usize;
        let number = self.streams(model) + probed;
        let (place, fields) = probe(model, probed);
        let fault = if self.row(number).is_empty() { Fault::Surplus } else { Fault::Value };
        let actual = payload(model, &model.library().layout().probed[probed].1);
        self.mismatch(fault, (number, place), cycle, fields, actual)
    }

    /// Number of the module's own streams.
    pub(super) fn streams(&self, model: &Model) -> usize {
        model.library().layout().streams.len()
    }

    #[cold]
    pub(super) fn hung(&self, model: &Model, cycle: u64, waited: u64) -> Outcome {
        let library = model.library();
        let layout = library.layout();
        let own = library.interface().streams.iter().map(|stream| stream.name);
        let own = own.map(|stream| Place { instance: None, stream });
        let watched = (0..layout.probed.len()).map(|probed| probe(model, probed).0);
        let signals = layout.streams.iter().chain(layout.probed.iter().map(|(_, stream)| stream));
        let streams = own.chain(watched).zip(signals).enumerate();
        let streams = streams.map(|(number, (place, signals))| StreamState {
            place,
            direction: signals.direction,
            done: self.cursors[number].done,
            total: self.tables.get(number).copied().flatten().map(|table| table.len() as u64),
            valid: model.peek(signals.valid()) != 0,
            ready: model.peek(signals.ready()) != 0,
        });
        Outcome::Hung(Box::new(Hung { cycle, waited, streams: streams.collect() }))
    }

    /// Checks the end, when everything has drained: probes without their last beats, flags.
    pub fn check_end(&self, model: &Model, cycle: u64, flags: &[u64]) -> Result<(), Outcome> {
        for probed in bits(self.watched) {
            let number = self.streams(model) + probed;
            if !self.row(number).is_empty() {
                let (place, _) = probe(model, probed);
                let place = (number, place);
                return Err(self.mismatch(Fault::Missing, place, cycle, &[], Vec::new()));
            }
        }
        let (interface, layout) = (model.library().interface(), model.library().layout());
        for (index, (field, &expected)) in interface.flags.iter().zip(flags).enumerate() {
            let expected = expected & field.mask();
            let actual = model.peek(layout.flag(index));
            if actual != expected {
                let differences = vec![Difference { field: field.clone(), expected, actual }];
                let (expected, actual) = (vec![expected], vec![actual]);
                let flag = stopped(Fault::Flag, field.name, cycle);
                let flag = Mismatch { differences, expected, actual, ..flag };
                return Err(Outcome::Mismatch(Box::new(flag)));
            }
        }
        Ok(())
    }

    /// The counts of a run from cycle `start` to before cycle `end`.
    pub fn counts(&self, start: u64, end: u64, interface: &Interface) -> Counts {
        let own = interface.streams.len();
        let moved = (0..own).map(|i| &self.cursors[i]).filter(|cursor| cursor.done > 0);
        let clocks = moved.map(|cursor| cursor.last + 1 - start).max().unwrap_or(0);
        let streams = interface.streams.iter().enumerate().map(|(number, stream)| {
            let cursor = &self.cursors[number];
            let moved = cursor.done > 0;
            StreamCount {
                name: stream.name,
                direction: stream.direction,
                accepted: cursor.done,
                stalled: cursor.stalled,
                idle: clocks.saturating_sub(cursor.done + cursor.stalled),
                active: if moved { cursor.last + 1 - start } else { 0 },
                first: moved.then_some(cursor.first),
                last: moved.then_some(cursor.last),
            }
        });
        let streams = streams.collect();
        let probed = self.probed(own);
        Counts { clocks, simulated: end - start, streams, probed }
    }

    /// Beats seen at the probes so far, of a module with so many streams.
    pub(super) fn probed(&self, streams: usize) -> u64 {
        bits(self.watched).map(|i| self.cursors[streams + i].done).sum()
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
