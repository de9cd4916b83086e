//! The committed record of what is proved, and the tables of `docs/formal.md`.

use super::{properties, Build, Effort, Equivalence, Proof, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use thiserror::Error;
use wheatstone_golden::files::{self, WriteError};

/// Where it is in the workspace.
pub const FILE: &str = "formal/record.json";

/// What was proved of a build.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proved {
    /// Module without `sam_`.
    pub module: String,
    /// The build's label.
    pub build: String,
    /// What came of it.
    #[serde(flatten)]
    pub proof: Proof,
}

impl Proved {
    /// Of a build.
    pub fn of(build: &Build, proof: Proof) -> Proved {
        Proved { module: build.module.clone(), build: build.label.clone(), proof }
    }

    /// The weakest verdict of a property's parts.
    pub fn verdict(&self, property: &str) -> Option<Verdict> {
        let verdicts = self.proof.verdicts.iter();
        let of_it = verdicts.filter(|(label, _)| super::name(label) == Some(property));
        of_it.map(|(_, verdict)| *verdict).min()
    }
}

/// What came of the comparison of a netlist.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// The target's name.
    pub target: String,
    /// Name of the configuration.
    pub config: String,
    /// What came of it.
    #[serde(flatten)]
    pub equivalence: Equivalence,
}

impl Compared {
    /// What is told of one that differs.
    pub fn difference(&self) -> String {
        let Equivalence { points, open, .. } = self.equivalence;
        format!("{} {}: {open} of {points} points differ", self.target, self.config)
    }

    /// Whether both are of the same target in the same configuration.
    fn is_same(&self, other: &Compared) -> bool {
        (&self.target, &self.config) == (&other.target, &other.config)
    }
}

/// The record could not be read.
#[derive(Debug, Error)]
#[error("{}: {why}; write it with: wheatstone prove --record", .path.display())]
pub struct RecordError {
    /// The file.
    pub path: PathBuf,
    /// Why.
    pub why: String,
}

/// Whether the clocks of bounded proofs count where they are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clocks {
    /// They do.
    Count,
    /// They do not.
    Ignore,
}

/// What a run that proved everything anew took.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Whole {
    /// Seconds on the clock.
    pub seconds: f64,
    /// Provers at a time.
    pub cores: usize,
}

impl Whole {
    /// Seconds that it may take with two provers.
    pub const LIMIT: f64 = 20.0 * 60.0;

    /// That it took too long, if it did.
    pub fn fault(self) -> Option<String> {
        let Whole { seconds, cores } = self;
        let limit = 2.0 * Whole::LIMIT / cores as f64;
        let slow =
            || format!("everything: {seconds:.0} s with {cores} provers, not below {limit:.0}");
        (seconds >= limit).then(slow)
    }
}

/// Everything that was proved.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// What all properties took, proved in one run.
    pub whole: Option<Whole>,
    /// Properties, by module and build.
    pub proofs: Vec<Proved>,
    /// Netlists, by target and configuration.
    pub netlists: Vec<Compared>,
}

impl Record {
    /// The record of a workspace.
    pub fn read(workspace: &Path) -> Result<Record, RecordError> {
        let path = workspace.join(FILE);
        let parsed = std::fs::read(&path)
            .map_err(|error| error.to_string())
            .and_then(|text| serde_json::from_slice(&text).map_err(|error| error.to_string()));
        parsed.map_err(|why| RecordError { path, why })
    }

