//! Formal proofs: the properties at the ends of the modules, by induction where that closes and else for
//! so many clocks from reset; the bugs that each of them catches; and netlists against the Verilog.
//!
//! A module's own properties are proved of it with the modules inside it, whose properties are left to
//! their own proofs: only the file of the module is read with `FORMAL` defined.

mod bugs;
mod netlist;
mod property;
pub mod record;

pub use bugs::{Bug, BUGS};
pub use netlist::Equivalence;
pub use property::{name, properties, Property};

use crate::flow::{self, FlowError, Folder};
use crate::sources::{self, Sources};
use crate::tools::{Found, YICES, YOSYS, YOSYS_ABC, YOSYS_SMTBMC};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;

/// How a property was proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It does not hold: it fails so many clocks after the first one.
    Fails(u32),
    /// No counterexample within so many clocks from reset.
    Bounded(u32),
    /// Of any number of clocks, by induction over so many.
    Induction(u32),
}

/// A module with parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Build {
    /// Module without `sam_`.
    pub module: String,
    /// The named configurations that give these parameters, or what else the build is for.
    pub label: String,
    /// Verilog parameters that are set.
    pub parameters: Vec<(String, u32)>,
}

/// What came of a build.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proof {
    /// By the labels of the properties, lemmas included.
    pub verdicts: BTreeMap<String, Verdict>,
    /// Processor time is not measured: seconds on the clock.
    pub seconds: f64,
}

impl Proof {
    /// Whether a prover was stopped before it had tried all the clocks of an effort.
    fn was_stopped(&self, effort: Effort) -> bool {
        let fewer = |(label, verdict): (&String, &Verdict)| match verdict {
            Verdict::Bounded(clocks) => *clocks < effort.clocks(label),
            Verdict::Fails(_) | Verdict::Induction(_) => false,
        };
        self.verdicts.iter().any(fewer)
    }
}

/// Whether a property fails where a bug is planted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Catch {
    /// It fails so many clocks after the first one.
    At(u32),
    /// It holds for as many clocks as it is tried.
    Not,
    /// The prover was stopped before it failed.
    Stopped,
}

/// How far a proof goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Clocks of induction that are tried.
    pub induction: u32,
    /// Clocks from reset where that does not close.
    pub bound: u32,
    /// Labels of properties that are then tried by themselves, and for how many clocks.
    deep: &'static [(&'static str, u32)],
}

impl Effort {
    /// The effort that a module is worth.
    pub fn of(module: &str) -> Effort {
        let [induction, bound] = match module {
            // Without registers one clock is all there is.
            "clamp" | "popcount" | "setup_check" | "coverage" | "coverage_edge"
            | "filter_division" => [1, 1],
            "primary_planes" | "hybrid_planes" => [1, 5],
            "hybrid" | "stereo" | "mono" | "hybrid_back" => [2, 12],
            "slot_queue" => [2, 10],
            "minimal" => [2, 10],
            "primary" => [2, 14],
            _ => [3, 10],
        };
        let deep: &[(&str, u32)] = match module {
            "hybrid" | "stereo" | "mono" | "hybrid_back" => &DEEP,
            // It takes 30 beats to count too many.
            "filter" => &[("p_range", 33)],
            _ => &[],
        };
        Effort { induction, bound, deep }
    }

    /// Whether a module is in the short set: those whose first build takes half a minute at most.
    pub fn is_quick(module: &str) -> bool {
        !["coverage_edge", "primary_planes", "hybrid_planes"].contains(&module)
    }

    /// Whether it is that of a module for which one clock is all there is.
    fn has_no_registers(self) -> bool {
        self.bound == 1
    }

    /// What a default test can afford.
    pub fn quick(self) -> Effort {
        Effort { bound: self.bound.min(4), deep: &[], ..self }
    }

    /// The clocks that a property is tried for in the end.
    fn clocks(&self, label: &str) -> u32 {
        let deep = self.deep.iter().find(|(deep, _)| *deep == label);
        deep.map_or(self.bound, |(_, clocks)| *clocks)
    }
}

/// Properties of systems that show after more clocks, when each of them is tried by itself.
const DEEP: [(&str, u32); 5] = [
    ("p_never_hangs", 30),
    ("p_left_stable", 18),
    ("p_right_stable", 18),
    ("p_request_stable", 18),
    ("p_stable", 18),
];

/// Seconds of processor time after which a prover is stopped.
const LIMIT: u32 = 60;

/// Module, label and parameters of a build.
type Variant = (&'static str, &'static str, &'static [(&'static str, u32)]);

