//! The common ground of the runs of an entry.

use super::event::Event;
use super::plan::Plan;
use super::run::Setting;
use crate::{Library, Stalls};
use wheatstone_golden::targets::Target;

/// The common ground of the runs of an entry.
pub(super) struct Ground<'a> {
    pub plan: &'a Plan<'a>,
    pub tell: &'a (dyn Fn(Event) + Sync),
    pub library: Library,
    pub target: Target,
}

impl Ground<'_> {
    /// A run with this seed and these stalls.
    pub fn setting(&self, seed: u64, stalls: Stalls) -> Setting<'_> {
        let latency = self.plan.settings.latency;
        Setting { library: &self.library, seed, stalls, latency, trace: None }
    }
}
