//! Co-simulation: Verilator models driven from Rust.
//!
//! A [`Builder`] makes a [`Library`] of a Verilog module, from its cache if nothing changed; a
//! [`Bench`] is an instance of it and runs [`Job`]s: tables of beats for the inputs, tables of
//! expected beats for the outputs, stall patterns. The [`Outcome`] is a pass with its counts,
//! the first difference, or a model that hangs. [`waves`] makes views of waveforms; [`tools`] finds
//! the programs that all this needs.
//!
//! [`cases`] are the stimulus and the expected beats of each target; [`memory`] stands beside a system;
//! [`pack`] writes and checks vector packs. [`synth`] measures area and timing, [`mutation`] the faults that the
//! regression would catch, [`baseline`] clocks beside two monocular passes; [`generated`] has the files
//! that are made from the definitions of the golden model.
//!
//! A module imports only those of its own group or of a group above it, and never one that imports it.

// The engine that drives Verilator: it knows interfaces, nothing of the golden model.
mod bench;
mod build_error;
mod coverage;
mod cursors;
mod drive;
mod job;
mod kept;
mod layout;
mod model;
mod outcome;
mod ports;
mod room;
mod shim;
mod sources;
mod speed;
mod stalls;
pub mod tools;
mod verilate;
mod watch;
pub mod waves;
mod workspace;

// Co-simulation against the golden model.
pub mod cases;
pub mod memory;
mod numbers;
pub mod pack;
pub mod regression;
pub mod settings;
mod shell;

// Sign-off: synthesis, proofs, mutants, coverage, replay, and their committed records.
pub mod baseline;
pub mod cover;
mod flow;
pub mod generated;
pub mod mutation;
pub mod prove;
mod record;
pub mod replay;
pub mod synth;
pub mod verification;

// The program.
pub mod cli;

pub use bench::Bench;
pub use build_error::{BuildError, LoadError, TraceError};
pub use job::{Job, JobError, Limits, Responder, TraceWindow};
pub use layout::Probe;
pub use model::{Library, Model};
pub use outcome::{
    Counts, Difference, Fault, Hung, Mismatch, Outcome, Place, StreamCount, StreamState,
};
pub use ports::PortError;
pub use record::RecordError;
pub use speed::{compare_speed, Speed, SpeedError};
pub use stalls::{Pattern, Stalls};
pub use verilate::{Builder, Progress, Spec};
