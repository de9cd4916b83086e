//! The committed record of coverage and replay, and its tables in `docs/verification.md`.

use crate::cover::{self, Bins, FileCoverage, Report, Share};
use crate::replay::Way;
use crate::synth::record::thousands;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use thiserror::Error;
use wheatstone_golden::picture::{write_file, WriteError};
use wheatstone_golden::targets::Target;

/// Where it is in the workspace.
pub const FILE: &str = "testbench/verification.json";

/// What was measured last.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Coverage of the Verilog's files.
    pub coverage: BTreeMap<String, FileCoverage>,
    /// Functional coverage: bins hit and bins.
    pub crossing: Vec<(String, Vec<(usize, usize)>)>,
    /// Replays that were equal in every bit.
    pub replays: BTreeSet<Replay>,
}

/// A pack that was equal in every bit.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Replay {
    /// The target's name.
    pub target: String,
    /// Name of the configuration.
    pub config: String,
    /// How it was replayed.
    pub way: String,
    /// Beats of all streams.
    pub beats: u64,
}

/// The record could not be read.
#[derive(Debug, Error)]
#[error("{}: {why}; write it with: wheatstone cover --record && wheatstone replay --record", .path.display())]
pub struct VerificationError {
    path: PathBuf,
    why: String,
}

impl Record {
    /// The record of a workspace.
    pub fn read(workspace: &Path) -> Result<Record, VerificationError> {
        let path = workspace.join(FILE);
        let parsed = std::fs::read(&path)
            .map_err(|error| error.to_string())
            .and_then(|text| serde_json::from_slice(&text).map_err(|error| error.to_string()));
        parsed.map_err(|why| VerificationError { path, why })
    }

    /// Writes it.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        write_file(&workspace.join(FILE), format!("{text}\n").as_bytes())
    }

    /// Takes over what was covered.
    pub fn cover(&mut self, report: &Report, bins: &Bins) {
        self.coverage = report.files.clone();
        self.crossing = cover::crossing(bins);
    }

    /// Takes over a replay in the place of an older one; one that was not equal only removes that.
    pub fn replay(&mut self, replay: Replay, passed: bool) {
        let same = |r: &Replay| {
            (&r.target, &r.config, &r.way) == (&replay.target, &replay.config, &replay.way)
        };
        self.replays.retain(|old| !same(old));
        if passed {
            self.replays.insert(replay);
        }
    }

    /// Coverage of the Verilog, file by file.
    pub fn coverage_table(&self) -> String {
        let mut text = String::from(
            "\n| file | lines | toggles | waived | covered or waived |\n| --- | --- | --- | --- | --- |\n",
        );
        let total = FileCoverage::total(self.coverage.values());
        let link = |name: &String| format!("[{name}](../rtl/{name})");
        let rows = self.coverage.iter().map(|(name, file)| (link(name), file));
        for (name, file) in rows.chain([("all".to_owned(), &total)]) {
            let both = file.lines + file.toggles;
            let shown = |share: Share| format!("{} of {}", share.covered, share.points);
            let (lines, toggles) = (shown(file.lines), shown(file.toggles));
            let waived = both.waived;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "| {name} | {lines} | {toggles} | {waived} | {:.1} % |",
                both.percent()
            );
        }
        text
    }

    /// Functional coverage, by mode and ratio.
    pub fn crossing_table(&self) -> String {
        let divisions = cover::divisions().join(" | ");
        let mut text = format!("\n| mode, ratio | {divisions} |\n| --- | --- | --- | --- |\n");
        for (label, shares) in &self.crossing {
            let shares = shares.iter().map(|(hit, all)| format!(" {hit} of {all} |"));
            // Writing to a string cannot fail.
            let _ = writeln!(text, "| {label} |{}", shares.collect::<String>());
        }
        text
    }

    /// Packs replayed, a row a target: beats, where all were equal.
    pub fn replay_table(&self) -> String {
        let ways = Way::ALL.map(Way::name).join(" | ");
        let mut text = format!("\n| pack | {ways} |\n| --- | --- | --- | --- | --- |\n");
        let configs: BTreeSet<&str> = self.replays.iter().map(|r| r.config.as_str()).collect();
        for target in Target::ALL.map(Target::name) {
            for config in &configs {
                let cells = Way::ALL.map(|way| {
                    let of =
                        |r: &&Replay| (r.target.as_str(), r.config.as_str()) == (target, *config);
                    let replay = self.replays.iter().filter(of).find(|r| r.way == way.name());
                    replay.map_or("–".into(), |r| format!("{} beats", thousands(r.beats as f64)))
                });
                // Writing to a string cannot fail.
                let _ = writeln!(
                    text,
                    "| [{target}]({target}.md) `{config}` | {} |",
                    cells.join(" | ")
                );
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_replay_takes_the_place_of_an_older_one() {
        let replay = |beats| {
            let [target, config, way] = ["filter", "paper", "gates"].map(String::from);
            Replay { target, config, way, beats }
        };
        let mut record = Record::default();
        record.replay(replay(7), true);
        record.replay(replay(1250), true);
        let row = "| [filter](filter.md) `paper` | – | – | 1,250 beats | – |";
        assert!(record.replay_table().contains(row), "{}", record.replay_table());
        record.replay(replay(8), false);
        assert!(record.replays.is_empty());
    }
}
