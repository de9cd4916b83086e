//! The committed record of what is proved, and the tables of `docs/formal.md`.

use super::build::Build;
use super::effort::{Effort, SHORT};
use super::netlist::Equivalence;
use super::property::{name, properties};
use super::verdict::{Proof, Verdict};
use crate::record::{read_record, RecordError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use wheatstone_golden::files::{self, WriteError};

/// Path of the record in the workspace.
pub const FILE: &str = "formal/record.json";

/// A build and its proof.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proved {
    /// Module without `sam_`.
    pub module: String,
    /// The build's label.
    pub build: String,
    /// The result.
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
        let of_it = verdicts.filter(|(label, _)| name(label) == Some(property));
        of_it.map(|(_, verdict)| *verdict).min()
    }
}

/// The result of the comparison of a netlist.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// The target's name.
    pub target: String,
    /// Name of the configuration.
    pub config: String,
    /// The result.
    #[serde(flatten)]
    pub equivalence: Equivalence,
}

impl Compared {
    /// The report on one that differs.
    pub fn difference(&self) -> String {
        let Equivalence { points, open, .. } = self.equivalence;
        format!("{} {}: {open} of {points} points differ", self.target, self.config)
    }

    /// True if both are of the same target in the same configuration.
    fn is_same(&self, other: &Compared) -> bool {
        (&self.target, &self.config) == (&other.target, &other.config)
    }
}

/// The part of a record that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    All,
    /// The short set: fewer clocks, and not the properties that take long.
    Short,
}

/// Seconds of processor time that proving everything may take.
const WHOLE: f64 = 40.0 * 60.0;

/// Everything that was proved.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Properties, by module and build.
    pub proofs: Vec<Proved>,
    /// Netlists, by target and configuration.
    pub netlists: Vec<Compared>,
}

impl Record {
    /// The record of a workspace.
    pub fn read(workspace: &Path) -> Result<Record, RecordError> {
        read_record(workspace, FILE, "write it with: wheatstone prove --record")
    }

    /// Writes it, an entry a line, so that a change shows as such.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let text = format!(
            "{{\n\"proofs\": [\n{}\n],\n\"netlists\": [\n{}\n]\n}}\n",
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

