//! Running one case, or one scene, on a model.

use super::error::RegressionError;
use crate::cases::{recorded, Case};
use crate::memory::{compare_frames, Memory, MemoryFault};
use crate::{Bench, Counts, Job, Library, Outcome, Responder, Stalls, TraceWindow};
use std::time::{Duration, Instant};
use wheatstone_golden::frame::Frames;
use wheatstone_golden::interface::{Direction, Interface, Table};
use wheatstone_golden::primary::{Counts as Drawn, Primary};
use wheatstone_golden::record::{Recording, Tape};
use wheatstone_golden::stereo::Job as Scene;
use wheatstone_golden::targets::Target;

/// Beats after which a scene goes on in a new part, so that memory stays bounded.
const PART: usize = 1 << 17;

/// The circumstances of a run.
#[derive(Clone)]
pub struct Setting<'a> {
    /// The model.
    pub library: &'a Library,
    /// Seed of the initial state, of the stalls and of the memory's latency.
    pub seed: u64,
    /// Stall patterns.
    pub stalls: Stalls,
    /// Latency of the memory; random where none is fixed.
    pub latency: Option<u64>,
    /// Waveforms to write.
    pub trace: Option<TraceWindow>,
}

/// The result of a run.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Result of the comparison of streams.
    pub outcome: Outcome,
    /// Counts of the whole run, also of one that failed later.
    pub counts: Counts,
    /// Differences that only the memory could see.
    pub memory: Vec<MemoryFault>,
    /// Beats that the golden model says, of the part that failed.
    pub recording: Option<Box<Recording>>,
}

impl Ran {
    /// True if everything was compared and equal.
    pub fn passed(&self) -> bool {
        matches!(self.outcome, Outcome::Passed(_)) && self.memory.is_empty()
    }
}

/// A bench with everything that a run of the case needs.
struct Runner<'a> {
    setting: &'a Setting<'a>,
    bench: Bench,
    interface: Interface,
    counts: Counts,
}

impl<'a> Runner<'a> {
    fn new(setting: &'a Setting<'a>) -> Result<Runner<'a>, RegressionError> {
        let mut bench = Bench::new(setting.library, setting.seed)?;
        if let Some(window) = &setting.trace {
            bench.trace(window)?;
        }
        let interface = setting.library.interface().clone();
        Ok(Runner { setting, bench, interface, counts: Counts::default() })
    }

    /// Runs a case; a responder takes the place of its tables of answers.
    fn run(
        &mut self,
        case: &Case,
        responder: Option<&mut dyn Responder>,
    ) -> Result<Outcome, RegressionError> {
        let (mut inputs, mut outputs) = (case.inputs.iter(), case.outputs.iter());
        let mut tables: Vec<Option<&Table>> = Vec::new();
        for stream in &self.interface.streams {
            let table = match stream.direction {
                Direction::Input => inputs.next(),
                Direction::Output => outputs.next(),
            };
            // The memory answers, not a table.
            tables.push(table.filter(|_| responder.is_none() || stream.answers.is_none()));
        }
        // A model may be built without probes, for speed.
        let probed = !self.setting.library.probes().is_empty();
        let probes = case.probes.iter().filter(|_| probed).map(|(_, table)| Some(table));
        let probes: Vec<Option<&Table>> = probes.collect();
        let job = Job {
            statics: &case.statics,
            tables: &tables,
            flags: &case.flags,
            probes: &probes,
            stalls: self.setting.stalls,
            ..Job::default()
        };
        let outcome = match responder {
            Some(responder) => self.bench.run_with(&job, responder)?,
            None => self.bench.run(&job)?,
        };
        if let Outcome::Passed(counts) = &outcome {
            self.counts.add(counts);
        }
        Ok(outcome)
    }

    fn memory(&self, frames: Frames) -> Memory {
        Memory::new(&self.interface, frames, self.setting.latency, self.setting.seed)
    }

    fn finish(
        self,
        outcome: Outcome,
        memory: Vec<MemoryFault>,
        recording: Option<Recording>,
    ) -> Ran {
        Ran { outcome, counts: self.counts, memory, recording: recording.map(Box::new) }
    }
}

/// Runs a case on a model.
pub fn run_case(setting: &Setting, case: &Case) -> Result<Ran, RegressionError> {
    run_case_watched(setting, case, None)
}

