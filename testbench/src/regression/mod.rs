//! The regression: which cases run on which target, side by side, and what came of them.
//!
//! Rules: a case follows from target, configuration, seed and number of beats alone. Random beats
//! come in batches; batch n of seed s is batch 0 of seed s + n, with stall patterns chosen by the same
//! number, so that one failing batch can be repeated by itself.

mod attempt;
mod batches;
mod entries;
mod entry;
mod error;
mod event;
mod failure;
mod ground;
mod models;
mod plan;
mod report;
mod run;
mod waves;
mod work;

pub(crate) use batches::{batches, directed_stalls};
pub use entry::{Entry, SceneEntry};
pub use error::RegressionError;
pub use event::Event;
pub use failure::{Failure, Location};
pub use models::model_probes;
pub use plan::{NamedScene, Plan, Waves, BEATS_LIMIT, MEASURED_LATENCY, SYSTEM_BEATS, UNIT_BEATS};
pub use report::{drawn_line, json, junit, table};
pub use run::{run_case, run_scene, Ran, SceneRan, Setting};
pub use waves::{record_waves, Focus, Waves as WaveFile};
pub use work::case_names;

use crate::cases;
use crate::watch;
use crate::Builder;
use entries::{directed, draw, random};
use ground::Ground;
use models::Models;
use rayon::prelude::*;
use wheatstone_golden::targets::Target;
use work::{Work, RANDOM};

/// Runs a plan; entries come in the order of the targets.
pub fn run(
    plan: &Plan,
    builder: &Builder,
    tell: &(dyn Fn(Event) + Sync),
) -> Result<Vec<Entry>, RegressionError> {
    let models = Models::new(builder, plan);
    let work = Work::of(plan);
    tell(Event::Planned(work.len()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(plan.jobs).build()?;
    let mut order: Vec<usize> = (0..work.len()).collect();
    order.sort_by_key(|&n| work[n].rank());
    let mut entries: Vec<(usize, Entry)> = pool.install(|| {
        let one = |&n: &usize| do_work(plan, &models, &work[n], tell).map(|entry| (n, entry));
        order.par_iter().with_max_len(1).map(one).collect::<Result<Vec<_>, RegressionError>>()
    })?;
    entries.sort_by_key(|(n, _)| *n);
    Ok(entries.into_iter().map(|(_, entry)| entry).collect())
}

fn do_work(
    plan: &Plan,
    models: &Models,
    work: &Work,
    tell: &(dyn Fn(Event) + Sync),
) -> Result<Entry, RegressionError> {
    let ground = |target: Target| -> Result<Ground, RegressionError> {
        Ok(Ground { plan, tell, library: models.get(target)?, target })
    };
    let begin = |target: Target, case: &str| {
        watch::case(target.name(), case);
        tell(Event::Begin(target, case));
    };
    let entry = match work {
        Work::Directed(target, n) => {
            let case = cases::directed(*target, &plan.settings.config).swap_remove(*n);
            begin(*target, &case.name);
            directed(&ground(*target)?, &case)?
        }
        Work::Random(target) => {
            begin(*target, RANDOM);
            random(&ground(*target)?)?
        }
        Work::Scene(target, scene) => {
            begin(*target, &scene.name);
            draw(&ground(*target)?, scene)?
        }
    };
    tell(Event::End(&entry));
    Ok(entry)
}
