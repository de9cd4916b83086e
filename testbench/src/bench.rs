//! A model in its test bench: reset, runs, waveforms.

use crate::build_error::{LoadError, TraceError};
use crate::cursors::{Words, WORDS};
use crate::drive::{Run, JUNK};
use crate::job::{Job, JobError, Responder, TraceWindow};
use crate::model::{Library, Model};
use crate::outcome::Outcome;
use crate::stalls::Stalls;
use crate::watch::Watched;
use wheatstone_golden::interface::Direction;

/// A model in its test bench.
///
/// Runs follow one another without a reset, so that a long stimulus can be given in parts;
/// cycles count on from the first reset.
pub struct Bench {
    model: Model,
    /// True if it has not been reset yet.
    fresh: bool,
    cycle: u64,
    random: fastrand::Rng,
    junk: Box<[Words; JUNK]>,
    /// The gates of the stalls that were used last.
    gates: (Stalls, Vec<u32>),
}

impl Bench {
    /// A new instance of a model. Its first run resets it, after the static inputs are set. The seed
    /// chooses the state it starts from and the length of the reset, 1 to 4 clocks.
    pub fn new(library: &Library, seed: u64) -> Result<Bench, LoadError> {
        let model = Model::new(library, seed)?;
        let mut random = fastrand::Rng::with_seed(seed);
        let mut junk = Box::new([[0; WORDS]; JUNK]);
        junk.iter_mut().flatten().for_each(|word| *word = random.u64(..));
        Ok(Bench { model, fresh: true, cycle: 0, random, junk, gates: Default::default() })
    }

    /// Resets the model, wherever it is.
    pub fn reset(&mut self) {
        self.fresh = false;
        let clocks = self.random.u32(1..=4);
        self.model.reset(clocks, || self.random.u64(..));
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    pub(crate) fn model_mut(&mut self) -> &mut Model {
        &mut self.model
    }

    /// Cycles run since the first reset.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Writes a part of the runs that follow to a waveform file.
    pub fn trace(&mut self, window: &TraceWindow) -> Result<(), TraceError> {
        let cycles = window.from_cycle..window.to_cycle.saturating_add(1);
        self.model.trace_open(&window.path, cycles)
    }

    /// Completes the waveform file; dropping the bench does so too.
    pub fn close_trace(&mut self) {
        self.model.trace_close();
    }

    /// Runs a job to its end or to the first difference.
    pub fn run(&mut self, job: &Job<'_>) -> Result<Outcome, JobError> {
        self.run_until_done(job, None)
    }

    /// The same, with something that answers the module's requests.
    pub fn run_with(
        &mut self,
        job: &Job<'_>,
        responder: &mut dyn Responder,
    ) -> Result<Outcome, JobError> {
        self.run_until_done(job, Some(responder))
    }

    /// Makes the bits of the stalls, unless the last run had the same.
    pub(crate) fn prepare(&mut self, stalls: Stalls) -> &[u32] {
        if self.gates.0 != stalls || self.gates.1.is_empty() {
            let layout = self.model.library().layout();
            let inputs = layout.mask(Direction::Input);
            self.gates = (stalls, stalls.gates(layout.streams.len(), inputs));
        }
        &self.gates.1
    }

    fn run_until_done(
        &mut self,
        job: &Job<'_>,
        responder: Option<&mut dyn Responder>,
    ) -> Result<Outcome, JobError> {
        let library = self.model.library().clone();
        let (interface, layout) = (library.interface(), library.layout());
        job.check(interface, library.probes(), layout, responder.is_some())?;
        let watched = Watched::new(interface.module);
        for (index, &value) in job.statics.iter().enumerate() {
            self.model.poke(layout.static_input(index), value);
        }
        if self.fresh {
            self.reset();
        }
        self.prepare(job.stalls);
        let start = self.cycle;
        let mut run = Run::new(&library, job, &self.gates.1, &self.junk);
        let (result, end) = run.go(&mut self.model, start, job.limits, responder, &watched);
        self.cycle = end;
        self.model.trace_flush();
        let result = result.and_then(|()| run.check_end(&self.model, end - 1, job.flags));
        Ok(match result {
            Ok(()) => Outcome::Passed(run.counts(start, end, interface)),
            Err(outcome) => outcome,
        })
    }
}
