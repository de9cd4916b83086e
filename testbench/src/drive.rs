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
use report::payload;
use wheatstone_golden::interface::{Direction, Stream, Table};

/// One stream during a run.
struct Lane<'a> {
    /// The row to be offered or expected next, and all rows after it.
    rows: &'a [u64],
    /// Fields of a row.
    width: usize,
    /// Beats taken.
    done: u64,
    /// Cycle of the last beat.
    last: u64,
    /// Cycle of the first beat.
    first: u64,
    /// Clocks on which a beat waited.
    stalled: u64,
    /// Rows in all, if there is a table.
    total: Option<u64>,
}

impl<'a> Lane<'a> {
    fn new(stream: &Stream, table: Option<&'a Table>) -> Lane<'a> {
        Lane {
            rows: table.map_or(&[], Table::values),
            width: stream.fields.len(),
            done: 0,
            last: 0,
            first: 0,
            stalled: 0,
            total: table.map(|table| table.len() as u64),
        }
    }

    /// The row to be offered or expected next; empty if there is none.
    fn row(&self) -> &'a [u64] {
        self.rows.get(..self.width).unwrap_or_default()
    }

    /// Goes on to the next row.
    #[inline]
    fn step(&mut self) {
        self.rows = self.rows.get(self.width..).unwrap_or_default();
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

/// What changes from clock to clock, a bit a stream.
#[derive(Clone, Copy, Default)]
struct State {
    /// Inputs that have a beat and wait for their gate.
    waiting: u32,
    /// Inputs that are offering a beat.
    offered: u32,
    /// Inputs served in the last cycle.
    freed: u32,
    /// Inputs whose row was replaced by random words.
    junked: u32,
    /// Outputs with a beat that was not taken in the last cycle.
    held: u32,
    /// Streams with rows left, or answers due.
    unfinished: u32,
    /// Compared outputs without a row left.
    exhausted: u32,
    /// Streams of whose beats more than the count is kept.
    special: u32,
}

/// A run; the masks here do not change.
pub(crate) struct Run<'a> {
    lanes: Vec<Lane<'a>>,
    probes: Vec<Lane<'a>>,
    rows: Rows<'a>,
    gates: &'a [u32],
    /// Random words, for the fields of inputs that offer nothing.
    junk: &'a [u64],
    inputs: u32,
    outputs: u32,
    /// Streams with a table.
    tabled: u32,
    /// Inputs that answer requests, and the numbers of both.
    answers: u32,
    pairs: Vec<(usize, usize)>,
    /// Streams of whose beats the responder is told.
    told: u32,
    state: State,
    /// Probed streams that are compared.
    probed: u64,
    /// Probed streams without a row left.
    probes_exhausted: u64,
    /// Beats compared on probed streams.
    compared: u64,
}

/// Random words from which a row may be cut anywhere below 1024.
pub(crate) const JUNK: usize = 1024 + 256;

impl<'a> Run<'a> {
    /// Prepares a run; the job was checked. The length of `gates` is a power of two.
    pub fn new(library: &Library, job: &Job<'a>, gates: &'a [u32], junk: &'a [u64]) -> Run<'a> {
        let (interface, layout) = (library.interface(), library.layout());
        let streams = || interface.streams.iter().zip(job.tables);
        let mask = |f: &dyn Fn(&Stream, &Option<&Table>) -> bool| {
            let bits = streams().enumerate().map(|(i, (s, table))| u32::from(f(s, table)) << i);
            bits.sum::<u32>()
        };
        let answering = layout.streams.iter().enumerate();
        let pairs: Vec<(usize, usize)> =
            answering.filter_map(|(i, s)| s.answers.map(|request| (i, request))).collect();
        let mut run = Run {
            lanes: streams().map(|(stream, table)| Lane::new(stream, *table)).collect(),
            probes: Vec::new(),
            rows: Rows::new(library),
            gates,
            junk,
            inputs: layout.mask(Direction::Input),
            outputs: layout.mask(Direction::Output),
            tabled: mask(&|_, table| table.is_some()),
            answers: pairs.iter().map(|(answer, _)| 1 << answer).sum(),
            pairs,
            told: 0,
            state: State::default(),
            probed: 0,
            probes_exhausted: 0,
            compared: 0,
        };
        let filled = mask(&|_, table| table.is_some_and(|table| !table.is_empty()));
        run.state.unfinished = filled;
        run.state.waiting = filled & run.inputs & !run.answers;
        run.state.exhausted = run.tabled & run.outputs & !filled;
        run.state.special = u32::MAX;
        for stream in bits(filled.into()) {
            run.rows.set(stream, run.lanes[stream].rows);
        }
        run.watch(library, job.probes);
        run
    }

    fn watch(&mut self, library: &Library, tables: &[Option<&'a Table>]) {
        let streams = library.probes().iter().flat_map(|probe| &probe.streams);
        for (number, (stream, table)) in streams.zip(tables).enumerate() {
            let lane = Lane::new(stream, *table);
            if table.is_some() {
                self.probed |= 1 << number;
            }
            if lane.rows.is_empty() {
                self.probes_exhausted |= 1 << number;
            } else {
                self.rows.set(self.lanes.len() + number, lane.rows);
            }
            self.probes.push(lane);
        }
    }

    /// Runs to the end, from cycle `start`; returns the result and the cycle after the last.
    pub fn go(
        &mut self,
        model: &mut Model,
        start: u64,
        limits: Limits,
        mut responder: Option<&mut dyn Responder>,
    ) -> (Result<(), Outcome>, u64) {
        let asked = self.inputs & !self.tabled;
        let checked = u64::from(self.outputs & self.tabled) | Seen::STOPPED;
        self.told = if responder.is_some() { self.outputs } else { 0 };
        let mut state = self.state;
        let (mut cycle, mut idle, mut after) = (start, 0, 0);
        let result = loop {
            let gate = self.gates[cycle as usize & (self.gates.len() - 1)];
            let mut pokes = gate & state.waiting;
            state.waiting ^= pokes;
            let unusual = (state.freed & !pokes) | (state.junked & pokes) | (asked & gate);
            state.offered |= pokes;
            if unusual != 0 {
                pokes = self.prepare(&mut state, gate, pokes, cycle, &mut responder);
            }
            let drive = state.offered | (gate & self.outputs);
            let found = model.cycle(10 * cycle, drive, pokes, &self.rows);
            let seen = found.seen as u32;

            if self.probed != 0 && found.wrong & Seen::STOPPED == 0 {
                if let Err(mismatch) = self.look(model, cycle) {
                    break Err(mismatch);
                }
            }
            let faulty = (found.wrong & checked)
                | u64::from(seen & state.exhausted)
                | u64::from(state.held & !seen);
            if faulty != 0 {
                break Err(self.fault(model, cycle, &state, faulty, seen));
            }

            state.held = seen & !drive & self.outputs;
            for stream in bits((state.held | (drive & !seen & self.inputs)).into()) {
                self.lanes[stream].stalled += 1;
            }
            let taken = drive & seen;
            for stream in bits(taken.into()) {
                self.advance(model, &mut state, stream, cycle, &mut responder);
            }
            state.freed = taken & self.inputs;
            state.offered &= !state.freed;
            state.waiting |= state.freed & state.unfinished & !self.answers;
            if self.answers != 0 && taken != 0 {
                self.release(&mut state);
            }

            cycle += 1;
            idle = if taken != 0 { 0 } else { idle + 1 };
            if state.unfinished == 0 {
                after += 1;
                if idle >= limits.quiet || after >= limits.watchdog {
                    break Ok(());
                }
            } else {
                after = 0;
                if idle >= limits.watchdog {
                    break Err(self.hung(model, cycle - 1, idle));
                }
            }
        };
        (result, cycle)
    }

    /// Sets the rows of inputs that do not simply go on: after stalls, and from the responder.
    /// Returns the inputs whose fields are to be set.
    #[inline(never)]
    fn prepare(
        &mut self,
        state: &mut State,
        gate: u32,
        mut opening: u32,
        cycle: u64,
        responder: &mut Option<&mut dyn Responder>,
    ) -> u32 {
        for stream in bits((opening & state.junked).into()) {
            self.rows.set(stream, self.lanes[stream].rows);
        }
        state.junked &= !opening;
        if let Some(responder) = responder {
            let asked = gate & self.inputs & !self.tabled & !state.offered;
            for stream in bits(asked.into()) {
                let filled = self.rows.fill(stream, |row| responder.respond(stream, cycle, row));
                opening |= u32::from(filled) << stream;
            }
        }
        state.offered |= opening;
        let idle = state.freed & !opening;
        for stream in bits(idle.into()) {
            self.rows.set(stream, &self.junk[cycle as usize % 1024..]);
        }
        state.junked |= idle;
        opening | idle
    }

    /// A beat of a stream was taken.
    #[inline]
    fn advance(
        &mut self,
        model: &Model,
        state: &mut State,
        stream: usize,
        cycle: u64,
        responder: &mut Option<&mut dyn Responder>,
    ) {
        let bit = 1u32 << stream;
        if state.special & bit != 0 {
            self.notice(model, stream, cycle, responder);
            state.special &= !bit | self.told;
        }
        let lane = &mut self.lanes[stream];
        lane.done += 1;
        lane.last = cycle;
        if self.tabled & bit != 0 {
            lane.step();
            if lane.rows.is_empty() {
                state.unfinished &= !bit;
                state.exhausted |= bit & self.outputs;
            } else {
                self.rows.set(stream, lane.rows);
            }
        }
    }

    /// Keeps the cycle of a first beat and tells the responder of outputs.
    #[inline(never)]
    fn notice(
        &mut self,
        model: &Model,
        stream: usize,
        cycle: u64,
        responder: &mut Option<&mut dyn Responder>,
    ) {
        let lane = &mut self.lanes[stream];
        if lane.done == 0 {
            lane.first = cycle;
        }
        if let (Some(responder), true) = (responder, self.told >> stream & 1 == 1) {
            if lane.total.is_some() {
                responder.accepted(stream, cycle, lane.row());
            } else {
                let row = payload(model, &model.library().layout().streams[stream]);
                responder.accepted(stream, cycle, &row);
            }
        }
    }

    /// Lets the answers to requests go on for which a request was taken.
    fn release(&mut self, state: &mut State) {
        for &(answer, request) in &self.pairs {
            let bit = 1u32 << answer;
            let due = self.lanes[request].done > self.lanes[answer].done;
            if self.tabled & bit == 0 {
                state.unfinished = (state.unfinished & !bit) | (u32::from(due) << answer);
            } else if due && state.unfinished & !state.offered & bit != 0 {
                state.waiting |= bit;
            }
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
        self.compared += u64::from(taken.count_ones());
        for number in bits(taken) {
            let lane = &mut self.probes[number];
            lane.done += 1;
            lane.step();
            if lane.rows.is_empty() {
                self.probes_exhausted |= 1 << number;
            } else {
                self.rows.set(self.lanes.len() + number, lane.rows);
            }
        }
        Ok(())
    }
}
