//! Batches of random beats, and the stalls of directed cases.

use super::plan::{SYSTEM_BEATS, UNIT_BEATS};
use crate::cases::{self, Case};
use crate::{Pattern, Stalls};
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;

/// Random beats of one batch: with these, a unit's default regression crosses all stall patterns.
const BATCH: u64 = 23_800;
/// Beats of a system's batch, which has stalls of its own too.
const SYSTEM_BATCH: u64 = 4_760;
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

/// Random beats of a target in the default regression.
pub(super) fn default_beats(target: Target) -> u64 {
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
