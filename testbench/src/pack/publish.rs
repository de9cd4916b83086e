//! A finished pack in its place.

use super::{is_pack, PackError};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use std::time::{Duration, Instant};
use wheatstone_golden::files::{self, Scratch};
use wheatstone_golden::text::printable_path;

/// How long another writer of packs is waited for.
const LIMIT: Duration = Duration::from_secs(60);
/// After this time a writer says what it waits for.
const PATIENCE: Duration = Duration::from_secs(2);

/// Gives a finished folder its name, in exchange for an older pack that has it, which is removed then. A process
/// that is killed at any moment leaves the old or the new one.
pub(super) fn publish(finished: Scratch, folder: &Path) -> Result<(), PackError> {
    let parent = folder.parent().unwrap_or(Path::new("."));
    let _lock = lock(parent, LIMIT)?;
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

/// Keeps other writers of packs away from a folder, until the file is closed.
fn lock(folder: &Path, limit: Duration) -> Result<File, PackError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let file = File::open(folder).map_err(PackError::at(folder))?;
    let start = Instant::now();
    let mut told = false;
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            Err(TryLockError::WouldBlock) if start.elapsed() < limit => {}
            Err(TryLockError::WouldBlock) => {
                let why = "another process is putting a pack here and does not end; try again when it has";
                return Err(PackError::at(folder)(io::Error::other(why)));
            }
            // Where the file system has no locks, an exchange is whole all the same.
            Err(TryLockError::Error(_)) => return Ok(file),
        }
        if !told && start.elapsed() >= PATIENCE {
            let folder = printable_path(folder);
            let text = format!("{folder}: waiting for another process that puts a pack here");
            wheatstone_process::tell(&text);
            told = true;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_is_waited_for_no_longer_than_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let held = lock(folder.path(), LIMIT).unwrap();
        let error = lock(folder.path(), Duration::from_millis(50)).unwrap_err().to_string();
        assert!(error.contains("another process is putting a pack here"), "{error}");
        drop(held);
        lock(folder.path(), LIMIT).unwrap();
    }
}
