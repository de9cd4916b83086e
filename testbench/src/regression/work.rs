//! The pieces of work of a plan.

use super::plan::{NamedScene, Plan};
use crate::cases;
use crate::settings::Settings;
use wheatstone_golden::targets::Target;

/// Name of the case of random beats.
pub(super) const RANDOM: &str = "random";

/// A piece of work, which one entry reports.
pub(super) enum Work<'a> {
    Directed(Target, usize),
    Random(Target),
    Scene(Target, &'a NamedScene<'a>),
}

impl<'a> Work<'a> {
    /// All pieces of a plan, in the order of its targets.
    pub fn of(plan: &'a Plan<'a>) -> Vec<Work<'a>> {
        let is_wanted = |name: &str| plan.case.as_deref().is_none_or(|case| case == name);
        let mut work = Vec::new();
        for &target in &plan.targets {
            if !(plan.scenes_only && target.is_system()) {
                let directed = cases::directed(target, &plan.settings.config);
                let wanted = (0..directed.len()).filter(|&n| is_wanted(&directed[n].name));
                work.extend(wanted.map(|n| Work::Directed(target, n)));
                if is_wanted(RANDOM) {
                    work.push(Work::Random(target));
                }
            }
            if target.is_system() {
                let wanted = plan.scenes.iter().filter(|scene| is_wanted(&scene.name));
                work.extend(wanted.map(|scene| Work::Scene(target, scene)));
            }
        }
        work
    }

    /// Its place among all: the longest come first, so that none ends up alone at the end.
    pub fn rank(&self) -> usize {
        match self {
            Work::Scene(..) => 0,
            Work::Random(target) if target.is_system() => 1,
            Work::Random(_) => 2,
            Work::Directed(..) => 3,
        }
    }
}

/// Names of the cases that targets have besides scenes, each once.
pub fn case_names(targets: &[Target], settings: &Settings) -> Vec<String> {
    let mut names = Vec::new();
    for &target in targets {
        let directed = cases::directed(target, &settings.config).into_iter().map(|case| case.name);
        for name in directed.chain([RANDOM.to_owned()]) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}
