//! Speed of the loop, beside a loop in C++ on the same model with the same stimulus and the
//! same stalls that checks nothing.

use crate::bench::Bench;
use crate::build_error::LoadError;
use crate::job::{Job, JobError};
use crate::model::Library;
use crate::outcome::Outcome;
use std::time::Instant;
use thiserror::Error;
use wheatstone_golden::interface::{Direction, Table};

/// Speeds of both loops, in clocks a second: the best of all rounds of each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Speed {
    /// The loop of this crate, checking everything.
    pub rust: f64,
    /// The C++ loop, checking nothing.
    pub cpp: f64,
    /// Clocks of one round.
    pub clocks: u64,
}

impl Speed {
    /// Speed of this crate's loop in terms of the C++ loop.
    pub fn ratio(&self) -> f64 {
        self.rust / self.cpp
    }
}

/// The comparison did not come about.
#[derive(Debug, Error)]
pub enum SpeedError {
    /// The model could not be created.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The job does not fit.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The run did not pass.
    #[error("{0}")]
    Failed(Box<Outcome>),
    /// The C++ loop has no responder.
    #[error("the stream {0} has no table")]
    NoTable(&'static str),
}

/// Runs a job `rounds` times in both loops, alternating, each time from a reset. Every stream
/// needs a table.
pub fn compare_speed(library: &Library, job: &Job<'_>, rounds: usize) -> Result<Speed, SpeedError> {
    let streams = &library.interface().streams;
    let mut tables = Vec::new();
    for (stream, table) in streams.iter().zip(job.tables) {
        tables.push((stream, table.ok_or(SpeedError::NoTable(stream.name))?));
    }
    let inputs = tables.iter().filter(|(stream, _)| stream.direction == Direction::Input);
    let columns: Vec<Vec<u64>> = inputs.flat_map(|(_, table)| columns(table)).collect();
    let beats: Vec<u64> = tables.iter().map(|(_, table)| table.len() as u64).collect();
    let mut speed = Speed::default();
    for round in 0..rounds {
        let mut bench = Bench::new(library, round as u64)?;
        let gates = bench.prepare(job.stalls).to_vec();
        let start = Instant::now();
        let outcome = bench.run(job)?;
        let time = start.elapsed().as_secs_f64();
        let Outcome::Passed(counts) = outcome else {
            return Err(SpeedError::Failed(Box::new(outcome)));
        };
        speed.rust = speed.rust.max(counts.simulated as f64 / time);

        bench.reset();
        let limit = 2 * counts.simulated + 1_000;
        let start = Instant::now();
        speed.clocks = bench.model_mut().bench(&gates, &columns, &beats, limit);
        speed.cpp = speed.cpp.max(speed.clocks as f64 / start.elapsed().as_secs_f64());
    }
    Ok(speed)
}

/// The fields of a table, one after another.
fn columns(table: &Table) -> impl Iterator<Item = Vec<u64>> + '_ {
    let width = table.width();
    (0..width).map(move |field| table.values().iter().skip(field).step_by(width).copied().collect())
}
