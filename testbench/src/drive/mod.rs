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
mod run;

pub(crate) use run::{Run, JUNK};

use crate::job::{Limits, Responder};
use crate::model::{Model, Seen};
use crate::outcome::Outcome;
use crate::watch::Watched;
use run::{bits, payload, State};

impl Run<'_> {
    /// Runs to the end, from cycle `start`; returns the result and the cycle after the last.
    pub fn go(
        &mut self,
        model: &mut Model,
        start: u64,
        limits: Limits,
        mut responder: Option<&mut dyn Responder>,
        watched: &Watched,
    ) -> (Result<(), Outcome>, u64) {
        let asked = self.inputs & !self.tabled;
        let checked = u64::from(self.outputs & self.tabled) | Seen::STOPPED;
        let told = if responder.is_some() { self.outputs } else { 0 };
        let mut state = self.begin();
        let (mut cycle, mut idle, mut after, mut probed) = (start, 0, 0, 0);
        let result = loop {
            let gate = self.gates[cycle as usize & (self.gates.len() - 1)];
            let mut opening = gate & state.waiting;
            state.waiting ^= opening;
            if asked & gate & !state.offered != 0 {
                opening |= self.ask(asked & gate & !state.offered, cycle, &mut responder);
            }
            state.offered |= opening;
            let emptied = state.freed & !opening;
            let pokes = u64::from(opening) | u64::from(emptied) << 32;
            let willing = if self.until_valid { state.held } else { self.outputs };
            let drive = state.offered | (gate & willing);
            let junk = &self.junk[cycle as usize % JUNK];
            watched.clock(cycle);
            let Seen { seen, wrong } = model.cycle(cycle, drive, pokes, &mut self.cursors, junk);
            let (seen, ended) = (seen as u32, (seen >> 32) as u32);

            if self.watched != 0 && wrong & Seen::STOPPED == 0 {
                let found = model.probe(cycle, self.watched, &mut self.cursors);
                if found.wrong != 0 {
                    break Err(self.probe_fault(model, cycle, found.wrong));
                }
            }
            let faulty = (wrong & checked) | u64::from(state.held & !seen);
            if faulty != 0 {
                break Err(self.fault(model, cycle, &state, faulty, seen));
            }

            let taken = drive & seen;
            state.held = seen & !drive & self.outputs;
            state.freed = taken & self.inputs;
            state.offered &= !state.freed;
            state.unfinished &= !ended;
            state.waiting |= state.freed & state.unfinished & !self.answers;
            if taken & told != 0 {
                self.tell(model, taken & told, cycle, &mut responder);
            }
            if self.answers != 0 && taken != 0 {
                self.release(&mut state);
            }

            cycle += 1;
            idle = if taken != 0 { 0 } else { idle + 1 };
            if state.unfinished == 0 {
                after += 1;
                if idle >= limits.quiet || after >= limits.watchdog {
                    // Inside, beats may still follow that no output shows.
                    let now = self.probed(self.streams(model));
                    if now == probed {
                        break Ok(());
                    }
                    (idle, after, probed) = (0, 0, now);
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

    /// Asks the responder for beats; returns the inputs that have one.
    #[inline(never)]
    fn ask(&mut self, asked: u32, cycle: u64, responder: &mut Option<&mut dyn Responder>) -> u32 {
        let Some(responder) = responder else { return 0 };
        let mut answer = |stream| {
            let filled = self.cursors.fill(stream, |row| responder.respond(stream, cycle, row));
            u32::from(filled) << stream
        };
        bits(asked.into()).map(&mut answer).sum()
    }

    /// Tells the responder what outputs sent.
    #[inline(never)]
    fn tell(
        &mut self,
        model: &Model,
        taken: u32,
        cycle: u64,
        responder: &mut Option<&mut dyn Responder>,
    ) {
        let Some(responder) = responder else { return };
        for stream in bits(taken.into()) {
            match self.tables[stream] {
                Some(table) => {
                    let sent = self.cursors[stream].done - 1;
                    responder.accepted(stream, cycle, table.row(sent as usize));
                }
                None => {
                    let row = payload(model, &model.library().layout().streams[stream]);
                    responder.accepted(stream, cycle, &row);
                }
            }
        }
    }

    /// Lets the answers to requests go on for which a request was taken.
    fn release(&mut self, state: &mut State) {
        for &(answer, request) in &self.pairs {
            let bit = 1u32 << answer;
            let due = self.cursors[request].done > self.cursors[answer].done;
            if self.tabled & bit == 0 {
                state.unfinished = (state.unfinished & !bit) | (u32::from(due) << answer);
            } else if due && state.unfinished & !state.offered & bit != 0 {
                state.waiting |= bit;
            }
        }
    }
}