/// A beat of an output that was taken.
pub(super) struct Taken<'a> {
    /// Number of the beat in its stream.
    pub number: u64,
    /// Cycle after the reset.
    pub cycle: u64,
    /// Its fields.
    pub row: &'a [u64],
}

/// Passes everything on to a memory, if there is one, and tells of every beat taken.
struct Tap<'a> {
    memory: Option<&'a mut Memory>,
    counts: Vec<u64>,
    watch: &'a mut dyn FnMut(Taken),
}

impl Responder for Tap<'_> {
    fn accepted(&mut self, stream: usize, cycle: u64, row: &[u64]) {
        (self.watch)(Taken { number: self.counts[stream], cycle, row });
        self.counts[stream] += 1;
        if let Some(memory) = &mut self.memory {
            memory.accepted(stream, cycle, row);
        }
    }
    fn respond(&mut self, stream: usize, cycle: u64, row: &mut [u64]) -> bool {
        self.memory.as_mut().is_some_and(|memory| memory.respond(stream, cycle, row))
    }
}

/// Runs a case on a model and tells of every output beat.
pub(super) fn run_case_watched(
    setting: &Setting,
    case: &Case,
    watch: Option<&mut dyn FnMut(Taken)>,
) -> Result<Ran, RegressionError> {
    let mut runner = Runner::new(setting)?;
    let counts = vec![0; runner.interface.streams.len()];
    let Some([before, after]) = case.memory.as_deref() else {
        let mut tap = watch.map(|watch| Tap { memory: None, counts, watch });
        let outcome = runner.run(case, tap.as_mut().map(|tap| tap as &mut dyn Responder))?;
        return Ok(runner.finish(outcome, Vec::new(), None));
    };
    let mut memory = runner.memory(before.clone());
    memory.expect(case.responses());
    let outcome = match watch {
        None => runner.run(case, Some(&mut memory))?,
        Some(watch) => {
            let tap = &mut Tap { memory: Some(&mut memory), counts, watch };
            runner.run(case, Some(tap))?
        }
    };
    let mut faults: Vec<MemoryFault> = memory.stale.take().into_iter().collect();
    if matches!(outcome, Outcome::Passed(_)) {
        faults.extend(compare_frames(after, &memory.frames));
    }
    Ok(runner.finish(outcome, faults, None))
}

/// A scene that a system drew.
pub struct SceneRan {
    /// The result of the last part.
    pub ran: Ran,
    /// Counts of its polygons, by the way in which they were drawn.
    pub drawn: Drawn,
    /// The frame buffers that the Verilog filled.
    pub frames: Frames,
    /// Time in the simulation, comparison included, the golden model left out.
    pub simulation: Duration,
}

/// Draws a scene with the golden model and the Verilog side by side.
pub fn run_scene(
    setting: &Setting,
    target: Target,
    scene: &Scene,
) -> Result<SceneRan, RegressionError> {
    let minimal = target == Target::Minimal;
    let scene = &target.job(scene);
    let mut runner = Runner::new(setting)?;
    let mut memory = runner.memory(scene.frames(minimal));
    let mut primary = Primary::new(scene.planner(minimal), scene.textures, scene.lookup);
    let mut tape = Tape::new(scene, minimal, false);
    let what = format!("drawing with {}", target.name());
    let mut polygons = scene.pieces(&what).peekable();
    let mut simulation = Duration::ZERO;
    loop {
        while let Some(polygon) = polygons.next_if(|_| tape.len() < PART) {
            primary.draw(&polygon, tape.sink());
        }
        let done = polygons.peek().is_none();
        let recording = tape.take();
        let case = recorded(target, scene, "scene", &recording);
        memory.expect(case.responses());
        let start = Instant::now();
        let last = runner.run(&case, Some(&mut memory))?;
        simulation += start.elapsed();
        let failed = !matches!(last, Outcome::Passed(_)) || memory.stale.is_some();
        if failed || done {
            let mut faults: Vec<MemoryFault> = memory.stale.take().into_iter().collect();
            if !failed {
                faults = compare_frames(tape.frames(), &memory.frames);
            }
            let ran = runner.finish(last, faults, failed.then_some(recording));
            let (drawn, frames) = (primary.counts, memory.frames);
            return Ok(SceneRan { ran, drawn, frames, simulation });
        }
    }
}
