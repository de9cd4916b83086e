//! Results of the provers.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// The extent to which a property was proved.
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
    /// True if more might have been found, had the prover not been stopped.
    pub fn is_stopped(self) -> bool {
        matches!(self, Verdict::Stopped(_))
    }

    /// The same of a proof that was cut short: what is known of so many clocks is then not all that could be.
    pub(super) fn stopped(self) -> Verdict {
        match self {
            Verdict::Bounded(clocks) => Verdict::Stopped(clocks),
            other => other,
        }
    }

    /// The same where so many clocks were tried as well.
    pub(super) fn with_clocks(self, clocks: u32) -> Verdict {
        match self {
            Verdict::Bounded(before) => Verdict::Bounded(before.max(clocks)),
            Verdict::Stopped(before) => Verdict::Stopped(before.max(clocks)),
            other => other,
        }
    }

    /// The result of two proofs of the same property together.
    pub(super) fn or(self, other: Verdict) -> Verdict {
        match (self, other) {
            (Verdict::Fails(_), _) => self,
            (_, Verdict::Fails(_)) => other,
            _ => self.max(other),
        }
    }
}

/// The result of a build.
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
    /// True if more might have been found, had no prover been stopped.
    pub fn was_stopped(&self) -> bool {
        self.verdicts.values().any(|verdict| verdict.is_stopped())
    }

    /// The labels of all that does not hold.
    pub fn failed(&self) -> impl Iterator<Item = &str> {
        let fails = |(_, verdict): &(&String, &Verdict)| matches!(verdict, Verdict::Fails(_));
        self.verdicts.iter().filter(fails).map(|(label, _)| &label[..])
    }
}

/// The clock on which a property fails where a bug is planted.
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

/// In seconds, to a tenth.
pub(super) fn tenths(time: Duration) -> f64 {
    (time.as_secs_f64() * 10.0).round() / 10.0
}
