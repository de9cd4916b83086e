//! The models of a regression, each built once.

use super::plan::Plan;
use crate::{BuildError, Builder, Library, Probe, Spec};
use std::sync::{Arc, OnceLock};
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::{probes, Target};

/// The probes of a system, as the model wants them.
pub fn model_probes(target: Target, config: &Config) -> Vec<Probe> {
    let units = target.is_system().then(|| probes(target, config)).into_iter().flatten();
    units
        .map(|probe| Probe {
            instance: probe.path,
            module: probe.module,
            streams: vec![probe.stream],
        })
        .collect()
}

/// A model, or why there is none: that does not change by another try.
type Built = Result<Library, Arc<BuildError>>;

/// Models of the targets, built when first needed.
pub(super) struct Models<'a> {
    builder: &'a Builder,
    plan: &'a Plan<'a>,
    built: Vec<(Target, OnceLock<Built>)>,
}

impl<'a> Models<'a> {
    pub fn new(builder: &'a Builder, plan: &'a Plan<'a>) -> Models<'a> {
        let built = plan.targets.iter().map(|&target| (target, OnceLock::new())).collect();
        Models { builder, plan, built }
    }

    /// The model of a target of the plan; who comes while it is built waits.
    pub fn get(&self, target: Target) -> Built {
        let config = &self.plan.settings.config;
        let build = || {
            let probes = model_probes(target, config);
            let interface = target.interface(config);
            let spec = Spec { interface: &interface, rtl: &self.plan.rtl, probes: &probes };
            self.builder.build(&spec).map_err(Arc::new)
        };
        match self.built.iter().find(|(there, _)| *there == target) {
            Some((_, cell)) => cell.get_or_init(build).clone(),
            None => build(),
        }
    }
}
