//! Models of the hardware units, one module a unit, and of the two systems made of them.

pub mod filter_tables;
mod streams;

pub use streams::*;
