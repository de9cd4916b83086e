//! The regression: which cases run on which target, side by side, and what came of them.
//!
//! Rules: a case follows from target, configuration, seed and number of beats alone. Random beats
//! come in batches; batch n of seed s is batch 0 of seed s + n, with stall patterns chosen by the same
//! number, so that one failing batch can be repeated by itself.

mod error;
mod failure;
mod models;
mod report;
mod run;
mod waves;

pub use error::RegressionError;
pub use failure::{Failure, Location};
pub(crate) use report::counted;
pub use report::{drawn_line, json, junit, table};
pub use run::{model_probes, run_case, run_scene, MemoryFault, Ran, SceneRan, Setting};
pub use waves::{record_waves, scene_head, Focus, Head, Waves as WaveFile};

use crate::cases::{self, Case};
use crate::settings::Settings;
use crate::watch;
use crate::{Builder, Library, Pattern, Stalls};
use failure::Attempt;
use models::Models;
use rayon::prelude::*;
use std::cell::RefCell;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::Frames;
use wheatstone_golden::primary::Counts as Drawn;
use wheatstone_golden::stereo::Job as Scene;
use wheatstone_golden::targets::Target;
use wheatstone_process::Patience;

/// Most random beats of a target in one run: some hours.
pub const BEATS_LIMIT: u64 = 1_000_000_000;
/// Random beats of a unit in the default regression.
pub const UNIT_BEATS: u64 = 1_000_000;
/// Random beats of a system in the default regression.
pub const SYSTEM_BEATS: u64 = 200_000;
/// Random beats of one batch: with these, a unit's default regression crosses all stall patterns.
const BATCH: u64 = 23_800;
/// Beats of a system's batch, which has stalls of its own too.
const SYSTEM_BATCH: u64 = 4_760;
/// Name of the case of random beats.
const RANDOM: &str = "random";
/// Last cycle of waveforms that are written of a case that passed.
const HEAD: u64 = 2_000;
/// Latency of the memory when throughput is measured, in clocks.
pub const MEASURED_LATENCY: u64 = 4;

/// When waveforms are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Waves {
    /// A case that failed is run again with waveforms around the difference.
    #[default]
    OnFailure,
    /// Waveforms of every target's first case.
    Always,
    /// None.
    Never,
}

/// A named scene, ready to draw.
pub struct NamedScene<'a> {
    /// Name or file, as on the command line.
    pub name: String,
    /// What to draw.
    pub job: Scene<'a>,
}

/// What to run.
pub struct Plan<'a> {
    /// Units and systems.
    pub targets: Vec<Target>,
    /// Build parameters and choices.
    pub settings: Settings,
    /// The program, for the command that repeats a case.
    pub program: String,
    /// The options of that command that all cases have in common, word by word.
    pub words: Vec<String>,
    /// Only cases of this name.
    pub case: Option<String>,
    /// Scenes for the systems.
    pub scenes: Vec<NamedScene<'a>>,
    /// Leave out directed and random cases of systems.
    pub scenes_only: bool,
    /// Seed.
    pub seed: u64,
    /// Random beats; the default differs between units and systems.
    pub beats: Option<u64>,
    /// Worker threads.
    pub jobs: usize,
    /// Waveforms.
    pub waves: Waves,
    /// Folder of the Verilog.
    pub rtl: PathBuf,
    /// Folder for waveforms.
    pub out: PathBuf,
}

/// One result.
pub struct Entry {
    /// Unit or system.
    pub target: Target,
    /// What was run.
    pub name: String,
    /// Runs with different stalls that this entry sums up.
    pub runs: u64,
    /// Beats offered to the target's main input.
    pub beats: u64,
    /// Output beats compared, those of units inside a system included.
    pub compared: u64,
    /// Clocks simulated.
    pub clocks: u64,
    /// Time in the simulation, comparison included.
    pub time: Duration,
    /// What a scene says besides.
    pub scene: Option<SceneEntry>,
    /// The first difference.
    pub failure: Option<Failure>,
    /// Waveforms written on request.
    pub waves: Option<PathBuf>,
    /// Why there are none.
    pub waves_error: Option<String>,
}

