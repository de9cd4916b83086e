//! Errors of writing files and folders.

use crate::text::printable_path;
use std::io;
use std::path::PathBuf;

/// A file was not written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {source}", printable_path(.file))]
pub struct WriteError {
    /// The file.
    pub file: PathBuf,
    /// The cause.
    pub source: io::Error,
}
