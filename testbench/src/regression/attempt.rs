//! One run of a case, and its repetition with waveforms.

use super::error::RegressionError;
use super::event::Event;
use super::failure::Failure;
use super::ground::Ground;
use super::plan::Waves;
use super::run::{Ran, Setting};
use crate::shell::command_line;
use crate::waves::{Dump, View};
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// Cycles shown before a difference.
const BEFORE: u64 = 100;
/// Cycles shown after it.
const AFTER: u64 = 20;

/// One run of a case.
pub(super) struct Attempt<'a> {
    pub ground: &'a Ground<'a>,
    /// Name of the entry.
    pub case: &'a str,
    /// Number of the run in its entry, from 1.
    pub run: u64,
    /// Random beats that the case was made of, or that were asked for.
    pub beats: Option<u64>,
    pub setting: &'a Setting<'a>,
}

impl Attempt<'_> {
    /// The report of a run that failed; `again` repeats it with waveforms. It is told of before that:
    /// whatever becomes of the waveforms, the difference is known.
    pub fn fail(
        &self,
        ran: &Ran,
        again: impl FnOnce(&Setting) -> Result<(), RegressionError>,
    ) -> Failure {
        let target = self.ground.target;
        let mut failure = Failure::new(target, self.case, self.setting, self.repeat(), ran);
        (self.ground.tell)(Event::Mismatch(&failure));
        if let Some(cycle) = failure.cycle.filter(|_| self.ground.plan.waves != Waves::Never) {
            let cycles = cycle.saturating_sub(BEFORE)..=cycle + AFTER;
            match self.waves(cycles, Some((cycle, "first mismatch")), again) {
                Ok(file) => failure.waves = Some(file),
                Err(error) => failure.waves_error = Some(error.to_string()),
            }
        }
        failure
    }

    /// Writes waveforms and their views; `again` repeats the run.
    pub fn waves(
        &self,
        cycles: RangeInclusive<u64>,
        marker: Option<(u64, &str)>,
        again: impl FnOnce(&Setting) -> Result<(), RegressionError>,
    ) -> Result<PathBuf, RegressionError> {
        let Ground { plan, library, target, .. } = self.ground;
        let dump = Dump::new(cycles)?;
        again(&Setting { trace: Some(dump.window()), ..self.setting.clone() })?;
        let out = &plan.out;
        fs::create_dir_all(out)
            .map_err(|source| RegressionError::File { path: out.clone(), source })?;
        let (target, case, seed) = (target.name(), slug(self.case), self.setting.seed);
        let place = out.join(format!("{target}-{case}-seed{seed}-run{}.fst", self.run));
        let (interface, units) = (library.interface(), library.probes());
        dump.deliver(&place, &View { interface, units, marker })?;
        Ok(place)
    }

    /// The command that repeats the case from its seed.
    fn repeat(&self) -> String {
        let Ground { plan, target, .. } = self.ground;
        let (seed, beats) = (self.setting.seed.to_string(), self.beats.map(|n| n.to_string()));
        let mut words = vec![plan.program.as_str(), "cosim", target.name()];
        words.extend(plan.words.iter().map(String::as_str));
        words.extend(["--case", self.case, "--seed", &seed]);
        words.extend(beats.iter().flat_map(|beats| ["--beats", beats]));
        command_line(words)
    }
}

/// A case's name as part of the name of a file.
fn slug(case: &str) -> String {
    let stem = Path::new(case).file_stem().unwrap_or_default().to_string_lossy();
    let words = stem.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty());
    words.collect::<Vec<_>>().join("-")
}
