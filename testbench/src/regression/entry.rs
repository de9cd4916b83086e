//! A result of the regression.

use super::error::RegressionError;
use super::failure::Failure;
use super::run::Ran;
use std::path::PathBuf;
use std::time::Duration;
use wheatstone_golden::frame::Frames;
use wheatstone_golden::primary::Counts as Drawn;
use wheatstone_golden::targets::Target;

/// One result.
pub struct Entry {
    /// Unit or system.
    pub target: Target,
    /// The case.
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
    /// The figures of a scene.
    pub scene: Option<SceneEntry>,
    /// The first difference.
    pub failure: Option<Failure>,
    /// Waveforms written on request.
    pub waves: Option<PathBuf>,
    /// The reason why there are none.
    pub waves_error: Option<RegressionError>,
}

/// The figures of a scene.
pub struct SceneEntry {
    /// Counts of its polygons, by the way in which they were drawn.
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

impl Entry {
    pub(super) fn new(target: Target, name: &str) -> Entry {
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

    /// Target and case.
    pub fn title(&self) -> String {
        format!("{} {}", self.target.name(), self.name)
    }

    /// True if all that was compared is equal.
    pub fn passed(&self) -> bool {
        self.failure.is_none()
    }

    /// True if there was nothing that could have differed, which is no pass.
    pub fn is_vain(&self) -> bool {
        self.passed() && self.compared == 0
    }

    /// Counts a run.
    pub(super) fn add(&mut self, ran: &Ran, beats: u64, time: Duration) {
        self.runs += 1;
        self.beats += beats;
        self.compared += ran.counts.compared() + ran.counts.probed;
        self.clocks += ran.counts.simulated;
        self.time += time;
    }
}
