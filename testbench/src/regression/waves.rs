//! Waveforms on demand: of random beats, of the beginning of a scene, of a polygon or a pixel.

use super::error::RegressionError;
use super::models::model_probes;
use super::plan::MEASURED_LATENCY;
use super::run::{run_case, run_case_watched, Setting};
use crate::cases::{self, case_of, part, scene_head, Case};
use crate::settings::Settings;
use crate::waves::{Dump, View};
use crate::{Builder, Spec, Stalls};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::NO_ID;
use wheatstone_golden::stereo::Job as Scene;
use wheatstone_golden::targets::Target;

/// Beats shown where nothing is in focus.
const HEAD: usize = 300;
/// Cycles shown before and after a marked one.
const AROUND: [u64; 2] = [60, 60];
/// Longest stretch shown without a mark.
const LONGEST: u64 = 4_000;

/// The part of a run that waveforms show.
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
        latency: Some(settings.latency.unwrap_or(MEASURED_LATENCY)),
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
    run_case(&setting, &case)?;
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
