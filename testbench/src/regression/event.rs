//! Progress of the regression.

use super::entry::Entry;
use super::failure::Failure;
use crate::cases::Case;
use crate::Stalls;
use wheatstone_golden::targets::Target;

/// A step of the regression, told while it runs.
pub enum Event<'a> {
    /// A model is being built, or was.
    Build(crate::Progress<'a>),
    /// The number of cases.
    Planned(usize),
    /// A case begins.
    Begin(Target, &'a str),
    /// A case is run with these stalls.
    Run(&'a Case, Stalls),
    /// A case failed; waveforms come next.
    Mismatch(&'a Failure),
    /// A case has ended.
    End(&'a Entry),
}