    /// Properties that are proved for less than the record says, a line each; also those that are not in it.
    /// If fewer cycles were tried than for the record, their number does not count. Cycles that are tried at the end,
    /// one property after the other, depend on the speed of the processor, and do not count either.
    pub fn faults(&self, proofs: &[Proved], extent: Extent) -> Vec<String> {
        let worth = |verdict: Verdict| match (verdict, extent) {
            (Verdict::Fails(_), _) => (0, 0),
            (Verdict::Bounded(bound) | Verdict::Stopped(bound), Extent::All) => (1, bound),
            (Verdict::Bounded(_) | Verdict::Stopped(_), Extent::Short) => (1, 0),
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
            let left_out = Effort::quick(&new.module).map_or(&[][..], |effort| effort.left_out);
            let is_tried = |label: &str| extent == Extent::All || !left_out.contains(&label);
            for (label, verdict) in old.proof.verdicts.iter().filter(|(label, _)| is_tried(label)) {
                let now = new.proof.verdicts.get(label);
                let enough = match verdict {
                    Verdict::Bounded(_) | Verdict::Stopped(_) => worth(*verdict).min(sure),
                    _ => worth(*verdict),
                };
                if now.map_or((0, 0), |now| worth(*now)) < enough {
                    let now = now.map_or("not there".into(), |now| shown(*now));
                    let short = match new.proof.verdicts.get(label) {
                        Some(Verdict::Stopped(_)) => "not decided, as it is in the record".into(),
                        _ => format!("recorded {}", shown(*verdict)),
                    };
                    faults.push(format!("{what}: {label}: {now}, {short}"));
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
            let source = files::read_own(&path).unwrap_or_default();
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

    /// The time that proving everything takes.
    pub fn time(&self) -> String {
        let minutes = seconds(&self.proofs) / 60.0;
        format!("\nProvers need {minutes:.1} minutes of processor time for everything.\n")
    }

    /// The table of netlists.
    pub fn netlist_table(&self) -> String {
        let mut text = String::from(
            "\n| target | configuration | points | open | seconds |\n| --- | --- | --- | --- | --- |\n",
        );
        for Compared { target, config, equivalence } in &self.netlists {
            let Equivalence { points, open, seconds } = equivalence;
            let points = match points {
                0 => "stopped".into(),
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

/// Processor time of proofs.
fn seconds(proofs: &[Proved]) -> f64 {
    proofs.iter().map(|proved| proved.proof.seconds).sum()
}

/// Proofs that took more processor time than they may, a line each: everything 40 minutes, which is 20 on two
/// processors; in the short set no prover more than [`SHORT`].
pub fn slow(proofs: &[Proved], extent: Extent) -> Vec<String> {
    if extent == Extent::All {
        let taken = seconds(proofs);
        let tell = || format!("everything: {taken:.0} s of processor time, not below {WHOLE:.0}");
        return (taken >= WHOLE).then(tell).into_iter().collect();
    }
    let short = SHORT.as_secs_f64();
    let is_slow = |proved: &&Proved| proved.proof.longest > short;
    let tell = |Proved { module, build, proof }: &Proved| {
        format!(
            "{module} ({build}): a prover took {:.1} s of processor time, more than {short:.0}: leave what it \
             proved out of the short set, in prove/effort.rs",
            proof.longest
        )
    };
    proofs.iter().filter(is_slow).map(tell).collect()
}

fn told(proved: &Proved) -> String {
    format!("{} in {:.1} s", proved.build, proved.proof.seconds)
}

/// A verdict as a table shows it.
pub fn shown(verdict: Verdict) -> String {
    match verdict {
        Verdict::Fails(step) => format!("**fails** at {step}"),
        Verdict::Stopped(0) => "stopped".into(),
        Verdict::Stopped(clocks) => format!("stopped after {clocks} clocks"),
        Verdict::Bounded(clocks) => format!("{clocks} clocks"),
        Verdict::Induction(_) => "always".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proved(verdict: Verdict) -> Proved {
        let verdicts = BTreeMap::from([("p_stable".to_owned(), verdict)]);
        let proof = Proof { verdicts, seconds: 1.0, longest: 0.5 };
        Proved { module: "stage".into(), build: "default".into(), proof }
    }

    #[test]
    fn what_is_proved_for_less_is_told() {
        let proofs = vec![proved(Verdict::Bounded(10))];
        let record = Record { proofs, ..Record::default() };
        let faults = |verdict, extent| record.faults(&[proved(verdict)], extent);
        for good in [Verdict::Bounded(10), Verdict::Bounded(11), Verdict::Induction(1)] {
            assert_eq!(faults(good, Extent::All), [""; 0]);
        }
        let fewer = "stage (default): p_stable: 9 clocks, recorded 10 clocks";
        assert_eq!(faults(Verdict::Bounded(9), Extent::All), [fewer]);
        assert_eq!(faults(Verdict::Bounded(4), Extent::Short), [""; 0]);
        assert_eq!(faults(Verdict::Fails(2), Extent::Short).len(), 1);
        let other = Proved { build: "paper".into(), ..proved(Verdict::Induction(1)) };
        let unknown = format!("stage (paper): not in {FILE}");
        assert_eq!(record.faults(&[other], Extent::Short), [unknown]);
    }

    #[test]
    fn a_prover_that_was_stopped_is_told_as_such() {
        let record = |verdict| Record { proofs: vec![proved(verdict)], ..Record::default() };
        let stopped = [proved(Verdict::Stopped(10))];
        let always = record(Verdict::Induction(2));
        for extent in [Extent::All, Extent::Short] {
            let told = "stage (default): p_stable: stopped after 10 clocks, not decided, as it is in the record";
            assert_eq!(always.faults(&stopped, extent), [told]);
        }
        // It has shown as much.
        assert_eq!(record(Verdict::Bounded(10)).faults(&stopped, Extent::All), [""; 0]);
        assert_eq!(shown(Verdict::Stopped(0)), "stopped");
    }

    #[test]
    fn proofs_that_take_too_long_are_told() {
        let taking = |seconds, longest| {
            let mut proved = proved(Verdict::Induction(1));
            (proved.proof.seconds, proved.proof.longest) = (seconds, longest);
            proved
        };
        let most = [taking(1200.0, 60.0), taking(1199.0, 60.0)];
        assert_eq!(slow(&most, Extent::All), [""; 0]);
        let told = "everything: 2400 s of processor time, not below 2400";
        assert_eq!(slow(&[taking(1200.0, 1.0), taking(1200.0, 1.0)], Extent::All), [told]);
        assert_eq!(slow(&[taking(100.0, 12.0)], Extent::Short), [""; 0]);
        let told = &slow(&[taking(13.0, 12.1)], Extent::Short)[0];
        assert!(told.starts_with("stage (default): a prover took 12.1 s"), "{told}");
    }
}
