//! Committed records of a workspace: JSON files that are read in one way.

use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use thiserror::Error;
use wheatstone_golden::files;
use wheatstone_golden::text::printable_path;

/// The record could not be read.
#[derive(Debug, Error)]
#[error("{}: {why}; {remedy}", printable_path(.path))]
pub struct RecordError {
    /// The file.
    pub path: PathBuf,
    /// The cause.
    pub why: String,
    /// The command that writes it, or a way to mend it.
    pub remedy: &'static str,
}

/// Reads a committed record of a workspace; `remedy` is for the error where it cannot be read.
pub fn read_record<T: DeserializeOwned>(
    workspace: &Path,
    file: &str,
    remedy: &'static str,
) -> Result<T, RecordError> {
    let path = workspace.join(file);
    let parsed = files::read_own(&path)
        .map_err(|error| error.to_string())
        .and_then(|text| serde_json::from_str(&text).map_err(|error| error.to_string()));
    parsed.map_err(|why| RecordError { path, why, remedy })
}
