//! Co-simulation: Verilator models driven from Rust.
//!
//! A [`Builder`] makes a [`Library`] of a Verilog module, from its cache if nothing changed; a
//! [`Bench`] is an instance of it and runs [`Job`]s: tables of beats for the inputs, tables of
//! expected beats for the outputs, stall patterns. The [`Outcome`] is a pass with its counts,
//! the first difference, or a model that hangs. [`cases`] says what the targets are fed;
//! [`memory`] stands beside a system; [`pack`] writes and checks vector packs; [`waves`] makes
//! views of waveforms; [`synth`] measures area and timing, [`mutation`] what the regression would catch, [`baseline`] clocks beside two monocular passes; [`tools`] finds the programs that all this needs; [`generated`] has the files
//! that are made from the definitions of the golden model.

mod ask;
pub mod baseline;
mod bench;
mod build_error;
pub mod cases;
pub mod cli;
pub mod cover;
mod cursors;
mod doctor;
mod drive;
mod flow;
pub mod generated;
mod job;
mod kept;
mod layout;
pub mod memory;
mod model;
pub mod mutation;
mod outcome;
pub mod pack;
mod ports;
pub mod prove;
pub mod regression;
pub mod replay;
mod room;
pub mod settings;
mod shell;
mod shim;
mod sources;
mod speed;
mod stalls;
pub mod synth;
pub mod tools;
pub mod verification;
mod verilate;
mod watch;
pub mod waves;

pub use bench::Bench;
pub use build_error::{BuildError, LoadError, TraceError};
pub use job::{Job, JobError, Limits, Responder, TraceWindow};
pub use layout::Probe;
pub use model::{Library, Model};
pub use outcome::{
    Counts, Difference, Fault, Hung, Mismatch, Outcome, Place, StreamCount, StreamState,
};
pub use ports::PortError;
pub use speed::{compare_speed, Speed, SpeedError};
pub use stalls::{Pattern, Stalls};
pub use verilate::{Builder, Progress, Spec};
