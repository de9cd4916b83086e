//! The one simulation loop, for every unit and every system.
//!
//! Inputs are offered from tables, outputs are compared with tables, beat by beat, on every
//! clock on which they are offered; the stalls of both are bits of a pattern. Streams are bits
//! of masks: what we drive (`valid` of inputs, `ready` of outputs) and what we see (the other
//! one); a beat is taken where both are 1.
//!
//! 1. Each clock begins by offering beats: a waiting input whose gate is open raises `valid` and
//!    keeps it until the beat is taken. An input that was served and offers nothing new gets
//!    random fields, so that nobody can use them unnoticed.
//! 2. The model settles. Every output that is valid must have a beat left and equal it; one that
//!    waited must still be there. A difference on a beat that waited and was right before is a
//!    change under way.
//! 3. Streams that moved go on to their next row.
//! 4. When no work is left the model must stay quiet for a while; when there is and nothing
//!    moves, the watchdog ends the run.

mod report;

use crate::job::{Job, Limits, Responder};
use crate::model::{Library, Model, Rows, Seen};
use crate::outcome::Outcome;
use crate::stalls::Stalls;
use report::payload;
use std::slice::ChunksExact;
use wheatstone_golden::interface::{Direction, Stream, Table};

/// One stream during a run.
struct Lane<'a> {
    /// Rows after the present one.
    rest: ChunksExact<'a, u64>,
    /// The row to be offered next, or the one expected next.
    row: &'a [u64],
    /// Rows in all.
    total: Option<u64>,
    /// Beats taken.
    done: u64,
    /// Clocks on which a beat waited.
    stalled: u64,
    /// Cycle of the first beat.
    first: u64,
    /// Cycle of the last beat.
    last: u64,
    /// For an answer: the requests.
    answers: Option<usize>,
    /// For requests: the answers.
    answered_by: Option<usize>,
}

impl<'a> Lane<'a> {
    /// A lane at the first row of its table, and whether there is one.
    fn new(stream: &Stream, table: Option<&'a Table>) -> (Lane<'a>, bool) {
        let values = table.map_or(&[][..], Table::values);
        let mut rest = values.chunks_exact(stream.fields.len().max(1));
        let row = rest.next();
        let lane = Lane {
            rest,
            row: row.unwrap_or_default(),
            total: table.map(|table| table.len() as u64),
            done: 0,
            stalled: 0,
            first: 0,
            last: 0,
            answers: None,
            answered_by: None,
        };
        (lane, row.is_some())
    }

    /// Counts a beat.
    #[inline]
    fn count(&mut self, cycle: u64) {
        if self.done == 0 {
            self.first = cycle;
        }
        self.done += 1;
        self.last = cycle;
    }
}

/// The bits of a mask, lowest first.
#[inline]
fn bits(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = mask.trailing_zeros();
        mask &= mask.wrapping_sub(1);
        (bit < u64::BITS).then_some(bit as usize)
    })
}

/// The state of a run; the masks have a bit a stream.
pub(crate) struct Run<'a> {
    lanes: Vec<Lane<'a>>,
    probes: Vec<Lane<'a>>,
    rows: Rows<'a>,
    gates: Vec<u32>,
    /// Random words, for the fields of inputs that offer nothing.
    junk: &'a [u64],
    inputs: u32,
    outputs: u32,
    /// Outputs that are compared.
    checked: u32,
    /// Inputs that the responder supplies.
    asked: u32,
    /// Streams with rows left, or answers due.
    unfinished: u32,
    /// Compared outputs without a row left.
    exhausted: u32,
    /// Inputs that have a beat and wait for their gate.
    waiting: u32,
    /// Inputs that are offering a beat.
    offered: u32,
    /// Inputs served in the last cycle.
    freed: u32,
    /// Outputs with a beat that was not taken in the last cycle.
    held: u32,
    /// Probed streams that are compared.
    probed: u64,
    /// Probed streams without a row left.
    probes_exhausted: u64,
    compared: u64,
}

