//! A proof in a folder: runs of the provers, and what follows from them.

use super::effort::Effort;
use super::property::name;
use super::verdict::Verdict;
use crate::flow::{FlowError, Folder};
use crate::tools::{Found, Tool, YICES, YOSYS, YOSYS_ABC, YOSYS_SMTBMC};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::process::Command;
use std::time::Duration;
use wheatstone_process::Output;

/// The programs of a proof.
pub(super) struct Programs {
    yosys: Found,
    smtbmc: Found,
    yices: Found,
    abc: Found,
    /// The folders in which they find each other.
    path: OsString,
}

impl Programs {
    /// Finds them in the folders of `path`, a list as in the variable `PATH`.
    pub fn find_in(path: &OsStr) -> Result<Programs, FlowError> {
        Ok(Programs {
            yosys: YOSYS.find_in(path)?,
            smtbmc: YOSYS_SMTBMC.find_in(path)?,
            yices: YICES.find_in(path)?,
            abc: YOSYS_ABC.find_in(path)?,
            path: path.to_owned(),
        })
    }

    /// The versions of all of them: what they find may depend on each.
    pub fn versions(&self) -> Vec<&[u8]> {
        let all = [&self.yosys, &self.smtbmc, &self.yices, &self.abc];
        all.map(|found| found.text.as_bytes()).to_vec()
    }
}

/// The result of a run of the prover.
pub(super) enum Run {
    /// It holds; the clocks of induction that were needed.
    Passed(u32),
    /// These do not hold after so many clocks.
    Failed { step: u32, labels: Vec<String> },
    /// Stopped after so many clocks.
    Stopped(u32),
}

/// A proof in a folder.
pub(super) struct Task<'a> {
    pub folder: &'a Folder,
    pub programs: &'a Programs,
    pub module: String,
    /// Processor time after which a prover is stopped.
    pub limit: Duration,
    /// Processor time that each of the provers has used so far.
    pub used: RefCell<Vec<Duration>>,
}

