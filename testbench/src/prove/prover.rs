//! The prover: builds of modules, their properties, and the bugs that these catch.

use super::bugs::Bug;
use super::build::Build;
use super::effort::{Effort, LIMIT};
use super::property::{name, properties};
use super::task::{Programs, Run, Task};
use super::verdict::{tenths, Catch, Proof, Verdict};
use crate::flow::{self, FlowError, Folder};
use crate::sources::{self, Sources};
use crate::tools;
use serde::de::DeserializeOwned;
use serde::Serialize;
use std::cell::RefCell;
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;
use wheatstone_golden::files;

/// Runs the provers and keeps what they find.
#[derive(Debug)]
pub struct Prover {
    rtl: PathBuf,
    pub(super) cache: PathBuf,
    path: OsString,
    pub(super) limit: Duration,
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
        Ok(Build::all(module, &self.text(module)?))
    }

    /// Proves what can be proved of a build. What was cut short is not kept.
    pub fn prove(&self, build: &Build, effort: Effort) -> Result<Proof, FlowError> {
        let sources = self.sources(&build.module)?;
        let programs = self.programs()?;
        let commands = build.read_commands(&sources);
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

    /// The clock on which the property that is to catch a bug does so, that one alone. Without the bug it must
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

    /// True if a bug's property is proved without the bug, for so many clocks at least. Beside the other properties and
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

    /// The clock on which a bug's property fails, within so many clocks.
    fn fails(&self, bug: &Bug, sources: &Sources, bound: u32) -> Result<Catch, FlowError> {
        let build = &self.build(bug)?;
        let programs = self.programs()?;
        let commands = build.read_commands(sources);
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

    pub(super) fn sources(&self, module: &str) -> Result<Sources, FlowError> {
        sources::read(&self.rtl, &format!("sam_{module}"))
            .map_err(|e| FlowError::Read { path: e.path, source: e.source })
    }

    fn cached<T: Serialize + DeserializeOwned>(
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