/// Builds beside those of the named configurations: narrow ones, where wide ones would take too long,
/// and ones that the systems use.
const VARIANTS: [Variant; 13] = [
    ("filter_division", "three terms", &[("FILTER_TERMS", 3)]),
    ("edge_interpolator", "3 bits", &[("BITS", 3), ("SLOPE_BITS", 2), ("TILT", 1)]),
    ("edge_interpolator", "depth", &[("BITS", 43), ("SLOPE_BITS", 43), ("TILT", 0)]),
    ("clamp", "depth", &[("BITS", 24)]),
    ("stage", "40 bits", &[("WIDTH", 40)]),
    ("buffer", "40 bits", &[("WIDTH", 40)]),
    ("polygon", "minimal", &[("SUBPIXEL_BITS", 8), ("LEND", 0)]),
    ("slot_queue", "2 slots", &[("SUBPIXEL_BITS", 4), ("SLOTS", 2)]),
    ("slot_queue", "8 slots", &[("SUBPIXEL_BITS", 4), ("SLOTS", 8)]),
    ("hybrid_back", "8 slots", EIGHT_SLOTS),
    ("hybrid", "8 slots", EIGHT_SLOTS_FILTERED),
    ("mono", "8 slots", &[("SUBPIXEL_BITS", 4), ("SLOTS", 8)]),
    ("stereo", "8 slots", EIGHT_SLOTS_FILTERED),
];

/// The architecture of many slots with as few of them and as little else as there can be.
const EIGHT_SLOTS: &[(&str, u32)] =
    &[("SUBPIXEL_BITS", 4), ("DEPTH_INTERPOLATED", 0), ("SLOTS", 8)];
/// The same of what has a filter.
const EIGHT_SLOTS_FILTERED: &[(&str, u32)] =
    &[("SUBPIXEL_BITS", 4), ("FILTER_TERMS", 2), ("DEPTH_INTERPOLATED", 0), ("SLOTS", 8)];

/// Runs the provers and keeps what they find.
#[derive(Debug)]
pub struct Prover {
    /// Folder of the Verilog.
    pub rtl: PathBuf,
    /// Folder of the cache, created when needed.
    pub cache: PathBuf,
}

/// The programs of a proof.
struct Programs {
    yosys: Found,
    smtbmc: Found,
    yices: Found,
    abc: Found,
}

impl Prover {
    /// The cache that the programs of this workspace use, seen from the workspace's folder.
    pub const CACHE: &'static str = "target/wheatstone/prove";

    /// The modules that have properties, sorted, without `sam_`.
    pub fn modules(&self) -> Result<Vec<String>, FlowError> {
        let at = |source| FlowError::Read { path: self.rtl.clone(), source };
        let mut modules = Vec::new();
        for entry in std::fs::read_dir(&self.rtl).map_err(at)? {
            let name = entry.map_err(at)?.file_name().to_string_lossy().into_owned();
            let module = name.strip_prefix("sam_").and_then(|rest| rest.strip_suffix(".v"));
            if let Some(module) = module {
                if !properties(&self.text(module)?).is_empty() {
                    modules.push(module.to_owned());
                }
            }
        }
        modules.sort();
        Ok(modules)
    }

    /// The Verilog of a module.
    pub fn text(&self, module: &str) -> Result<String, FlowError> {
        let path = self.rtl.join(format!("sam_{module}.v"));
        std::fs::read_to_string(&path).map_err(|source| FlowError::Read { path, source })
    }

    /// The builds of a module: those of the named configurations, each set of parameters once, then
    /// the others.
    pub fn builds(&self, module: &str) -> Result<Vec<Build>, FlowError> {
        let text = self.text(module)?;
        let mut builds: Vec<Build> = Vec::new();
        for name in Config::NAMES {
            let config = Config::named(name).unwrap_or(Config::DEFAULT);
            let parameters = parameters(module, &text, &config);
            match builds.iter_mut().find(|build| build.parameters == parameters) {
                Some(build) => build.label = format!("{}, {name}", build.label),
                None => builds.push(Build {
                    module: module.to_owned(),
                    label: name.to_owned(),
                    parameters,
                }),
            }
        }
        for (_, label, parameters) in VARIANTS.iter().filter(|(of, ..)| *of == module) {
            let parameters = parameters.iter().map(|(n, v)| ((*n).to_owned(), *v)).collect();
            let (module, label) = (module.to_owned(), (*label).to_owned());
            builds.push(Build { module, label, parameters });
        }
        Ok(builds)
    }

