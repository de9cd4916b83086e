//! The entries of the regression, and the runs that make them: of a directed case, of random beats, of a scene.

use super::attempt::Attempt;
use super::batches::{batches, default_beats, directed_stalls, Batch};
use super::entry::{Entry, SceneEntry};
use super::error::RegressionError;
use super::event::Event;
use super::ground::Ground;
use super::plan::{NamedScene, Waves, MEASURED_LATENCY};
use super::run::{run_case, run_scene, SceneRan, Setting};
use super::work::RANDOM;
use crate::cases::Case;
use crate::{Pattern, Stalls};
use std::time::Instant;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::progress::Stage;

/// Last cycle of waveforms that are written of a case that passed.
const HEAD: u64 = 2_000;

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
            Err(error) => entry.waves_error = Some(error),
        }
    }
    Ok(())
}

/// Runs a directed case with all its stalls.
pub(super) fn directed(ground: &Ground, case: &Case) -> Result<Entry, RegressionError> {
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

/// Runs the random beats of a target.
pub(super) fn random(ground: &Ground) -> Result<Entry, RegressionError> {
    let (plan, target) = (ground.plan, ground.target);
    let mut entry = Entry::new(target, RANDOM);
    let asked = plan.beats.unwrap_or(default_beats(target));
    let of = usize::try_from(asked).ok();
    let stage = Stage::counted(format!("{} random", target.name()), "beats", of);
    for Batch { seed, size, case } in batches(target, &plan.settings.config, plan.seed, plan.beats)
    {
        let setting = ground.setting(seed, Stalls::of_seed(seed));
        try_case(ground, &mut entry, &case, Some(size), &setting)?;
        if !entry.passed() {
            break;
        }
        stage.done(entry.beats);
    }
    Ok(entry)
}

/// Draws a scene three times: without stalls and with a steady memory, where throughput is measured;
/// then with a memory of random latency, once with stalls on both sides and once with back-pressure
/// alone, which keeps everything inside full.
pub(super) fn draw(ground: &Ground, scene: &NamedScene) -> Result<Entry, RegressionError> {
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
        let run = |setting: &Setting| run_scene(setting, target, &scene.job);
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
