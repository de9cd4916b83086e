//! What can be wrong with a pack.

use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// A pack could not be written, or is not to be trusted.
#[derive(Debug, Error)]
pub enum PackError {
    /// A file or folder could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// Which one.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The manifest is no manifest.
    #[error("{path}: line {line}, column {column}: {message}")]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// Line of the fault.
        line: usize,
        /// Column of the fault.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// A field of the manifest does not fit the rest.
    #[error("{path}: field {field}: {found}, expected {expected}")]
    Field {
        /// The manifest.
        path: PathBuf,
        /// Which field.
        field: String,
        /// What it says.
        found: String,
        /// What it must say.
        expected: String,
    },
    /// The folder has no pack, nor packs in its folders.
    #[error("{path}: no vector pack here (a pack has a file manifest.json); write one with: wheatstone vectors --out {path}")]
    Missing {
        /// The folder.
        path: PathBuf,
    },
}

impl PackError {
    /// An input or output error at a path.
    pub(super) fn at(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> PackError {
        let path = path.into();
        move |source| PackError::File { path, source }
    }
}
