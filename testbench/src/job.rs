//! A job: tables, stalls, limits, and the responder.

use crate::layout::{Layout, Probe};
use crate::stalls::Stalls;
use std::path::PathBuf;
use thiserror::Error;
use wheatstone_golden::interface::{Direction, Interface, Table};

/// Answers requests: stands for the memory beside a system.
///
/// Streams are numbers in the order of the interface, cycles count from the reset.
pub trait Responder {
    /// A beat of an output was taken.
    fn accepted(&mut self, stream: usize, cycle: u64, row: &[u64]);
    /// Writes the next beat of an input, if it may be offered in this cycle.
    fn respond(&mut self, stream: usize, cycle: u64, row: &mut [u64]) -> bool;
}

/// Part of a run that is written to a waveform file; a cycle is 10 units of time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceWindow {
    /// The file, in the FST format.
    pub path: PathBuf,
    /// First cycle.
    pub from_cycle: u64,
    /// Last cycle.
    pub to_cycle: u64,
}

impl TraceWindow {
    /// The time at which the values of a cycle are settled, for a marker.
    pub fn time(cycle: u64) -> u64 {
        10 * cycle + 5
    }
}

/// When a run is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Clocks without a handshake, with work left, after which the model counts as hung.
    pub watchdog: u64,
    /// Clocks that the model must be quiet at the end.
    pub quiet: u64,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits { watchdog: 5_000, quiet: 64 }
    }
}

/// A run of a model: its stimulus, expected beats and stalls.
///
/// An input with a table that `answers` a stream of requests offers its n-th beat once the n-th
/// request was taken; a [`Responder`] takes the place of the table.
#[derive(Clone, Copy, Debug, Default)]
pub struct Job<'a> {
    /// Values of the static inputs, in the order of the interface.
    pub statics: &'a [u64],
    /// One entry a stream, in the order of the interface: stimulus of inputs, expected beats of
    /// outputs. None: an input that the responder supplies, an output that is not compared.
    pub tables: &'a [Option<&'a Table>],
    /// Expected values of the flags at the end, in the order of the interface, or empty.
    pub flags: &'a [u64],
    /// Expected beats of the probes' streams, one probe after another; empty if not compared.
    pub probes: &'a [Option<&'a Table>],
    /// Stalls.
    pub stalls: Stalls,
    /// When the run is over.
    pub limits: Limits,
}

/// The job does not fit the interface.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum JobError {
    /// A wrong number of something.
    #[error("{what}: {found} given, the interface has {expected}")]
    Count {
        /// Kind of the tables or values.
        what: &'static str,
        /// Number that the interface has.
        expected: usize,
        /// Number that was given.
        found: usize,
    },
    /// A table has another number of fields than its stream.
    #[error("table of stream {stream} has {found} fields, the interface has {expected}")]
    Width {
        /// The stream.
        stream: String,
        /// Fields in the interface.
        expected: usize,
        /// Fields in the table.
        found: usize,
    },
    /// An input has neither a table nor a responder.
    #[error("input {0} has neither a table nor a responder")]
    NoStimulus(&'static str),
}

impl Job<'_> {
    /// Checks that the job fits the module.
    pub(crate) fn check(
        &self,
        interface: &Interface,
        probes: &[Probe],
        layout: &Layout,
        has_responder: bool,
    ) -> Result<(), JobError> {
        let count = |what, expected, found| match expected == found {
            true => Ok(()),
            false => Err(JobError::Count { what, expected, found }),
        };
        count("static inputs", interface.statics.len(), self.statics.len())?;
        count("tables of streams", layout.streams.len(), self.tables.len())?;
        if !self.flags.is_empty() {
            count("flags", interface.flags.len(), self.flags.len())?;
        }
        if !self.probes.is_empty() {
            count("tables of probes", layout.probed.len(), self.probes.len())?;
        }
        let watched = probes.iter().flat_map(|probe| &probe.streams);
        let streams = interface.streams.iter().zip(self.tables);
        for (stream, table) in streams.chain(watched.zip(self.probes)) {
            let Some(table) = table.filter(|table| !table.is_empty()) else { continue };
            let (expected, found) = (stream.fields.len(), table.width());
            if expected != found {
                let stream = stream.name.to_owned();
                return Err(JobError::Width { stream, expected, found });
            }
        }
        let inputs = interface.streams.iter().zip(self.tables);
        for (stream, table) in inputs.filter(|(s, _)| s.direction == Direction::Input) {
            if table.is_none() && !has_responder {
                return Err(JobError::NoStimulus(stream.name));
            }
        }
        Ok(())
    }
}