    /// Writes it, an entry a line, so that a change shows as such.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let text = format!(
            "{{\n\"whole\": {},\n\"proofs\": [\n{}\n],\n\"netlists\": [\n{}\n]\n}}\n",
            serde_json::to_string(&self.whole).unwrap_or_default(),
            lines(&self.proofs),
            lines(&self.netlists)
        );
        files::write(&workspace.join(FILE), text.as_bytes())
    }

    /// Puts entries in the place of older ones; of a module with new proofs all older ones go.
    pub fn update(&mut self, proofs: &[Proved], netlists: &[Compared]) {
        self.proofs.retain(|old| !proofs.iter().any(|new| new.module == old.module));
        self.proofs.extend_from_slice(proofs);
        self.proofs.sort_by_key(|entry| entry.module.clone());
        self.netlists.retain(|old| !netlists.iter().any(|new| new.is_same(old)));
        self.netlists.extend_from_slice(netlists);
        self.netlists.sort_by_key(|entry| (entry.target.clone(), entry.config.clone()));
    }

    /// What is proved for less than the record says, a line each; also what is not in it. Where fewer clocks
    /// were tried than for the record, their number does not count. Clocks that are tried at the end, one
    /// property after the other, depend on how busy the machine is, and do not count either.
    pub fn faults(&self, proofs: &[Proved], clocks: Clocks) -> Vec<String> {
        let worth = |verdict: Verdict| match (verdict, clocks) {
            (Verdict::Fails(_), _) => (0, 0),
            (Verdict::Bounded(bound), Clocks::Count) => (1, bound),
            (Verdict::Bounded(_), Clocks::Ignore) => (1, 0),
            (Verdict::Induction(_), _) => (2, 0),
        };
        let mut faults = Vec::new();
        for new in proofs {
            let what = format!("{} ({})", new.module, new.build);
            let is_it = |old: &&Proved| (&old.module, &old.build) == (&new.module, &new.build);
            let Some(old) = self.proofs.iter().find(is_it) else {
                faults.push(format!("{what}: not in {FILE}"));
                continue;
            };
            let sure = (1, Effort::of(&new.module).bound);
            for (label, verdict) in &old.proof.verdicts {
                let now = new.proof.verdicts.get(label);
                let enough = match verdict {
                    Verdict::Bounded(_) => worth(*verdict).min(sure),
                    _ => worth(*verdict),
                };
                if now.map_or((0, 0), |now| worth(*now)) < enough {
                    let now = now.map_or("not there".into(), |now| shown(*now));
                    faults.push(format!("{what}: {label}: {now}, recorded {}", shown(*verdict)));
                }
            }
        }
        faults
    }

    /// Netlists that were proved for the record and are not decided any more, a line each; also what is not in
    /// it.
    pub fn lost_netlists(&self, netlists: &[Compared]) -> Vec<String> {
        let tell = |new: &Compared| {
            let what = match self.netlists.iter().find(|old| new.is_same(old)) {
                None => format!("not in {FILE}"),
                Some(old) if old.equivalence.closes() && new.equivalence.points == 0 => {
                    format!("proved in {FILE}, not now")
                }
                Some(_) => return None,
            };
            Some(format!("{} {}: {what}", new.target, new.config))
        };
        netlists.iter().filter_map(tell).collect()
    }

    /// The tables of a workspace's page.
    pub fn tables(&self, workspace: &Path) -> String {
        let mut text = String::new();
        let mut modules: BTreeMap<&str, Vec<&Proved>> = BTreeMap::new();
        for proved in &self.proofs {
            modules.entry(&proved.module).or_default().push(proved);
        }
        for (module, proofs) in modules {
            let path = workspace.join(format!("rtl/sam_{module}.v"));
            let source = std::fs::read_to_string(path).unwrap_or_default();
            let seconds: Vec<String> = proofs.iter().map(|proved| told(proved)).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "\n### {module}\n\n{}.\n", seconds.join("; "));
            let _ = writeln!(text, "| property | | proved |\n| --- | --- | --- |");
            for property in properties(&source) {
                let verdicts = proofs.iter().filter_map(|proved| proved.verdict(&property.name));
                let shown = verdicts.min().map_or("–".into(), shown);
                let _ = writeln!(text, "| `{}` | {} | {shown} |", property.name, property.sentence);
            }
        }
        text
    }

    /// What a whole run takes.
    pub fn time(&self) -> String {
        let Some(Whole { seconds, cores }) = self.whole else { return "\nNot measured.\n".into() };
        let minutes = seconds / 60.0;
        format!("\nEverything, proved anew, took {minutes:.1} minutes with {cores} provers at a time.\n")
    }

    /// The table of netlists.
    pub fn netlist_table(&self) -> String {
        let mut text = String::from(
            "\n| target | configuration | points | open | seconds |\n| --- | --- | --- | --- | --- |\n",
        );
        for Compared { target, config, equivalence } in &self.netlists {
            let Equivalence { points, open, seconds } = equivalence;
            let points = match points {
                0 => "does not close".into(),
                points => points.to_string(),
            };
            // Writing to a string cannot fail.
            let _ = writeln!(text, "| {target} | `{config}` | {points} | {open} | {seconds:.1} |");
        }
        text
    }
}

fn lines<T: Serialize>(entries: &[T]) -> String {
    let lines = entries.iter().map(|entry| serde_json::to_string(entry).unwrap_or_default());
    lines.collect::<Vec<_>>().join(",\n")
}

fn told(proved: &Proved) -> String {
    format!("{} in {:.1} s", proved.build, proved.proof.seconds)
}

/// A verdict as a table shows it.
pub fn shown(verdict: Verdict) -> String {
    match verdict {
        Verdict::Fails(step) => format!("**fails** at {step}"),
        Verdict::Bounded(0) => "open".into(),
        Verdict::Bounded(clocks) => format!("{clocks} clocks"),
        Verdict::Induction(_) => "always".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proved(verdict: Verdict) -> Proved {
        let verdicts = BTreeMap::from([("p_stable".to_owned(), verdict)]);
        let proof = Proof { verdicts, seconds: 1.0 };
        Proved { module: "stage".into(), build: "default".into(), proof }
    }

    #[test]
    fn what_is_proved_for_less_is_told() {
        let proofs = vec![proved(Verdict::Bounded(10))];
        let record = Record { proofs, ..Record::default() };
        let faults = |verdict, clocks| record.faults(&[proved(verdict)], clocks);
        for good in [Verdict::Bounded(10), Verdict::Bounded(11), Verdict::Induction(1)] {
            assert_eq!(faults(good, Clocks::Count), [""; 0]);
        }
        let fewer = "stage (default): p_stable: 9 clocks, recorded 10 clocks";
        assert_eq!(faults(Verdict::Bounded(9), Clocks::Count), [fewer]);
        assert_eq!(faults(Verdict::Bounded(4), Clocks::Ignore), [""; 0]);
        assert_eq!(faults(Verdict::Fails(2), Clocks::Ignore).len(), 1);
        let other = Proved { build: "paper".into(), ..proved(Verdict::Induction(1)) };
        let unknown = format!("stage (paper): not in {FILE}");
        assert_eq!(record.faults(&[other], Clocks::Ignore), [unknown]);
    }

    #[test]
    fn a_run_that_takes_too_long_is_told() {
        let fault = |seconds, cores| Whole { seconds, cores }.fault();
        assert_eq!(fault(1199.0, 2), None);
        let told = "everything: 1200 s with 2 provers, not below 1200";
        assert_eq!(fault(1200.0, 2).as_deref(), Some(told));
        assert!(fault(601.0, 4).is_some());
    }
}
