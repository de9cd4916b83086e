//! Mutation: what the regression of a target would catch.
//!
//! Yosys makes many small changes, *mutants*, to a target: an input or output bit of an operator is
//! inverted, stuck, or mixed with another one. All of them are in one netlist with the target's ports
//! and one static input more, which chooses the mutant; 0 is none. One model of it runs the cases of the
//! default regression for every mutant until one fails: the mutant is *killed*. Those left are proved
//! to behave as the target does ([`equivalence`]), or are in the committed list of [`record`] with
//! the reason why nobody can tell them from the target, or survive: the regression has a gap.

mod equivalence;
pub mod golden;
mod netlist;
pub mod record;

pub use equivalence::Verdict;
pub use netlist::Mutant;

use crate::cases::{self, Case};
use crate::regression::{batches, directed_stalls, run_case, RegressionError, Setting};
use crate::synth::SynthError;
use crate::tools::ToolError;
use crate::{Builder, Library, Spec, Stalls};
use netlist::Netlist;
use rayon::prelude::*;
use serde::Serialize;
use std::path::PathBuf;
use thiserror::Error;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;

/// Mutants of a target where no other number is asked for.
pub const COUNT: u32 = 200;
/// Seed by which Yosys chooses them where no other is given.
pub const SEED: u64 = 1;
/// Seed of the regression: the one that it has where no other is given.
const REGRESSION_SEED: u64 = 1;

/// True if the Verilog of a target is tested where no target is named: large systems are not.
pub fn is_usual(target: Target) -> bool {
    !matches!(target, Target::Mono | Target::Hybrid | Target::Stereo)
}

/// Name of the configuration in which the Verilog of a target is tested where no other is named: there is
/// little of coverage without samples.
pub fn usual_config(target: Target) -> &'static str {
    match target {
        Target::Coverage => "full",
        _ => "default",
    }
}

/// A target could not be tested.
#[derive(Debug, Error)]
pub enum MutationError {
    /// Yosys could not make or compare the netlists.
    #[error(transparent)]
    Synth(#[from] SynthError),
    /// The regression could not run.
    #[error(transparent)]
    Regression(#[from] RegressionError),
    /// A tool is missing.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// The golden model of a unit could not be tested.
    #[error("golden {unit}: {why}")]
    Golden {
        /// The unit.
        unit: &'static str,
        /// The cause.
        why: String,
    },
    /// The netlist without a mutant does not pass the regression.
    #[error("the netlist of {target} fails without a mutant, in the case {case}: {what}")]
    Unsound {
        /// The target.
        target: &'static str,
        /// The case.
        case: String,
        /// The difference.
        what: String,
    },
}

/// One run of a regression.
pub struct Run {
    /// Stimulus and expected beats.
    pub case: Case,
    /// Seed of the initial state.
    pub seed: u64,
    /// Stall patterns.
    pub stalls: Stalls,
}

/// The runs of the default regression of a target, scenes left out, made as they are needed; `beats`
/// random beats, where the default is not wanted.
pub fn regression(
    target: Target,
    config: &Config,
    beats: Option<u64>,
) -> impl Iterator<Item = Run> {
    let seed = REGRESSION_SEED;
    let directed = cases::directed(target, config).into_iter().flat_map(move |case| {
        let stalls = directed_stalls(&case, seed).into_iter();
        stalls.map(move |stalls| Run { case: case.clone(), seed, stalls })
    });
    let random = batches(target, config, seed, beats);
    directed.chain(random.map(|b| Run {
        case: b.case,
        seed: b.seed,
        stalls: Stalls::of_seed(b.seed),
    }))
}

/// The fate of a mutant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// A run failed, in the case of this name.
    Killed(String),
    /// Proved to behave as the target does.
    Equivalent,
    /// Nothing was proved, but it is in the list of those reviewed, for this reason.
    Reviewed(String),
    /// No run failed, although a sequence of beats exists that shows it.
    Missed,
    /// No run failed, and nothing was proved in the time allowed.
    Undecided,
}

/// A mutant and what became of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Tested<M = Mutant> {
    /// The mutant.
    pub mutant: M,
    /// Its fate.
    pub fate: Fate,
}

