//! Co-simulation: Verilator models driven from Rust.
