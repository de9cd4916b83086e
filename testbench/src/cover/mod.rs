//! Coverage of the regression: lines and toggles of the Verilog, counted by Verilator in models built for
//! it, and the crossing of the stimulus.
//!
//! Counts are added up over targets, configurations and instances, since parameters leave code out. What
//! cannot be covered is waived with its reason, in the list [`WAIVERS`]; a waiver that nothing needs is a
//! fault.

mod functional;
mod report;
mod waivers;

pub use crate::coverage::{Collector, Counts, Kind, Point};
pub use functional::{Bin, Bins, Ratio};
pub use report::{annotated, crossing, divisions, json, table, FileCoverage, Report, Share};
pub use waivers::{Waiver, WaiverError, FILE as WAIVERS};

use crate::regression::{self, Entry, Event, Plan, RegressionError};
use crate::Builder;
use std::io;
use std::sync::{Arc, Mutex, PoisonError};
use thiserror::Error;

/// Random beats of each target in each configuration; what they leave out, more of them leave out too.
pub const BEATS: u64 = 17_000;

/// Configurations that together have every line of the Verilog, with the parameters that are changed: the
/// three that are named, and one with the options that these leave out.
pub const CONFIGURATIONS: [(&str, &[&str]); 5] = [
    ("default", &[]),
    ("paper", &[]),
    ("full", &[]),
    ("default", &["filter=2"]),
    ("default", &["filter=3", "depth=sampled", "depth_test=external", "slots=4"]),
];

/// Coverage could not be measured.
#[derive(Debug, Error)]
pub enum CoverError {
    /// The regression could not run.
    #[error(transparent)]
    Regression(#[from] RegressionError),
    /// Verilog and model differ: what is covered means nothing.
    #[error("{0} differs from the golden model; run: wheatstone cosim {0}")]
    Mismatch(String),
    /// Counts could not be read.
    #[error("coverage: {0}")]
    Counts(#[from] io::Error),
    /// The list of waivers.
    #[error(transparent)]
    Waiver(#[from] WaiverError),
}

/// Runs the plans, each on models that count, and adds everything up.
pub fn measure(
    builder: Builder,
    plans: &[Plan],
    tell: &(dyn Fn(Event) + Sync),
) -> Result<(Counts, Bins), CoverError> {
    let collector = Arc::new(Collector::default());
    let builder = builder.covering(collector.clone());
    let bins = Mutex::new(Bins::default());
    let listen = |event: Event| {
        if let Event::Run(case, stalls) = &event {
            bins.lock().unwrap_or_else(PoisonError::into_inner).count(case, *stalls);
        }
        tell(event);
    };
    for plan in plans {
        let entries: Vec<Entry> = regression::run(plan, &builder, &listen)?;
        if let Some(entry) = entries.iter().find(|entry| !entry.passed()) {
            return Err(CoverError::Mismatch(entry.target.name().to_owned()));
        }
    }
    Ok((collector.take()?, bins.into_inner().unwrap_or_else(PoisonError::into_inner)))
}
