//! Co-simulation: Verilator models driven from Rust.

pub mod cases;
pub mod pack;
