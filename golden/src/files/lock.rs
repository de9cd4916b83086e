//! A lock between threads and processes that says what it waits for.

use crate::text::printable_path;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// After this time it is told that, and for whom, is waited.
const PATIENCE: Duration = Duration::from_secs(3);
/// Time between two tries.
const PAUSE: Duration = Duration::from_millis(20);

/// A lock was not had.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be locked: {source}", printable_path(.file))]
pub struct LockError {
    /// The lock file.
    pub file: PathBuf,
    /// Why.
    pub source: io::Error,
}

/// A lock, given back when dropped or when the process ends, however it does.
#[derive(Debug)]
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock that a file stands for, which is made if need be, with its folder. After some seconds `tell`
    /// gets a line about what is waited for.
    ///
    /// # Errors
    /// Where the file cannot be made or locked, and if another has it for longer than `limit`.
    pub fn take(file: &Path, limit: Duration, tell: impl FnMut(&str)) -> Result<Lock, LockError> {
        let at = |source| LockError { file: file.to_owned(), source };
        wait(file, PATIENCE, limit, tell).map_err(at)
    }
}

fn wait(
    path: &Path,
    patience: Duration,
    limit: Duration,
    mut tell: impl FnMut(&str),
) -> io::Result<Lock> {
    fs::create_dir_all(super::parent(path))?;
    if let Some(kind) = super::irregular(path) {
        return Err(io::Error::other(format!("expected a lock file, found {kind}; delete it")));
    }
    // Not truncated before it is ours: it says who has it.
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    let mut had = within(&file, patience.min(limit))?;
    if !had && patience < limit {
        tell(&format!("waiting for {}, which has {}", holder(&mut file), path.display()));
        had = within(&file, limit - patience)?;
    }
    if !had {
        let (holder, limit) = (holder(&mut file), limit.as_secs());
        let message =
            format!("{holder} has it for more than {limit} s; end it, or wait and try again");
        return Err(io::Error::new(io::ErrorKind::TimedOut, message));
    }
    file.set_len(0)?;
    file.rewind()?;
    writeln!(file, "{}", std::process::id())?;
    Ok(Lock { _file: file })
}

/// Takes the lock of an open file; says whether it was to be had in this time.
pub(super) fn within(file: &File, limit: Duration) -> io::Result<bool> {
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
fn holder(file: &mut File) -> String {
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

    #[test]
    fn a_lock_is_waited_for_and_given_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/lock");
        let take = |limit| Lock::take(&path, limit, |_| ());
        let first = take(Duration::ZERO).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap().trim(), std::process::id().to_string());
        let error = take(Duration::ZERO).unwrap_err().to_string();
        assert!(error.contains("another thread of this process has it for more than"), "{error}");
        fs::write(&path, "4000000\n").unwrap();
        let error = take(Duration::ZERO).unwrap_err().to_string();
        assert!(error.contains(": process 4000000 has it"), "{error}");

        let mut told = Vec::new();
        let error = wait(&path, PAUSE, PAUSE * 3, |line| told.push(line.to_owned()));
        assert!(error.is_err());
        let expected = format!("waiting for process 4000000, which has {}", path.display());
        assert_eq!(told, [expected]);
        drop(first);
        take(Duration::ZERO).unwrap();
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        let error = take(Duration::ZERO).unwrap_err().to_string();
        assert!(error.ends_with("expected a lock file, found a folder; delete it"), "{error}");
    }
}
