//! Errors of vector packs.

use crate::shell::{command_line, operand};
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;
use wheatstone_golden::text::{printable, printable_path};

/// A pack could not be written, or is not to be trusted.
#[derive(Debug, Error)]
pub enum PackError {
    /// A file or folder could not be read or written.
    #[error("{}: {source}", printable_path(.path))]
    File {
        /// Which one.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The manifest is no manifest.
    #[error("{}: line {line}, column {column}: {}; get the pack again, or write it again with wheatstone vectors", printable_path(.path), printable(.message))]
    Manifest {
        /// The manifest.
        path: PathBuf,
        /// Line of the fault.
        line: usize,
        /// Column of the fault.
        column: usize,
        /// The fault.
        message: String,
    },
    /// A field of the manifest does not fit the rest.
    #[error("{}: field {}: {}, expected {}", printable_path(.path), printable(.field), printable(.found), printable(.expected))]
    Field {
        /// The manifest.
        path: PathBuf,
        /// Which field.
        field: String,
        /// Its value.
        found: String,
        /// The value that it must have.
        expected: String,
    },
    /// There is no folder of that name.
    #[error("{}: {found}; name the folder of a pack or of packs, as written by: wheatstone vectors --out DIR", printable_path(.path))]
    NoFolder {
        /// The name.
        path: PathBuf,
        /// Kind of the thing that is there.
        found: String,
    },
    /// The folder has no pack, nor packs in its folders.
    #[error("{0}: no vector pack here (a pack has a file manifest.json); write one with: {1}", printable_path(.path), written_into(.path))]
    Missing {
        /// The folder.
        path: PathBuf,
    },
    /// Nothing comes out that could differ.
    #[error("{}: nothing in it is compared: no output beat and no flag; write it with more --beats, or of another --case, --scene or --seed", printable_path(.path))]
    Vain {
        /// The pack.
        path: PathBuf,
    },
    /// The folder has more than a pack.
    #[error("{}: {} is no file of this pack; remove it, or move it out of the folder", printable_path(.path), printable(.file))]
    Extra {
        /// The folder.
        path: PathBuf,
        /// Name of the file.
        file: String,
    },
    /// The vectors are more than a pack may have.
    #[error("{}: {bytes} bytes, more than the {limit} that a file of a pack may have; ask for fewer --beats", printable_path(.path))]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its bytes.
        bytes: u64,
        /// Most bytes of a file.
        limit: u64,
    },
}

/// The command that writes packs into a folder.
fn written_into(folder: &Path) -> String {
    let words = ["wheatstone", "vectors", "--out"].map(|word| OsStr::new(word).into());
    command_line(words.into_iter().chain([operand(folder)]))
}

impl PackError {
    /// An input or output error at a path.
    pub(super) fn at(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> PackError {
        let path = path.into();
        move |source| PackError::File { path, source }
    }
}