    /// Proves what can be proved of a build.
    pub fn prove(&self, build: &Build, effort: Effort) -> Result<Proof, FlowError> {
        let sources = self.sources(&build.module)?;
        let programs = Programs::find()?;
        let commands = read_commands(&sources, build);
        let effort_text = format!("{effort:?} {LIMIT}");
        let keep = |proof: &Proof| !proof.was_stopped(effort);
        self.cached(build, &sources, &programs, &[&commands, &effort_text], keep, |folder| {
            let started = Instant::now();
            let task =
                Task { folder, programs: &programs, module: format!("sam_{}", build.module) };
            task.read(&commands)?;
            let verdicts = task.prove(effort)?;
            Ok(Proof { verdicts, seconds: tenths(started) })
        })
    }

    /// Whether a bug is caught by the property that is to catch it, that one alone. Without the bug it must
    /// not fail.
    pub fn catches(&self, bug: &Bug) -> Result<Catch, FlowError> {
        let clean = self.sources(bug.module)?;
        let mut planted = clean.clone();
        bug.plant(&mut planted)?;
        let bound = Effort::of(bug.module).clocks(&format!("p_{}", bug.property));
        let caught = self.fails(bug, &planted, bound)?;
        let Catch::At(step) = caught else { return Ok(caught) };
        match self.fails(bug, &clean, step + 1)? {
            Catch::At(_) => Err(bug.fault("the property fails without the bug")),
            Catch::Not => Ok(caught),
            Catch::Stopped if self.holds(bug, step + 1)? => Ok(caught),
            Catch::Stopped => Ok(Catch::Stopped),
        }
    }

    /// Whether a bug's property is proved without the bug, for so many clocks at least. Beside the other properties and
    /// by induction that may be quick where it alone is not.
    fn holds(&self, bug: &Bug, clocks: u32) -> Result<bool, FlowError> {
        let proof = self.prove(&self.build(bug)?, Effort::of(bug.module))?;
        let own = proof.verdicts.iter().filter(|(label, _)| name(label) == Some(bug.property));
        Ok(own.map(|(_, verdict)| *verdict).all(|verdict| match verdict {
            Verdict::Induction(_) => true,
            Verdict::Bounded(reached) => reached >= clocks,
            Verdict::Fails(_) => false,
        }))
    }

    /// The build that a bug is planted in.
    fn build(&self, bug: &Bug) -> Result<Build, FlowError> {
        let is_it = |build: &Build| build.label.split(", ").any(|label| label == bug.build);
        let found = self.builds(bug.module)?.into_iter().find(is_it);
        found.ok_or_else(|| bug.fault(&format!("there is no build “{}”", bug.build)))
    }

    /// Where a bug's property fails, within so many clocks.
    fn fails(&self, bug: &Bug, sources: &Sources, bound: u32) -> Result<Catch, FlowError> {
        let build = &self.build(bug)?;
        let programs = Programs::find()?;
        let commands = read_commands(sources, build);
        let what = format!("{} {bound}", bug.property);
        let keep = |caught: &Catch| *caught != Catch::Stopped;
        self.cached(build, sources, &programs, &[&commands, &what], keep, |folder| {
            let task =
                Task { folder, programs: &programs, module: format!("sam_{}", build.module) };
            task.read(&commands)?;
            let all = task.labels()?;
            let (kept, others): (Vec<_>, Vec<_>) =
                all.into_iter().partition(|label| name(label) == Some(bug.property));
            if kept.is_empty() {
                return Err(bug.fault("there is no such property"));
            }
            // What is proved so takes long to be tried for a counterexample.
            if Effort::of(bug.module).has_no_registers() && task.holds_in_every_state()? {
                return Ok(Catch::Not);
            }
            match task.bounded(&others, bound)? {
                Run::Failed { step, .. } => Ok(Catch::At(step)),
                Run::Passed(_) => Ok(Catch::Not),
                Run::Stopped(_) => Ok(Catch::Stopped),
            }
        })
    }

    fn sources(&self, module: &str) -> Result<Sources, FlowError> {
        sources::read(&self.rtl, &format!("sam_{module}"))
            .map_err(|e| FlowError::Read { path: e.path, source: e.source })
    }

    fn cached<T: Serialize + serde::de::DeserializeOwned>(
        &self,
        build: &Build,
        sources: &Sources,
        programs: &Programs,
        inputs: &[&str],
        keep: impl FnOnce(&T) -> bool,
        find: impl FnOnce(&Folder) -> Result<T, FlowError>,
    ) -> Result<T, FlowError> {
        let mut all = vec![programs.yosys.text.as_bytes(), programs.yices.text.as_bytes()];
        all.extend(inputs.iter().map(|text| text.as_bytes()));
        flow::cached(&self.cache, &format!("sam_{}", build.module), sources, &all, keep, find)
    }
}

