//! Waveforms on demand: of random beats, of the beginning of a scene, of a polygon or a pixel.

use super::run::{model_probes, run_case_watched, Setting};
use super::RegressionError;
use crate::cases::{self, Case};
use crate::settings::Settings;
use crate::waves::{Dump, View};
use crate::{Builder, Spec, Stalls};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frames, NO_ID};
use wheatstone_golden::pipeline::{Edges, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::{Primary, Sink};
use wheatstone_golden::record::{Recording, Tape};
use wheatstone_golden::stereo::{pieces, Job as Scene};
use wheatstone_golden::targets::Target;

/// Beats shown where nothing is in focus.
const HEAD: usize = 300;
/// Cycles shown before and after a marked one.
const AROUND: [u64; 2] = [60, 60];
/// Longest stretch shown without a mark.
const LONGEST: u64 = 4_000;

/// What waveforms are to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Focus {
    /// The first beats.
    Start,
    /// A polygon, by id.
    Polygon(u32),
    /// A pixel of an eye, by display column and row.
    Pixel(Eye, u32, u32),
}

/// A waveform file.
#[derive(Clone, Debug)]
pub struct Waves {
    /// The file; its views have the same name.
    pub file: PathBuf,
    /// Cycles in it.
    pub cycles: RangeInclusive<u64>,
    /// The cycle that the views mark.
    pub marker: Option<u64>,
}

/// A part of a scene.
struct Part {
    recording: Recording,
    /// Frame buffers before and after.
    frames: [Frames; 2],
    /// Pieces of polygons in it.
    pieces: usize,
}

/// Records the polygons of a scene from the first for which `wanted` holds to the last, or until
/// there are `beats`.
fn part(job: &Scene, minimal: bool, wanted: impl Fn(u32) -> bool, beats: usize) -> Option<Part> {
    let mut tape = Tape::new(job, minimal, true);
    let mut primary = Primary::new(job.planner(minimal), job.textures, job.lookup);
    let last =
        pieces(job.polygons).enumerate().filter(|(_, p)| wanted(p.id)).map(|(n, _)| n).last()?;
    let (mut before, mut drawn) = (None, 0);
    for (n, polygon) in pieces(job.polygons).enumerate().take(last + 1) {
        if before.is_none() && wanted(polygon.id) {
            tape.take();
            before = Some(tape.frames().clone());
        }
        primary.draw(&polygon, tape.sink());
        drawn += usize::from(before.is_some());
        if before.is_some() && tape.len() >= beats && n < last {
            break;
        }
        if before.is_none() {
            // What came before only matters for the frame buffers.
            tape.take();
        }
    }
    let recording = tape.take();
    let after = tape.frames().clone();
    let is_empty = recording.streams["beat"].is_empty();
    before.filter(|_| !is_empty).map(|before| Part {
        recording,
        frames: [before, after],
        pieces: drawn,
    })
}

/// The case of a target in a part of a scene.
fn case_of(target: Target, job: &Scene, name: &str, part: &Part) -> Case {
    if !target.is_system() {
        return cases::recorded_unit(target, job, name, &part.recording);
    }
    let mut case = cases::recorded(target, job, name, &part.recording);
    case.memory = Some(Box::new(part.frames.clone()));
    case
}

/// The beginning of a scene.
pub struct Head {
    /// The case of a target in it.
    pub case: Case,
    /// Its polygons, and those of the whole scene, in the order of drawing; a concave one is several.
    pub polygons: [u64; 2],
    /// Beats of the primary pipeline for them, and for the whole scene.
    pub beats: [u64; 2],
}

/// Counts beats and does nothing with them.
struct Counter;

impl Sink for Counter {
    fn polygon(&mut self, _: u32) {}
    fn walk(&mut self, _: &Walk, _: &Planes) {}
    fn records(&mut self, _: &Setup, _: &Edges) {}
    fn beat(&mut self, _: &PrimaryBeat) {}
}

