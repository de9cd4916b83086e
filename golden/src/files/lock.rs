//! Locks between threads and processes. Who waits for one is told what for, see [`on_wait`](super::on_wait).

use super::waiting::Waiting;
use crate::text::printable_path;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Time between two tries.
const PAUSE: Duration = Duration::from_millis(20);

/// A lock was not had.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be locked: {source}", printable_path(.file))]
pub struct LockError {
    /// The lock file.
    pub file: PathBuf,
    /// The cause.
    pub source: io::Error,
}

/// A lock, given back when dropped or when the process ends, however it does.
#[derive(Debug)]
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock that a file stands for, which is made if need be, with its folder.
    ///
    /// # Errors
    /// If the file cannot be made or locked, or another has it for too long.
    pub fn take(file: &Path) -> Result<Lock, LockError> {
        let at = |source| LockError { file: file.to_owned(), source };
        take(file, &Waiting::usual()).map_err(at)
    }

    /// Takes the lock of a folder, by which those who put something there follow one another. On a file system without
    /// locks everybody has it.
    ///
    /// # Errors
    /// If the folder cannot be opened, or another has it for too long.
    pub fn of_folder(folder: &Path) -> Result<Lock, LockError> {
        let at = |source| LockError { file: folder.to_owned(), source };
        of_folder(folder, &Waiting::usual()).map_err(at)
    }
}

fn take(path: &Path, waiting: &Waiting<'_>) -> io::Result<Lock> {
    fs::create_dir_all(super::parent(path))?;
    if let Some(kind) = super::irregular(path) {
        return Err(io::Error::other(format!("expected a lock file, found {kind}; delete it")));
    }
    // Not truncated before it is ours: it says who has it.
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    let whom = || format!("{}, which has {}", holder(&file), printable_path(path));
    waiting.wait(|time| within(&file, time), whom)?;
    file.set_len(0)?;
    file.rewind()?;
    writeln!(file, "{}", std::process::id())?;
    Ok(Lock { _file: file })
}

fn of_folder(folder: &Path, waiting: &Waiting<'_>) -> io::Result<Lock> {
    loop {
        let file = File::open(folder)?;
        match own(&file, folder, waiting) {
            Ok(()) => return Ok(Lock { _file: file }),
            // Another folder took its place meanwhile.
            Err(error) if error.kind() == io::ErrorKind::NotFound && folder.is_dir() => {}
            Err(error) => return Err(error),
        }
    }
}

/// Locks what is open; an error if it is no longer what has that name.
pub(super) fn own(opened: &File, path: &Path, waiting: &Waiting<'_>) -> io::Result<()> {
    let whom = || format!("another process, which has {} locked", printable_path(path));
    // Where the file system has no locks, nobody else has one either.
    waiting.wait(|time| Ok(within(opened, time).unwrap_or(true)), whom)?;
    let (opened, there) = (opened.metadata()?, fs::symlink_metadata(path)?);
    if (opened.dev(), opened.ino()) == (there.dev(), there.ino()) {
        Ok(())
    } else {
        Err(io::ErrorKind::NotFound.into())
    }
}

/// Takes the lock of an open file; says whether it was to be had in this time.
fn within(file: &File, limit: Duration) -> io::Result<bool> {
    let start = Instant::now();
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(true),
            Err(TryLockError::Error(error)) => return Err(error),
            Err(TryLockError::WouldBlock) if start.elapsed() >= limit => return Ok(false),
            Err(TryLockError::WouldBlock) => sleep(PAUSE),
        }
    }
}

/// Who has a lock, as the file says.
fn holder(mut file: &File) -> String {
    let mut text = String::new();
    let _ = file.rewind().and_then(|()| file.take(20).read_to_string(&mut text));
    match text.trim().parse::<u32>() {
        Ok(own) if own == std::process::id() => "another thread of this process".into(),
        Ok(other) => format!("process {other}"),
        Err(_) => "another process".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT_ONCE: Waiting<'_> =
        Waiting { patience: Duration::ZERO, limit: Duration::ZERO, tell: &|_| () };

    #[test]
    fn a_lock_is_given_up_with_the_name_of_its_holder() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/lock");
        let first = take(&path, &AT_ONCE).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap().trim(), std::process::id().to_string());
        let error = take(&path, &AT_ONCE).unwrap_err().to_string();
        let expected = format!("for another thread of this process, which has {}", path.display());
        assert!(error.contains(&expected), "{error}");
        fs::write(&path, "4000000\n").unwrap();
        let error = take(&path, &AT_ONCE).unwrap_err().to_string();
        assert!(error.contains(" for process 4000000, which has "), "{error}");
        drop(first);
        take(&path, &AT_ONCE).unwrap();
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        let error = take(&path, &AT_ONCE).unwrap_err().to_string();
        assert!(error.ends_with("expected a lock file, found a folder; delete it"), "{error}");
    }

    #[test]
    fn a_folder_is_locked_by_one_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let held = of_folder(folder.path(), &AT_ONCE).unwrap();
        let error = of_folder(folder.path(), &AT_ONCE).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::TimedOut);
        let expected = format!("another process, which has {} locked", folder.path().display());
        assert!(error.to_string().contains(&expected), "{error}");
        drop(held);
        of_folder(folder.path(), &AT_ONCE).unwrap();
    }
}
