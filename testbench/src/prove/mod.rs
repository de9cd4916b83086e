//! Formal proofs: the properties at the ends of the modules, by induction where that closes and else for
//! so many clocks from reset; the bugs that each of them catches; and netlists against the Verilog.
//!
//! A module's own properties are proved of it with the modules inside it, whose properties are left to
//! their own proofs: only the file of the module is read with `FORMAL` defined.

mod bugs;
mod effort;
mod netlist;
mod property;
pub mod record;
mod task;

pub use bugs::{Bug, BUGS};
pub use effort::{Effort, LIMIT, SHORT};
pub use netlist::Equivalence;
pub use property::{name, properties, Property};

use crate::flow::{self, FlowError, Folder};
use crate::sources::{self, Sources};
use crate::tools;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;
use task::{Programs, Run, Task};
use wheatstone_golden::config::Config;
use wheatstone_golden::files;
use wheatstone_golden::targets::Target;

/// How a property was proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It does not hold: it fails so many clocks after the first one.
    Fails(u32),
    /// A prover was stopped, so that nothing more is known than that there is no counterexample within so many
    /// clocks from reset.
    Stopped(u32),
    /// No counterexample within so many clocks from reset.
    Bounded(u32),
    /// Of any number of clocks, by induction over so many.
    Induction(u32),
}

impl Verdict {
    /// Whether more might have been found, had the prover not been stopped.
    pub fn is_stopped(self) -> bool {
        matches!(self, Verdict::Stopped(_))
    }

    /// The same of a proof that was cut short: what is known of so many clocks is then not all that could be.
    fn stopped(self) -> Verdict {
        match self {
            Verdict::Bounded(clocks) => Verdict::Stopped(clocks),
            other => other,
        }
    }

    /// The same where so many clocks were tried as well.
    fn with_clocks(self, clocks: u32) -> Verdict {
        match self {
            Verdict::Bounded(before) => Verdict::Bounded(before.max(clocks)),
            Verdict::Stopped(before) => Verdict::Stopped(before.max(clocks)),
            other => other,
        }
    }

    /// What two proofs of the same property say together.
    fn or(self, other: Verdict) -> Verdict {
        match (self, other) {
            (Verdict::Fails(_), _) => self,
            (_, Verdict::Fails(_)) => other,
            _ => self.max(other),
        }
    }
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
    /// Processor time of all provers together, in seconds.
    pub seconds: f64,
    /// Processor time of the one that needed most, in seconds.
    #[serde(default)]
    pub longest: f64,
}

impl Proof {
    /// Whether more might have been found, had no prover been stopped.
    pub fn was_stopped(&self) -> bool {
        self.verdicts.values().any(|verdict| verdict.is_stopped())
    }

    /// The labels of what does not hold.
    pub fn failed(&self) -> impl Iterator<Item = &str> {
        let fails = |(_, verdict): &(&String, &Verdict)| matches!(verdict, Verdict::Fails(_));
        self.verdicts.iter().filter(fails).map(|(label, _)| &label[..])
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
    rtl: PathBuf,
    cache: PathBuf,
    path: OsString,
    limit: Duration,
}

impl Prover {
    /// Proves the Verilog in the folder `rtl`; what it finds is kept in the folder `cache`, created when needed.
    pub fn new(rtl: impl Into<PathBuf>, cache: impl Into<PathBuf>) -> Prover {
        let (rtl, cache) = (rtl.into(), cache.into());
        Prover { rtl, cache, path: tools::search_path(), limit: LIMIT }
    }

    /// The same with the programs in the folders of `path`, a list as in the variable `PATH`, and with another
    /// limit of processor time than [`LIMIT`].
    pub fn with(self, path: impl Into<OsString>, limit: Duration) -> Prover {
        Prover { path: path.into(), limit, ..self }
    }

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
        match files::read(&path, sources::LIMIT) {
            Ok(text) => Ok(String::from_utf8_lossy(&text).into_owned()),
            Err(error) => Err(FlowError::Read { path, source: error.source }),
        }
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

    /// Proves what can be proved of a build. What was cut short is not kept.
    pub fn prove(&self, build: &Build, effort: Effort) -> Result<Proof, FlowError> {
        let sources = self.sources(&build.module)?;
        let programs = self.programs()?;
        let commands = read_commands(&sources, build);
        let effort_text = format!("{effort:?} {:?}", self.limit);
        let keep = |proof: &Proof| !proof.was_stopped();
        self.cached(build, &sources, &programs, &[&commands, &effort_text], keep, |folder| {
            let task = self.task(folder, &programs, build);
            task.read(&commands, effort.left_out)?;
            let verdicts = task.prove(effort)?;
            let used = task.used.take();
            let longest = tenths(used.iter().max().copied().unwrap_or_default());
            Ok(Proof { verdicts, seconds: tenths(used.iter().sum()), longest })
        })
    }

    fn programs(&self) -> Result<Programs, FlowError> {
        Programs::find_in(&self.path)
    }

    fn task<'a>(&self, folder: &'a Folder, programs: &'a Programs, build: &Build) -> Task<'a> {
        let (module, limit) = (format!("sam_{}", build.module), self.limit);
        Task { folder, programs, module, limit, used: RefCell::default() }
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
            Verdict::Bounded(reached) | Verdict::Stopped(reached) => reached >= clocks,
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
        let programs = self.programs()?;
        let commands = read_commands(sources, build);
        let what = format!("{} {bound}", bug.property);
        let keep = |caught: &Catch| *caught != Catch::Stopped;
        self.cached(build, sources, &programs, &[&commands, &what], keep, |folder| {
            let task = self.task(folder, &programs, build);
            task.read(&commands, &[])?;
            let all = task.labels()?;
            let (kept, others): (Vec<_>, Vec<_>) =
                all.into_iter().partition(|label| name(label) == Some(bug.property));
            if kept.is_empty() {
                return Err(bug.fault("there is no such property"));
            }
            // What is proved so takes long to be tried for a counterexample.
            if Effort::of(bug.module).has_no_registers()
                && task.holds_in_every_state()? == Some(true)
            {
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
        let mut all = programs.versions();
        all.extend(inputs.iter().map(|text| text.as_bytes()));
        flow::cached(&self.cache, &format!("sam_{}", build.module), sources, &all, keep, find)
    }
}

/// In seconds, to a tenth.
fn tenths(time: Duration) -> f64 {
    (time.as_secs_f64() * 10.0).round() / 10.0
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
