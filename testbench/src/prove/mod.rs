//! Formal proofs: the properties at the ends of the modules, by induction where that closes and else for
//! so many clocks from reset; the bugs that each of them catches; and netlists against the Verilog.
//!
//! A module's own properties are proved of it with the modules inside it, whose properties are left to
//! their own proofs: only the file of the module is read with `FORMAL` defined.

mod bugs;
mod build;
mod effort;
mod netlist;
mod property;
mod prover;
pub mod record;
mod task;
mod verdict;

pub use bugs::{Bug, BUGS};
pub use build::Build;
pub use effort::{Effort, LIMIT, SHORT};
pub use netlist::Equivalence;
pub use property::{name, properties, Property};
pub use prover::Prover;
pub use verdict::{Catch, Proof, Verdict};
