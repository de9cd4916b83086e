//! Why a file or a folder was not written.

use crate::text::printable_path;
use std::io;
use std::path::PathBuf;

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {source}", printable_path(.file))]
pub struct WriteError {
    /// The file.
    pub file: PathBuf,
    /// Why.
    pub source: io::Error,
}
