//! Files: read with a limit, and written so that each, or each set of them, is whole or not there.
//!
//! Everything that the programs read or leave behind goes through here. A kill between any two system calls
//! leaves what was there before or what is new; only a temporary file or folder may stay, which the next run
//! in its folder removes.

mod lock;
mod publish;
mod read;
mod scratch;
mod set;
mod temporary;
mod waiting;
mod write;

pub use lock::{Lock, LockError};
pub use publish::publish;
pub use read::{irregular, read, read_own, ReadError, OWN_LIMIT};
pub use scratch::{Scratch, Tidy};
pub use set::Set;
pub use temporary::remove_temporary;
pub use waiting::on_wait;
pub use write::{replaced, write, WriteError};

use std::fs::{File, FileType};
use std::io;
use std::os::unix::fs::FileTypeExt;
use std::path::Path;

/// What a path leads to, if neither to a file nor to a folder.
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

/// Sees to it that the names in a folder outlast a loss of power, where its file system can do that.
fn sync_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(()),
        result => result,
    }
}