/// What there is to say of a scene.
pub struct SceneEntry {
    /// How its polygons were drawn.
    pub drawn: Drawn,
    /// The frame buffers that the Verilog filled.
    pub frames: Frames,
    /// Pixels of both frame buffers compared.
    pub pixels: u64,
    /// Pixels written for each eye.
    pub written: [u64; 2],
    /// Clocks from the first beat to the last, without stalls from outside.
    pub clocks: u64,
    /// Share of those on which a beat was taken.
    pub acceptance: f64,
}

/// What the regression tells while it runs.
pub enum Event<'a> {
    /// A model is being built, or was.
    Build(crate::Progress<'a>),
    /// So many cases there are.
    Planned(usize),
    /// A case begins.
    Begin(Target, &'a str),
    /// A case is run with these stalls.
    Run(&'a Case, Stalls),
    /// A case failed; waveforms come next.
    Mismatch(&'a Failure),
    /// A case has ended.
    End(&'a Entry),
}

/// A piece of work: what one entry reports.
enum Work<'a> {
    Directed(Target, usize),
    Random(Target),
    Scene(Target, &'a NamedScene<'a>),
}

/// What the runs of an entry have in common.
struct Ground<'a> {
    plan: &'a Plan<'a>,
    tell: &'a (dyn Fn(Event) + Sync),
    library: Library,
    target: Target,
}

/// Runs a plan; entries come in the order of the targets.
pub fn run(
    plan: &Plan,
    builder: &Builder,
    tell: &(dyn Fn(Event) + Sync),
) -> Result<Vec<Entry>, RegressionError> {
    let models = Models::new(builder, plan);
    let work = list_work(plan);
    tell(Event::Planned(work.len()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(plan.jobs).build()?;
    // The longest work first, so that it does not end up alone at the end.
    let mut order: Vec<usize> = (0..work.len()).collect();
    order.sort_by_key(|&n| match work[n] {
        Work::Scene(..) => 0,
        Work::Random(target) if target.is_system() => 1,
        Work::Random(_) => 2,
        Work::Directed(..) => 3,
    });
    let mut entries: Vec<(usize, Entry)> = pool.install(|| {
        let one = |&n: &usize| do_work(plan, &models, &work[n], tell).map(|entry| (n, entry));
        order.par_iter().with_max_len(1).map(one).collect::<Result<Vec<_>, RegressionError>>()
    })?;
    entries.sort_by_key(|(n, _)| *n);
    Ok(entries.into_iter().map(|(_, entry)| entry).collect())
}

fn list_work<'a>(plan: &'a Plan<'a>) -> Vec<Work<'a>> {
    let is_wanted = |name: &str| plan.case.as_deref().is_none_or(|case| case == name);
    let mut work = Vec::new();
    for &target in &plan.targets {
        if !(plan.scenes_only && target.is_system()) {
            let directed = cases::directed(target, &plan.settings.config);
            let wanted = (0..directed.len()).filter(|&n| is_wanted(&directed[n].name));
            work.extend(wanted.map(|n| Work::Directed(target, n)));
            if is_wanted(RANDOM) {
                work.push(Work::Random(target));
            }
        }
        if target.is_system() {
            let wanted = plan.scenes.iter().filter(|scene| is_wanted(&scene.name));
            work.extend(wanted.map(|scene| Work::Scene(target, scene)));
        }
    }
    work
}

/// Names of the cases that targets have besides scenes, each once.
pub fn case_names(targets: &[Target], settings: &Settings) -> Vec<String> {
    let mut names = Vec::new();
    for &target in targets {
        let directed = cases::directed(target, &settings.config).into_iter().map(|case| case.name);
        for name in directed.chain([RANDOM.to_owned()]) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

fn do_work(
    plan: &Plan,
    models: &Models,
    work: &Work,
    tell: &(dyn Fn(Event) + Sync),
) -> Result<Entry, RegressionError> {
    let ground = |target: Target| -> Result<Ground, RegressionError> {
        Ok(Ground { plan, tell, library: models.get(target)?, target })
    };
    let begin = |target: Target, case: &str| {
        watch::case(target.name(), case);
        tell(Event::Begin(target, case));
    };
    let entry = match work {
        Work::Directed(target, n) => {
            let case = cases::directed(*target, &plan.settings.config).swap_remove(*n);
            begin(*target, &case.name);
            directed(&ground(*target)?, &case)?
        }
        Work::Random(target) => {
            begin(*target, RANDOM);
            random(&ground(*target)?)?
        }
        Work::Scene(target, scene) => {
            begin(*target, &scene.name);
            draw(&ground(*target)?, scene)?
        }
    };
    tell(Event::End(&entry));
    Ok(entry)
}

impl Entry {
    fn new(target: Target, name: &str) -> Entry {
        Entry {
            target,
            name: name.into(),
            runs: 0,
            beats: 0,
            compared: 0,
            clocks: 0,
            time: Duration::ZERO,
            scene: None,
            failure: None,
            waves: None,
            waves_error: None,
        }
    }

    /// Whether all that was compared is equal.
    pub fn passed(&self) -> bool {
        self.failure.is_none()
    }

    /// Whether there was nothing that could have differed, which is no pass.
    pub fn is_vain(&self) -> bool {
        self.passed() && self.compared == 0
    }

    /// Counts a run.
    fn add(&mut self, ran: &Ran, beats: u64, time: Duration) {
        self.runs += 1;
        self.beats += beats;
        self.compared += ran.counts.compared() + ran.counts.probed;
        self.clocks += ran.counts.simulated;
        self.time += time;
    }
}

impl Ground<'_> {
    fn setting(&self, seed: u64, stalls: Stalls) -> Setting<'_> {
        let latency = self.plan.settings.latency;
        Setting { library: &self.library, seed, stalls, latency, trace: None }
    }
}

/// Runs a case and, if it fails or waveforms of all are wanted, once more with waveforms.
fn try_case(
    ground: &Ground,
    entry: &mut Entry,
    case: &Case,
    beats: Option<u64>,
    setting: &Setting,
) -> Result<(), RegressionError> {
    (ground.tell)(Event::Run(case, setting.stalls));
    let start = Instant::now();
    let ran = run_case(setting, case)?;
    entry.add(&ran, case.beats(), start.elapsed());
    let attempt = Attempt { ground, case: &entry.name, run: entry.runs, beats, setting };
    let again = |trace: &Setting| run_case(trace, case).map(drop);
    if !ran.passed() {
        entry.failure = Some(attempt.fail(&ran, again));
    } else if ground.plan.waves == Waves::Always && entry.runs == 1 {
        match attempt.waves(0..=HEAD, None, again) {
            Ok(file) => entry.waves = Some(file),
            Err(error) => entry.waves_error = Some(error.to_string()),
        }
    }
    Ok(())
}

/// The stalls with which a directed case is run.
pub(crate) fn directed_stalls(case: &Case, seed: u64) -> Vec<Stalls> {
    let crossed = [
        Stalls::NONE,
        Stalls { idle: Pattern::Random50, back_pressure: Pattern::UntilValid, seed },
        Stalls { idle: Pattern::None, back_pressure: Pattern::Bursts, seed },
        Stalls { idle: Pattern::Gaps, back_pressure: Pattern::Random50, seed },
    ];
    match case.all_stalls {
        true => Stalls::crossed(seed).collect(),
        false => crossed.to_vec(),
    }
}

fn directed(ground: &Ground, case: &Case) -> Result<Entry, RegressionError> {
    let mut entry = Entry::new(case.target, &case.name);
    let (seed, beats) = (ground.plan.seed, ground.plan.beats);
    for stalls in directed_stalls(case, seed) {
        try_case(ground, &mut entry, case, beats, &ground.setting(seed, stalls))?;
        if !entry.passed() {
            break;
        }
    }
    Ok(entry)
}

/// Random beats of a target in the default regression.
fn default_beats(target: Target) -> u64 {
    if target.is_system() {
        SYSTEM_BEATS
    } else {
        UNIT_BEATS
    }
}

/// A batch of random beats.
pub(crate) struct Batch {
    /// Its seed, which also chooses the stalls.
    pub seed: u64,
    /// Beats asked for.
    pub size: u64,
    /// The case.
    pub case: Case,
}

/// The batches of a target's random beats; none means as many as in the default regression.
pub(crate) fn batches(
    target: Target,
    config: &Config,
    seed: u64,
    beats: Option<u64>,
) -> impl Iterator<Item = Batch> {
    let batch = if target.is_system() { SYSTEM_BATCH } else { BATCH };
    let (mut left, mut seed, config) = (beats.unwrap_or(default_beats(target)), seed, *config);
    std::iter::from_fn(move || {
        let size = Some(batch.min(left)).filter(|size| *size > 0)?;
        let case = cases::random(target, &config, seed, size as usize);
        let made = Batch { seed, size, case };
        left = left.saturating_sub(made.case.beats());
        seed = seed.wrapping_add(1);
        Some(made)
    })
}

fn random(ground: &Ground) -> Result<Entry, RegressionError> {
    let (plan, target) = (ground.plan, ground.target);
    let mut entry = Entry::new(target, RANDOM);
    let mut patience = Patience::new();
    for Batch { seed, size, case } in batches(target, &plan.settings.config, plan.seed, plan.beats)
    {
        let setting = ground.setting(seed, Stalls::of_seed(seed));
        try_case(ground, &mut entry, &case, Some(size), &setting)?;
        if !entry.passed() {
            break;
        }
        let asked = plan.beats.unwrap_or(default_beats(target));
        patience
            .tell(|| format!("{} random: {} of {asked} beats so far", target.name(), entry.beats));
    }
    Ok(entry)
}

/// Draws a scene three times: without stalls and with a steady memory, where throughput is measured;
/// then with a memory of random latency, once with stalls on both sides and once with back-pressure
/// alone, which keeps everything inside full.
fn draw(ground: &Ground, scene: &NamedScene) -> Result<Entry, RegressionError> {
    let (plan, target) = (ground.plan, ground.target);
    let mut entry = Entry::new(target, &scene.name);
    let steady = Some(plan.settings.latency.unwrap_or(MEASURED_LATENCY));
    let stalled = Stalls::of_seed(plan.seed.wrapping_mul(7).wrapping_add(8));
    let [_, patterns @ ..] = Pattern::BACK_PRESSURE;
    let back_pressure = patterns[(plan.seed % patterns.len() as u64) as usize];
    let full = Stalls { idle: Pattern::None, back_pressure, seed: plan.seed };
    let latency = plan.settings.latency;
    for (stalls, latency) in [(Stalls::NONE, steady), (stalled, latency), (full, latency)] {
        let setting = Setting { latency, ..ground.setting(plan.seed, stalls) };
        let patience = RefCell::new(Patience::new());
        let told = |drawn| {
            let (target, all) = (target.name(), scene.job.polygons.len());
            let text = || format!("{target} {}: {drawn} of {all} polygons so far", scene.name);
            patience.borrow_mut().tell(text);
        };
        let run = |setting: &Setting| run_scene(setting, target, &scene.job, told);
        let SceneRan { ran, drawn, frames, simulation } = run(&setting)?;
        entry.add(&ran, drawn.beats(), simulation);
        if !ran.passed() {
            let (case, run_number) = (&scene.name, entry.runs);
            let attempt =
                Attempt { ground, case, run: run_number, beats: plan.beats, setting: &setting };
            entry.failure = Some(attempt.fail(&ran, |trace| run(trace).map(drop)));
            break;
        }
        if entry.scene.is_none() {
            let beat = ran.counts.stream("beat");
            // Inside the stereo pipeline the beats are the drawn ones, on any clock.
            let clocks = beat.map_or(ran.counts.clocks, |s| s.active);
            let drawn_share = drawn.beats() as f64 / ran.counts.clocks.max(1) as f64;
            let pixels =
                Eye::BOTH.iter().map(|&e| frames.eyes[e as usize].colour.len() as u64).sum();
            let acceptance = beat.map_or(drawn_share, |s| s.throughput());
            let written = frames.written;
            entry.scene = Some(SceneEntry { drawn, frames, pixels, written, clocks, acceptance });
        }
    }
    Ok(entry)
}