impl Task<'_> {
    /// Reads the Verilog without some assertions, for all runs.
    pub fn read(&self, commands: &str, left_out: &[&str]) -> Result<(), FlowError> {
        let deleted = self.delete(left_out);
        let script = format!(
            "{commands}; {deleted}tee -q -o labels select -list t:$assert; write_ilang base.il"
        );
        let mut command = self.folder.command(&self.programs.yosys);
        self.folder.run(&YOSYS, command.args(["-q", "-p", &script]), &["labels", "base.il"])
    }

    /// The labels of all assertions.
    pub fn labels(&self) -> Result<Vec<String>, FlowError> {
        let text = self.folder.read(&YOSYS, "labels")?;
        let names = text.lines().filter_map(|line| line.trim().split_once('/'));
        Ok(names.map(|(_, name)| name.to_owned()).collect())
    }

    /// All properties, then the deep ones for more clocks.
    pub fn prove(&self, effort: Effort) -> Result<BTreeMap<String, Verdict>, FlowError> {
        let labels = self.labels()?;
        let mut verdicts = self.prove_all(&labels, effort)?;
        for (label, verdict) in &mut verdicts {
            let clocks = effort.clocks(label);
            let is_open = matches!(verdict, Verdict::Bounded(_) | Verdict::Stopped(_));
            if is_open && clocks > effort.bound {
                let others: Vec<String> = labels.iter().filter(|l| *l != label).cloned().collect();
                *verdict = match self.bounded(&others, clocks)? {
                    Run::Passed(_) => verdict.with_clocks(clocks),
                    Run::Failed { step, .. } => Verdict::Fails(step),
                    Run::Stopped(reached) => verdict.with_clocks(reached).stopped(),
                };
            }
        }
        Ok(verdicts)
    }

    /// All properties together; those for which that takes too long, each by itself with the lemmas.
    fn prove_all(
        &self,
        labels: &[String],
        effort: Effort,
    ) -> Result<BTreeMap<String, Verdict>, FlowError> {
        let (alone, lemmas): (Vec<_>, Vec<_>) =
            labels.iter().cloned().partition(|label| name(label).is_some());
        // Whether a prover was stopped that might have proved something of any number of clocks.
        let mut stopped = false;
        if effort.has_no_registers() {
            match self.holds_in_every_state()? {
                Some(true) => {
                    let always = |label: &String| (label.clone(), Verdict::Induction(0));
                    return Ok(labels.iter().map(always).collect());
                }
                holds => stopped |= holds.is_none(),
            }
        }
        let mut all = BTreeMap::new();
        // Without registers nothing is gained by proving all at once.
        if effort.induction > 1 || alone.len() == 1 {
            let (together, induction_stopped) = self.prove_some(labels, &[], effort)?;
            all = together;
            stopped |= induction_stopped;
        }
        let is_open = |label: &&String| all.get(*label).is_none_or(|found| found.is_stopped());
        let open: Vec<&String> = alone.iter().filter(is_open).collect();
        // One that is alone was tried alone.
        if alone.len() > 1 || all.is_empty() {
            for label in open {
                let others: Vec<String> = alone.iter().filter(|l| *l != label).cloned().collect();
                let with_it: Vec<String> = lemmas.iter().chain([label]).cloned().collect();
                for (label, found) in self.prove_some(&with_it, &others, effort)?.0 {
                    let best = all.entry(label).or_insert(found);
                    *best = best.or(found);
                }
            }
        }
        // What holds for so many clocks might have been proved of any number, had that prover not been stopped.
        let told = |verdict: Verdict| if stopped { verdict.stopped() } else { verdict };
        Ok(all.into_iter().map(|(label, verdict)| (label, told(verdict))).collect())
    }

    /// Induction of what can be proved so, then so many clocks from reset. The assertions are `labels`,
    /// those that there are without `others`. Tells too whether the induction was stopped.
    fn prove_some(
        &self,
        labels: &[String],
        others: &[String],
        effort: Effort,
    ) -> Result<(BTreeMap<String, Verdict>, bool), FlowError> {
        // What fails is left out until the rest is an induction.
        let mut left_out = others.to_vec();
        let mut induction_stopped = false;
        let depth = loop {
            if left_out.len() == others.len() + labels.len() {
                break 0;
            }
            match self.run(&left_out, &["-i"], effort.induction)? {
                Run::Passed(depth) => break depth,
                Run::Failed { labels, .. } if !labels.is_empty() => left_out.extend(labels),
                run => {
                    induction_stopped = matches!(run, Run::Stopped(_));
                    left_out.extend_from_slice(labels);
                    break 0;
                }
            }
        };
        let is_inductive = |label: &String| !left_out.contains(label);
        let all_are = labels.iter().all(is_inductive);
        let of_all = |verdict: &dyn Fn(&String) -> Verdict| {
            let all = labels.iter().map(|label| (label.clone(), verdict(label))).collect();
            (all, induction_stopped)
        };
        // What holds in every state needs no base.
        if depth == 0 && all_are {
            return Ok(of_all(&|_| Verdict::Induction(depth)));
        }
        // One clock that took too long takes too long again.
        if induction_stopped && effort.bound == 1 {
            return Ok(of_all(&|_| Verdict::Stopped(0)));
        }
        let bound = if all_are { effort.induction } else { effort.bound };
        let mut stopped = induction_stopped;
        let (reached, failed) = match self.bounded(others, bound)? {
            Run::Passed(_) => (bound, Vec::new()),
            Run::Failed { step, labels } => (step, labels),
            Run::Stopped(reached) => {
                stopped = true;
                (reached, Vec::new())
            }
        };
        Ok(of_all(&|label| match is_inductive(label) {
            _ if failed.contains(label) => Verdict::Fails(reached),
            true if reached >= effort.induction => Verdict::Induction(depth),
            _ if stopped => Verdict::Stopped(reached),
            _ => Verdict::Bounded(reached),
        }))
    }

    /// So many clocks from reset.
    pub fn bounded(&self, left_out: &[String], clocks: u32) -> Result<Run, FlowError> {
        // A contradiction among the assumptions would prove anything.
        self.run(left_out, &["--presat"], clocks)
    }

    /// True if all assertions of a module without registers are proved by merging gates that are equal,
    /// which finds sums to be the same in whatever order they are formed. None if the prover was stopped.
    pub fn holds_in_every_state(&self) -> Result<Option<bool>, FlowError> {
        let script = format!(
            "read_ilang base.il; miter -assert -flatten {} miter; hierarchy -top miter; \
             opt -full; techmap; opt -fast; abc -g AND -fast; opt_clean; aigmap; \
             write_aiger -zinit miter.aig",
            self.module
        );
        let mut command = self.folder.command(&self.programs.yosys);
        self.folder.run(&YOSYS, command.args(["-q", "-p", &script]), &["miter.aig"])?;
        let proof = "read_aiger miter.aig; strash; comb; fraig; iprove; print_status";
        let mut command = self.folder.command(&self.programs.abc);
        let output = self.limited(&YOSYS_ABC, command.args(["-c", proof]))?;
        let holds = String::from_utf8_lossy(&output.stdout).contains("Status = 1 ");
        Ok((holds || !output.is_stopped).then_some(holds))
    }

    /// Runs a prover and notes the time that it has used.
    fn limited(&self, tool: &'static Tool, command: &mut Command) -> Result<Output, FlowError> {
        let output = self.folder.limited(tool, command, self.limit)?;
        self.used.borrow_mut().push(output.processor);
        Ok(output)
    }

    /// Yosys commands that delete assertions.
    fn delete(&self, labels: &[impl AsRef<str>]) -> String {
        labels.iter().map(|label| format!("delete {}/{}; ", self.module, label.as_ref())).collect()
    }

    /// Runs the prover without some assertions.
    fn run(&self, left_out: &[String], mode: &[&str], clocks: u32) -> Result<Run, FlowError> {
        let deleted = self.delete(left_out);
        let script = format!("read_ilang base.il; {deleted}write_smt2 -wires model.smt2");
        let mut command = self.folder.command(&self.programs.yosys);
        self.folder.run(&YOSYS, command.args(["-q", "-p", &script]), &["model.smt2"])?;
        let mut command = self.folder.command(&self.programs.smtbmc);
        command.env("PATH", &self.programs.path);
        command.args(["-s", "yices"]).args(mode).args(["-t", &clocks.to_string(), "model.smt2"]);
        let output = self.limited(&YOSYS_SMTBMC, &mut command)?;
        let text = String::from_utf8_lossy(&output.stdout);
        let step = step(&text).unwrap_or(0);
        if text.contains("Status: PASSED") {
            // Induction counts its steps down.
            return Ok(Run::Passed(clocks.saturating_sub(step)));
        }
        if text.contains("Status: FAILED") {
            let labels = text.lines().filter_map(|line| {
                line.split_once("Assert failed in ")?
                    .1
                    .split_once(": ")
                    .map(|(_, name)| name.trim())
            });
            let labels: Vec<String> = labels.map(str::to_owned).collect();
            if labels.is_empty() && !mode.contains(&"-i") {
                return Err(self.folder.failed(&YOSYS_SMTBMC, &text));
            }
            return Ok(Run::Failed { step, labels });
        }
        match output.is_stopped {
            true => Ok(Run::Stopped(step)),
            false => Err(self.folder.failed(&YOSYS_SMTBMC, &output.said())),
        }
    }
}

/// The last step that the prover has spoken of.
fn step(text: &str) -> Option<u32> {
    let last = text.rfind(" in step ").map(|at| &text[at + " in step ".len()..])?;
    last.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}
