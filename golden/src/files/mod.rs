//! Files: read with a limit, and written so that each, or each set of them, is whole or not there.
//!
//! Everything that the programs read or leave behind goes through here. A kill between any two system calls
//! leaves what was there before or what is new; only a temporary file or folder may stay, which the next run
//! in its folder removes.

mod error;
mod lock;
mod publish;
mod read;
mod scratch;
mod set;
mod temporary;
mod waiting;
mod write;

pub use error::WriteError;
pub use lock::{Lock, LockError};
pub use publish::publish;
pub use read::{irregular, read, read_own, ReadError, OWN_LIMIT};
pub use scratch::{Scratch, Tidy};
pub use set::Set;
pub use temporary::remove_temporary;
pub use waiting::on_wait;
pub use write::{replaced, write};

use std::fs::{File, FileType};
use std::io;
use std::os::unix::fs::FileTypeExt;
use std::path::Path;

/// Kind of a special file, with its article; none for files and folders.
pub fn special(kind: FileType) -> Option<&'static str> {
    if kind.is_fifo() {
        Some("a pipe (FIFO)")
    } else if kind.is_socket() {
        Some("a socket")
    } else if kind.is_char_device() || kind.is_block_device() {
        Some("a device")
    } else {
        None
    }
}

/// The folder that a file is in.
fn parent(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Brings what an open file or folder has to the disk.
fn sync(opened: &File) -> io::Result<()> {
    opened.sync_all()?;
    #[cfg(test)]
    synced::note(opened);
    Ok(())
}

/// Sees to it that the names in a folder outlast a loss of power, where its file system can do that.
fn sync_folder(folder: &Path) -> io::Result<()> {
    match sync(&File::open(folder)?) {
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(()),
        result => result,
    }
}

/// Names of the files and folders that this thread brought to the disk, as they were then.
#[cfg(test)]
mod synced {
    use super::scratch::is_temporary;
    use std::cell::RefCell;
    use std::fs::{self, File};
    use std::os::fd::AsRawFd;
    use std::path::{Path, PathBuf};

    thread_local! {
        static SYNCED: RefCell<Vec<PathBuf>> = const { RefCell::new(Vec::new()) };
    }

    pub fn note(opened: &File) {
        let name = fs::read_link(format!("/proc/self/fd/{}", opened.as_raw_fd())).unwrap();
        SYNCED.with_borrow_mut(|synced| synced.push(name));
    }

    /// The names below a folder since the last call, with `*` for each temporary name.
    pub fn take(folder: &Path) -> Vec<String> {
        let folder = fs::canonicalize(folder).unwrap();
        let part = |part: &std::ffi::OsStr| match part.to_str().unwrap() {
            part if is_temporary(part) => "*".to_owned(),
            part => part.to_owned(),
        };
        let name = |name: PathBuf| {
            let parts = name.strip_prefix(&folder).unwrap().iter().map(part);
            parts.collect::<Vec<_>>().join("/")
        };
        SYNCED.take().into_iter().map(name).collect()
    }
}