/// The beginning of a scene, about `beats` beats, as a case of a target.
pub fn scene_head(target: Target, job: &Scene, name: &str, beats: usize) -> Option<Head> {
    let job = &target.job(job);
    let minimal = target == Target::Minimal;
    let part = part(job, minimal, |_| true, beats)?;
    let beats = part.recording.streams["beat"].len() as u64;
    Some(Head {
        case: case_of(target, job, name, &part),
        polygons: [part.pieces, pieces(job.polygons).count()].map(|n| n as u64),
        beats: [beats, job.run(minimal, &mut Counter).beats()],
    })
}

/// Writes waveforms of a target; none if the scene has nothing at the focus.
#[allow(clippy::too_many_arguments)] // One call site, and each argument is a different thing.
pub fn record_waves(
    target: Target,
    settings: &Settings,
    job: Option<&Scene>,
    focus: Focus,
    seed: u64,
    rtl: &Path,
    builder: &Builder,
    out: &Path,
) -> Result<Option<Waves>, RegressionError> {
    let Some((case, number)) = focused(target, settings, job, focus, seed) else { return Ok(None) };
    let config = &settings.config;
    let interface = target.interface(config);
    let probes = model_probes(target, config);
    let library = builder.build(&Spec { interface: &interface, rtl, probes: &probes })?;
    let mut setting = Setting {
        library: &library,
        seed,
        stalls: Stalls::NONE,
        latency: Some(settings.latency.unwrap_or(super::MEASURED_LATENCY)),
        trace: None,
    };
    // First without waveforms, to learn the cycle.
    let mut marker = None;
    let ran = run_case_watched(
        &setting,
        &case,
        Some(&mut |taken| {
            let wanted = match focus {
                Focus::Pixel(eye, x, y) if target.is_system() => {
                    // Pixels have eight fields, requests three.
                    taken.row.len() == 8 && taken.row[..3] == [eye as u64, x.into(), y.into()]
                }
                Focus::Pixel(..) => Some(taken.number) == number,
                _ => false,
            };
            if wanted {
                marker = Some(taken.cycle);
            }
        }),
    )?;
    let cycles = match marker {
        Some(cycle) => cycle.saturating_sub(AROUND[0])..=cycle + AROUND[1],
        None => 0..=ran.counts.simulated.clamp(64, LONGEST),
    };
    let dump = Dump::new(cycles.clone())?;
    setting.trace = Some(dump.window());
    super::run_case(&setting, &case)?;
    let file = out.join(format!("{}.fst", target.name()));
    let marked = marker.map(|cycle| (cycle, "pixel"));
    dump.deliver(&file, &View { interface: &interface, units: &probes, marker: marked })?;
    Ok(Some(Waves { file, cycles, marker }))
}

/// The case that shows the focus and, for a unit, the number of its output beat for a pixel.
fn focused(
    target: Target,
    settings: &Settings,
    job: Option<&Scene>,
    focus: Focus,
    seed: u64,
) -> Option<(Case, Option<u64>)> {
    let Some(job) = job else {
        return Some((cases::random(target, &settings.config, seed, HEAD), None));
    };
    let job = &target.job(job);
    let minimal = target == Target::Minimal;
    let id = match focus {
        Focus::Start => return Some((scene_head(target, job, "scene", HEAD)?.case, None)),
        Focus::Polygon(id) => id,
        Focus::Pixel(eye, x, y) => {
            let (frames, _) = job.derived(minimal);
            let frame = &frames.eyes[eye as usize];
            let index = frame.index(x.into(), y.into())?;
            Some(frame.id[index]).filter(|&id| id != NO_ID)?
        }
    };
    let part = part(job, minimal, |n| n == id, usize::MAX)?;
    let number = match focus {
        Focus::Pixel(_, x, y) => cases::output_number(target, &part.recording, x, y),
        _ => None,
    };
    Some((case_of(target, job, "scene", &part), number))
}
