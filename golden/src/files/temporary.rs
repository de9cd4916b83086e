//! Temporary files and folders, for a process that is asked to end before it is done with them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time in which folders are removed that dying children may still write to.
const REMOVAL: Duration = Duration::from_secs(1);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Remains {
    /// A file, or a folder with all that is in it.
    All(PathBuf),
    /// A folder with nothing in it.
    Empty(PathBuf),
}

static LIST: Mutex<Vec<Remains>> = Mutex::new(Vec::new());

fn list() -> MutexGuard<'static, Vec<Remains>> {
    LIST.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Marks files or folders as temporary until it is dropped, which removes nothing.
#[derive(Debug)]
pub(super) struct Temporary(Vec<Remains>);

impl Temporary {
    /// Makes a temporary file or folder; `path` tells where it is.
    pub fn make<T>(
        make: impl FnOnce() -> io::Result<T>,
        path: impl FnOnce(&T) -> &Path,
    ) -> io::Result<(Temporary, T)> {
        // Nothing is made beside the list.
        let mut list = list();
        let made = make()?;
        let remains = vec![Remains::All(path(&made).to_owned())];
        list.extend_from_slice(&remains);
        Ok((Temporary(remains), made))
    }

    /// Folders that stay only if something is in them, the lowest first.
    pub fn if_empty(folders: &[PathBuf]) -> Temporary {
        let remains: Vec<Remains> = folders.iter().cloned().map(Remains::Empty).collect();
        list().extend_from_slice(&remains);
        Temporary(remains)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let mut list = list();
        for remains in &self.0 {
            if let Some(at) = list.iter().position(|other| other == remains) {
                list.remove(at);
            }
        }
    }
}

/// Removes what is temporary, for good: whoever makes something temporary, or is done with it, then waits until
/// this process ends, which must follow. Children must have been ended before.
pub fn remove_temporary() {
    let list = list();
    let start = Instant::now();
    for remains in list.iter() {
        match remains {
            Remains::Empty(folder) => drop(fs::remove_dir(folder)),
            Remains::All(path) => {
                while remove(path).is_err() && start.elapsed() < REMOVAL {
                    thread::sleep(Duration::from_millis(5));
                }
            }
        }
    }
    std::mem::forget(list);
}

fn remove(path: &Path) -> io::Result<()> {
    let removed = match path.is_dir() {
        true => fs::remove_dir_all(path),
        false => fs::remove_file(path),
    };
    match removed {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        removed => removed,
    }
}
