//! A plan of the regression, and the numbers of the default one.

use crate::settings::Settings;
use std::path::PathBuf;
use wheatstone_golden::stereo::Job as Scene;
use wheatstone_golden::targets::Target;

/// Most random beats of a target in one run: some hours.
pub const BEATS_LIMIT: u64 = 1_000_000_000;
/// Random beats of a unit in the default regression.
pub const UNIT_BEATS: u64 = 1_000_000;
/// Random beats of a system in the default regression.
pub const SYSTEM_BEATS: u64 = 200_000;
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
    /// Its polygons, and how they are drawn.
    pub job: Scene<'a>,
}

/// The targets, cases and choices of a regression.
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