/// Seconds since then, to a tenth.
fn tenths(started: Instant) -> f64 {
    (started.elapsed().as_secs_f64() * 10.0).round() / 10.0
}

/// The parameters of a module in a configuration.
fn parameters(module: &str, text: &str, config: &Config) -> Vec<(String, u32)> {
    let own = |(name, value): (&str, u32)| (name.to_owned(), value);
    match Target::named(module) {
        Some(target) => target.interface(config).parameters.into_iter().map(own).collect(),
        None => {
            let lines = text.lines().filter_map(|line| line.trim().strip_prefix("parameter "));
            let names = lines.filter_map(|line| line.split(' ').next());
            names.filter_map(|name| Some(own((name, config.get(name)?)))).collect()
        }
    }
}

/// Yosys commands that read a build, its own properties included.
fn read_commands(sources: &Sources, build: &Build) -> String {
    let module = format!("sam_{}", build.module);
    let own = format!("{module}.v");
    let others = sources.keys().filter(|name| name.ends_with(".v") && **name != own);
    let others: String = others.map(|name| format!(" {name}")).collect();
    let plain = match others.is_empty() {
        true => others,
        false => format!("read_verilog -I .{others}; "),
    };
    let set = flow::set_parameters(&module, &build.parameters);
    // Tables must not become memories that begin with anything.
    format!(
        "{plain}read_verilog -formal -I . {own}; {set}prep -top {module} -flatten; rename -top {module}; \
         memory_map; opt_clean; async2sync; dffunmap"
    )
}

impl Programs {
    fn find() -> Result<Programs, FlowError> {
        let (yosys, smtbmc) = (YOSYS.find()?, YOSYS_SMTBMC.find()?);
        Ok(Programs { yosys, smtbmc, yices: YICES.find()?, abc: YOSYS_ABC.find()? })
    }
}

/// What came of a run of the prover.
enum Run {
    /// It holds; the clocks of induction that were needed.
    Passed(u32),
    /// These do not hold after so many clocks.
    Failed { step: u32, labels: Vec<String> },
    /// Stopped after so many clocks.
    Stopped(u32),
}

/// A proof in a folder.
struct Task<'a> {
    folder: &'a Folder,
    programs: &'a Programs,
    module: String,
}

