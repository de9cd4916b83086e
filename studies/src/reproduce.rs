//! Running experiments and writing what they found.
//!
//! Of every experiment its folder holds `report.json`, `tables.txt` and its plots and pictures.

use crate::{Experiment, Report, StudyError, Verdict};
use serde_json::json;
use std::path::Path;
use std::time::{Duration, Instant};
use wheatstone_golden::files::{self, Set, WriteError};
use wheatstone_golden::progress::Stage;

/// An event while experiments run.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// An experiment begins.
    Begin(&'a Experiment),
    /// An experiment has ended after this time; its files are written.
    End(&'a Report, Duration),
}

/// Numbers of figures that hold, differ, and are not judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Summary {
    /// Figures that hold.
    pub holds: usize,
    /// Figures that do not.
    pub differs: usize,
    /// Figures that are not judged, as what depends on the machine.
    pub trend: usize,
    /// Printed figures that are not computed, but others are with them.
    pub quoted: usize,
}

impl Summary {
    /// Counts the figures of some reports.
    pub fn of(reports: &[Report]) -> Summary {
        let mut summary = Summary::default();
        for row in reports.iter().flat_map(Report::rows) {
            *match row.verdict() {
                Verdict::Holds => &mut summary.holds,
                Verdict::Differs => &mut summary.differs,
                Verdict::Trend => &mut summary.trend,
                Verdict::Quoted => &mut summary.quoted,
            } += 1;
        }
        summary
    }
}

/// Runs experiments one after another, as they time things; each writes into the folder of its
/// name in `out`, which has all files of one run. Folders are made if need be.
pub fn run(
    experiments: &[Experiment],
    out: &Path,
    mut tell: impl FnMut(Event),
) -> Result<Vec<Report>, StudyError> {
    // All folders before any work, so that one that cannot be made costs none.
    let sets: Result<Vec<Set>, _> =
        experiments.iter().map(|e| Set::new(&out.join(e.name))).collect();
    let mut reports = Vec::new();
    for (experiment, set) in experiments.iter().zip(sets?) {
        tell(Event::Begin(experiment));
        let _stage = Stage::new(format!("computing {}", experiment.name));
        let start = Instant::now();
        let named = |error| match error {
            StudyError::Write(error) => {
                StudyError::Write(WriteError { file: set.named(&error.file), ..error })
            }
            other => other,
        };
        let mut report = (experiment.run)(set.path()).map_err(named)?;
        report.files.iter_mut().for_each(|file| *file = set.named(file));
        let tables: String = report.tables.iter().map(|table| format!("{table}\n")).collect();
        files::write(&set.path().join("tables.txt"), tables.as_bytes())?;
        let json = format!("{:#}\n", report.json());
        files::write(&set.path().join("report.json"), json.as_bytes())?;
        set.finish("report.json", |_| false)?;
        tell(Event::End(&report, start.elapsed()));
        reports.push(report);
    }
    Ok(reports)
}

/// All reports as one JSON text; `command` is what was called.
pub fn json(reports: &[Report], command: &str) -> String {
    let content = json!({
        "command": command,
        "version": env!("CARGO_PKG_VERSION"),
        "summary": Summary::of(reports),
        "experiments": reports.iter().map(Report::json).collect::<Vec<_>>(),
    });
    format!("{content:#}\n")
}