/// A target with its mutants, ready to run.
pub struct Mutated {
    target: Target,
    netlist: Netlist,
    library: Library,
}

impl Mutated {
    /// Makes `count` mutants, or as many as there are, of the Verilog in `rtl`; `cache` is where the
    /// tools work.
    pub fn new(
        builder: &Builder,
        [rtl, cache]: [PathBuf; 2],
        (target, config): (Target, &Config),
        (count, seed): (u32, u64),
    ) -> Result<Mutated, MutationError> {
        let netlist = Netlist::new(&rtl, &cache, &target.interface(config), count, seed)?;
        let spec = Spec { interface: &netlist.mutated, rtl: &netlist.folder(), probes: &[] };
        let library = builder.build(&spec).map_err(RegressionError::from)?;
        Ok(Mutated { target, netlist, library })
    }

    /// The mutants.
    pub fn mutants(&self) -> &[Mutant] {
        &self.netlist.mutants
    }

    /// Runs every mutant until it fails; gives the case in which each of them did.
    pub fn kill(
        &self,
        runs: impl Iterator<Item = Run>,
    ) -> Result<Vec<Option<String>>, MutationError> {
        let mut killed = vec![None; self.mutants().len()];
        for run in runs {
            let Run { case, seed, stalls } = run;
            let setting =
                Setting { library: &self.library, seed, stalls, latency: None, trace: None };
            if let Some(what) = fault(&setting, &mut case.clone(), 0)? {
                let target = self.target.name();
                return Err(MutationError::Unsound { target, case: case.name, what });
            }
            let left = killed.par_iter_mut().enumerate().filter(|(_, killed)| killed.is_none());
            left.try_for_each_init(
                || case.clone(),
                |copy, (index, killed)| {
                    let wrong = fault(&setting, copy, index as u64 + 1)?;
                    *killed = wrong.map(|_| case.name.clone());
                    Ok::<(), MutationError>(())
                },
            )?;
            if killed.iter().all(Option::is_some) {
                break;
            }
        }
        Ok(killed)
    }

    /// Looks for beats that tell a mutant from its target.
    pub fn compare(&self, mutant: &Mutant) -> Result<Verdict, MutationError> {
        Ok(self.netlist.compare(mutant)?)
    }

    /// Runs every mutant, proves what it can of those left, and looks up the rest with `reason`.
    pub fn test(
        &self,
        runs: impl Iterator<Item = Run>,
        reason: impl Fn(&Mutant) -> Option<String> + Sync,
    ) -> Result<Vec<Tested>, MutationError> {
        let killed = self.kill(runs)?;
        let tested = self.mutants().par_iter().zip(killed).map(|(mutant, killed)| {
            let fate = match killed {
                Some(case) => Fate::Killed(case),
                // What is proved counts for more than what a person has found.
                None => match (self.compare(mutant)?, reason(mutant)) {
                    (Verdict::Equal, _) => Fate::Equivalent,
                    (Verdict::Different, _) => Fate::Missed,
                    (Verdict::Open, Some(reason)) => Fate::Reviewed(reason),
                    (Verdict::Open, None) => Fate::Undecided,
                },
            };
            Ok(Tested { mutant: mutant.clone(), fate })
        });
        tested.collect()
    }
}

/// The fault in a run of the mutant of that number.
fn fault(
    setting: &Setting,
    case: &mut Case,
    number: u64,
) -> Result<Option<String>, RegressionError> {
    case.statics.push(number);
    let ran = run_case(setting, case);
    case.statics.pop();
    let ran = ran?;
    Ok((!ran.passed()).then(|| format!("{}; {} faults in memory", ran.outcome, ran.memory.len())))
}