impl Task<'_> {
    /// Reads the Verilog, for all runs.
    fn read(&self, commands: &str) -> Result<(), FlowError> {
        let script =
            format!("{commands}; tee -q -o labels select -list t:$assert; write_ilang base.il");
        let mut command = self.folder.command(&self.programs.yosys);
        self.folder.run(&YOSYS, command.args(["-q", "-p", &script]))
    }

    /// The labels of all assertions.
    fn labels(&self) -> Result<Vec<String>, FlowError> {
        let text = self.folder.read("labels")?;
        let names = text.lines().filter_map(|line| line.trim().split_once('/'));
        Ok(names.map(|(_, name)| name.to_owned()).collect())
    }

    /// All properties, then the deep ones for more clocks.
    fn prove(&self, effort: Effort) -> Result<BTreeMap<String, Verdict>, FlowError> {
        let labels = self.labels()?;
        let mut verdicts = self.prove_all(&labels, effort)?;
        for (label, verdict) in &mut verdicts {
            let clocks = effort.clocks(label);
            let Verdict::Bounded(so_far) = *verdict else { continue };
            if clocks > effort.bound {
                let others: Vec<String> = labels.iter().filter(|l| *l != label).cloned().collect();
                *verdict = match self.bounded(&others, clocks)? {
                    Run::Passed(_) => Verdict::Bounded(clocks),
                    Run::Failed { step, .. } => Verdict::Fails(step),
                    Run::Stopped(reached) => Verdict::Bounded(reached.max(so_far)),
                };
            }
        }
        Ok(verdicts)
    }

    /// All properties together or, where that takes too long, each by itself with the lemmas.
    fn prove_all(
        &self,
        labels: &[String],
        effort: Effort,
    ) -> Result<BTreeMap<String, Verdict>, FlowError> {
        let (alone, lemmas): (Vec<_>, Vec<_>) =
            labels.iter().cloned().partition(|label| name(label).is_some());
        if effort.has_no_registers() && self.holds_in_every_state()? {
            return Ok(labels.iter().map(|label| (label.clone(), Verdict::Induction(0))).collect());
        }
        // Without registers nothing is gained by proving all at once.
        if effort.induction > 1 || alone.len() == 1 {
            let (verdicts, stopped) = self.prove_some(labels, &[], effort)?;
            if !stopped || alone.len() == 1 {
                return Ok(verdicts);
            }
        }
        let mut all = BTreeMap::new();
        for label in &alone {
            let others: Vec<String> = alone.iter().filter(|l| *l != label).cloned().collect();
            let with_it: Vec<String> = lemmas.iter().chain([label]).cloned().collect();
            all.extend(self.prove_some(&with_it, &others, effort)?.0);
        }
        Ok(all)
    }

    /// Induction of what can be proved so, then so many clocks from reset; also whether a prover was
    /// stopped. The assertions are `labels`, those that there are without `others`.
    fn prove_some(
        &self,
        labels: &[String],
        others: &[String],
        effort: Effort,
    ) -> Result<(BTreeMap<String, Verdict>, bool), FlowError> {
        // What fails is left out until the rest is an induction.
        let mut left_out = others.to_vec();
        let mut stopped = false;
        let depth = loop {
            if left_out.len() == others.len() + labels.len() {
                break 0;
            }
            match self.run(&left_out, &["-i"], effort.induction)? {
                Run::Passed(depth) => break depth,
                Run::Failed { labels, .. } if !labels.is_empty() => left_out.extend(labels),
                run => {
                    stopped = matches!(run, Run::Stopped(_));
                    left_out.extend_from_slice(labels);
                    break 0;
                }
            }
        };
        let is_inductive = |label: &String| !left_out.contains(label);
        let inductive = |label: &String| (label.clone(), Verdict::Induction(depth));
        // What holds in every state needs no base.
        if depth == 0 && labels.iter().all(is_inductive) {
            return Ok((labels.iter().map(inductive).collect(), false));
        }
        // One clock that took too long takes too long again.
        if stopped && effort.bound == 1 {
            let open = |label: &String| (label.clone(), Verdict::Bounded(0));
            return Ok((labels.iter().map(open).collect(), true));
        }
        let bound = match labels.iter().all(is_inductive) {
            true => effort.induction,
            false => effort.bound,
        };
        let (reached, failed) = match self.bounded(others, bound)? {
            Run::Passed(_) => (bound, Vec::new()),
            Run::Failed { step, labels } => (step, labels),
            Run::Stopped(reached) => {
                stopped = true;
                (reached, Vec::new())
            }
        };
        let verdict = |label: &String| match is_inductive(label) {
            _ if failed.contains(label) => (label.clone(), Verdict::Fails(reached)),
            true if reached >= effort.induction => inductive(label),
            _ => (label.clone(), Verdict::Bounded(reached)),
        };
        Ok((labels.iter().map(verdict).collect(), stopped))
    }

    /// So many clocks from reset.
    fn bounded(&self, left_out: &[String], clocks: u32) -> Result<Run, FlowError> {
        // A contradiction among the assumptions would prove anything.
        self.run(left_out, &["--presat"], clocks)
    }

    /// Whether all assertions of a module without registers are proved by merging gates that are equal,
    /// which finds sums to be the same in whatever order they are formed.
    fn holds_in_every_state(&self) -> Result<bool, FlowError> {
        let script = format!(
            "read_ilang base.il; miter -assert -flatten {} miter; hierarchy -top miter; \
             opt -full; techmap; opt -fast; abc -g AND -fast; opt_clean; aigmap; \
             write_aiger -zinit miter.aig",
            self.module
        );
        let mut command = self.folder.command(&self.programs.yosys);
        self.folder.run(&YOSYS, command.args(["-q", "-p", &script]))?;
        let proof = "read_aiger miter.aig; strash; comb; fraig; iprove; print_status";
        let mut command = self.folder.command(&self.programs.abc);
        let output = self.folder.limited(&YOSYS_ABC, command.args(["-c", proof]), LIMIT)?;
        Ok(String::from_utf8_lossy(&output.stdout).contains("Status = 1 "))
    }

    /// Runs the prover without some assertions.
    fn run(&self, left_out: &[String], mode: &[&str], clocks: u32) -> Result<Run, FlowError> {
        let deleted: String =
            left_out.iter().map(|label| format!("delete {}/{label}; ", self.module)).collect();
        let script = format!("read_ilang base.il; {deleted}write_smt2 -wires model.smt2");
        let mut command = self.folder.command(&self.programs.yosys);
        self.folder.run(&YOSYS, command.args(["-q", "-p", &script]))?;
        let mut command = self.folder.command(&self.programs.smtbmc);
        command.args(["-s", "yices"]).args(mode).args(["-t", &clocks.to_string(), "model.smt2"]);
        let output = self.folder.limited(&YOSYS_SMTBMC, &mut command, LIMIT)?;
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