/// Random words from which a row may be cut anywhere.
pub(crate) const JUNK: usize = 1024 + 256;

impl<'a> Run<'a> {
    /// Prepares a run; the job was checked.
    pub fn new(library: &Library, job: &Job<'a>, junk: &'a [u64]) -> Run<'a> {
        let layout = library.layout();
        let inputs = layout.mask(Direction::Input);
        let mut run = Run {
            lanes: Vec::new(),
            probes: Vec::new(),
            rows: Rows::new(library),
            gates: job.stalls.gates(layout.streams.len(), inputs),
            junk,
            inputs,
            outputs: layout.mask(Direction::Output),
            checked: 0,
            asked: 0,
            unfinished: 0,
            exhausted: 0,
            waiting: 0,
            offered: 0,
            freed: 0,
            held: 0,
            probed: 0,
            probes_exhausted: 0,
            compared: 0,
        };
        for (number, stream) in library.interface().streams.iter().enumerate() {
            let (table, bit) = (job.tables[number], 1u32 << number);
            let (mut lane, has_row) = Lane::new(stream, table);
            lane.answers = layout.streams[number].answers;
            run.unfinished |= if has_row { bit } else { 0 };
            match (stream.direction, table) {
                (Direction::Input, None) => run.asked |= bit,
                (Direction::Input, Some(_)) if lane.answers.is_none() && has_row => {
                    run.waiting |= bit;
                }
                (Direction::Output, Some(_)) => {
                    run.checked |= bit;
                    run.exhausted |= if has_row { 0 } else { bit };
                    if has_row {
                        run.rows.set(number, lane.row);
                    }
                }
                _ => (),
            }
            run.lanes.push(lane);
        }
        for answer in 0..run.lanes.len() {
            if let Some(request) = run.lanes[answer].answers {
                run.lanes[request].answered_by = Some(answer);
            }
        }
        run.watch(library, job.probes);
        run
    }

    fn watch(&mut self, library: &Library, tables: &[Option<&'a Table>]) {
        let streams = library
            .probes()
            .iter()
            .flat_map(|probe| &probe.unit.streams);
        for (number, (stream, table)) in streams.zip(tables).enumerate() {
            let (lane, has_row) = Lane::new(stream, *table);
            if table.is_some() {
                self.probed |= 1 << number;
                self.probes_exhausted |= if has_row { 0 } else { 1 << number };
            }
            if has_row {
                self.rows.set(self.lanes.len() + number, lane.row);
            }
            self.probes.push(lane);
        }
    }

    /// Runs to the end, from cycle `start`; returns the result and the cycles simulated.
    pub fn go(
        &mut self,
        model: &mut Model,
        start: u64,
        limits: Limits,
        mut responder: Option<&mut dyn Responder>,
    ) -> (Result<(), Outcome>, u64) {
        let (mut cycle, mut idle, mut after) = (start, 0, 0);
        let result = loop {
            let gate = self.gates[cycle as usize % Stalls::PERIOD];
            let pokes = self.offer(gate, cycle, &mut responder);
            let drive = self.offered | (gate & self.outputs);
            let found = model.cycle(10 * cycle, drive, pokes, &self.rows);
            let seen = found.seen as u32;
            if self.probed != 0 && found.wrong & Seen::STOPPED == 0 {
                if let Err(mismatch) = self.look(model, cycle) {
                    break Err(mismatch);
                }
            }
            let wrong = found.wrong as u32 & self.checked;
            let faulty = wrong | (seen & self.exhausted) | (self.held & !seen);
            if faulty != 0 || found.wrong & Seen::STOPPED != 0 {
                break Err(self.fault(model, cycle, faulty, seen, found.wrong));
            }
            self.held = seen & !drive & self.outputs;
            for stream in bits((self.held | (drive & !seen & self.inputs)).into()) {
                self.lanes[stream].stalled += 1;
            }
            let taken = drive & seen;
            for stream in bits(taken.into()) {
                self.advance(model, stream, cycle, &mut responder);
            }
            idle = if taken != 0 { 0 } else { idle + 1 };
            cycle += 1;
            if self.unfinished != 0 {
                after = 0;
                if idle >= limits.watchdog {
                    break Err(self.hung(model, cycle - 1, idle));
                }
            } else {
                after += 1;
                if idle >= limits.quiet || after >= limits.watchdog {
                    break Ok(());
                }
            }
        };
        (result, cycle)
    }

    /// Begins to offer what may be offered; returns the inputs whose fields are to be set.
    #[inline]
    fn offer(&mut self, gate: u32, cycle: u64, responder: &mut Option<&mut dyn Responder>) -> u32 {
        let mut opening = gate & self.waiting;
        self.waiting ^= opening;
        for stream in bits(opening.into()) {
            self.rows.set(stream, self.lanes[stream].row);
        }
        if let Some(responder) = responder {
            for stream in bits((gate & self.asked & !self.offered).into()) {
                let filled = self
                    .rows
                    .fill(stream, |row| responder.respond(stream, cycle, row));
                opening |= u32::from(filled) << stream;
            }
        }
        let idle = self.freed & !opening;
        self.freed = 0;
        self.offered |= opening;
        for stream in bits(idle.into()) {
            self.rows.set(stream, &self.junk[cycle as usize % 1024..]);
        }
        opening | idle
    }

    /// A beat of a stream was taken.
    #[inline]
    fn advance(
        &mut self,
        model: &Model,
        stream: usize,
        cycle: u64,
        responder: &mut Option<&mut dyn Responder>,
    ) {
        let bit = 1u32 << stream;
        let lane = &mut self.lanes[stream];
        lane.count(cycle);
        if self.inputs & bit != 0 {
            self.offered ^= bit;
            self.freed |= bit;
            if self.asked & bit == 0 {
                match lane.rest.next() {
                    Some(row) => lane.row = row,
                    None => self.unfinished ^= bit,
                }
            }
            self.release(stream);
            return;
        }
        if let Some(responder) = responder {
            if self.checked & bit != 0 {
                responder.accepted(stream, cycle, lane.row);
            } else {
                let row = payload(model, &model.library().layout().streams[stream]);
                responder.accepted(stream, cycle, &row);
            }
        }
        if self.checked & bit != 0 {
            match lane.rest.next() {
                Some(row) => {
                    lane.row = row;
                    self.rows.set(stream, row);
                }
                None => {
                    self.unfinished ^= bit;
                    self.exhausted |= bit;
                }
            }
        }
        if let Some(answer) = self.lanes[stream].answered_by {
            self.release(answer);
        }
    }

    /// Lets an input go on, after it was served or a request for it was taken.
    #[inline]
    fn release(&mut self, stream: usize) {
        let bit = 1u32 << stream;
        let lane = &self.lanes[stream];
        let due = lane
            .answers
            .is_none_or(|request| self.lanes[request].done > lane.done);
        if self.asked & bit != 0 {
            let due = due && lane.answers.is_some();
            self.unfinished = (self.unfinished & !bit) | if due { bit } else { 0 };
        } else if due && self.unfinished & !self.offered & bit != 0 {
            self.waiting |= bit;
        }
    }

    /// Compares what the probes saw.
    #[inline]
    fn look(&mut self, model: &Model, cycle: u64) -> Result<(), Outcome> {
        let Seen { seen, wrong } = model.probe(&self.rows);
        let taken = seen & self.probed;
        let faulty = taken & (wrong | self.probes_exhausted);
        if faulty != 0 {
            return Err(self.probe_fault(model, cycle, faulty.trailing_zeros() as usize));
        }
        for number in bits(taken) {
            let lane = &mut self.probes[number];
            lane.count(cycle);
            self.compared += 1;
            match lane.rest.next() {
                Some(row) => {
                    lane.row = row;
                    self.rows.set(self.lanes.len() + number, row);
                }
                None => self.probes_exhausted |= 1 << number,
            }
        }
        Ok(())
    }
}
