//! A finished pack in its place.

use super::{is_pack, PackError};
use std::fs;
use std::io;
use std::path::Path;
use wheatstone_golden::files::{self, Lock, Scratch};

/// Gives a finished folder its name, in exchange for an older pack that has it, which is removed then. A process
/// that is killed at any moment leaves the old or the new one.
pub(super) fn publish(finished: Scratch, folder: &Path) -> Result<(), PackError> {
    let parent = folder.parent().filter(|parent| *parent != Path::new(""));
    let parent = parent.unwrap_or(Path::new("."));
    let _lock = Lock::of_folder(parent).map_err(|error| PackError::at(error.file)(error.source))?;
    replaceable(folder)?;
    files::publish(finished, folder).map_err(|e| PackError::at(e.file)(e.source))
}

/// Refuses a place that has anything else than a pack.
pub fn replaceable(folder: &Path) -> Result<(), PackError> {
    match fs::symlink_metadata(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(PackError::at(folder)(error)),
        Ok(found) if found.is_dir() && is_pack(folder) => Ok(()),
        Ok(_) => {
            let why =
                "exists and is no vector pack; it is left alone: move it, or name another --out";
            Err(PackError::at(folder)(io::Error::other(why)))
        }
    }
}
