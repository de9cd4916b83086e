//! Files and folders that are not left behind: temporary ones, also of killed processes, and empty ones.

use super::lock::own;
use super::temporary::Temporary;
use super::waiting::Waiting;
use super::WriteError;
use std::fs::{self, File, OpenOptions, Permissions};
use std::io;
use std::os::unix::fs::{OpenOptionsExt, PermissionsExt};
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempDir};

const PREFIX: &str = ".wheatstone-";
const SUFFIX: &str = ".part";

/// A temporary folder of this process alone, removed when dropped.
///
/// It is locked as long as its owner lives; one that is not locked belongs to nobody, and goes when
/// the next is made beside it.
#[derive(Debug)]
pub struct Scratch {
    folder: TempDir,
    _temporary: Temporary,
    _lock: File,
}

impl Scratch {
    /// A new folder in `parent`, which is made if there is none.
    pub fn below(parent: &Path) -> Result<Scratch, WriteError> {
        let at = |source| WriteError { file: parent.to_owned(), source };
        fs::create_dir_all(parent).map_err(at)?;
        Scratch::new(parent).map_err(at)
    }

    /// A new folder in `parent`.
    pub fn new(parent: &Path) -> io::Result<Scratch> {
        sweep(parent);
        loop {
            // As for any new folder: the umask decides.
            let mode = Permissions::from_mode(0o777);
            let mut builder = tempfile::Builder::new();
            builder.prefix(PREFIX).suffix(SUFFIX).permissions(mode);
            let (temporary, folder) =
                Temporary::make(|| builder.tempdir_in(parent), |folder| folder.path())?;
            let lock = File::open(folder.path());
            match lock.and_then(|lock| own(&lock, folder.path(), &Waiting::usual()).map(|_| lock)) {
                Ok(lock) => return Ok(Scratch { folder, _temporary: temporary, _lock: lock }),
                // Another process took it for one that belongs to nobody.
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The folder got a name for good, and stays.
    pub(super) fn keep(self) {
        let _ = self.folder.keep();
    }
}

/// A new temporary file, locked as a [`Scratch`] is.
pub(super) fn file(parent: &Path) -> io::Result<(Temporary, NamedTempFile)> {
    sweep(parent);
    loop {
        let mode = Permissions::from_mode(0o666);
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX).permissions(mode);
        let (temporary, file) =
            Temporary::make(|| builder.tempfile_in(parent), |file| file.path())?;
        match own(file.as_file(), file.path(), &Waiting::usual()) {
            Ok(()) => return Ok((temporary, file)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
    }
}

/// True if a name is that of something temporary.
pub(super) fn is_temporary(name: &str) -> bool {
    name.starts_with(PREFIX) && name.ends_with(SUFFIX)
}

/// Removes what dead processes left. What cannot be removed now, as a child of the dead may still write
/// there, goes another time.
fn sweep(parent: &Path) {
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        if is_temporary(&entry.file_name().to_string_lossy()) {
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            let _ = remove_if_free(&entry.path(), is_folder);
        }
    }
}

/// Removes what nobody has locked; keeps it locked meanwhile, so that nobody takes it for new.
fn remove_if_free(path: &Path, is_folder: bool) -> io::Result<()> {
    // A link of that name may lead to a device, and belongs to somebody else.
    let flags = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOFOLLOW;
    let flags = flags.bits() as i32;
    let file = OpenOptions::new().read(true).custom_flags(flags).open(path)?;
    file.try_lock()?;
    if is_folder {
        fs::remove_dir_all(path)
    } else {
        fs::remove_file(path)
    }
}

/// Folders that were not there before: those that are empty are removed when this is dropped.
#[derive(Debug)]
pub struct Tidy {
    folders: Vec<PathBuf>,
    _temporary: Temporary,
}

impl Tidy {
    /// A folder that may be made, and those above it.
    pub fn new(folder: &Path) -> Tidy {
        let missing = folder.ancestors().take_while(|f| !f.as_os_str().is_empty() && !f.exists());
        let folders: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
        Tidy { _temporary: Temporary::if_empty(&folders), folders }
    }
}

impl Drop for Tidy {
    fn drop(&mut self) {
        // The lowest comes first; one with something in it cannot be removed.
        self.folders.iter().for_each(|folder| drop(fs::remove_dir(folder)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_folders_that_belong_to_nobody_are_swept() {
        let parent = tempfile::tempdir().unwrap();
        let names = [".wheatstone-dead.part", ".wheatstone-notes", ".filter-x", "a.part"];
        for name in names {
            fs::create_dir(parent.path().join(name)).unwrap();
            fs::write(parent.path().join(name).join("file"), "").unwrap();
        }
        let first = Scratch::new(parent.path()).unwrap();
        let second = Scratch::new(parent.path()).unwrap();
        assert!(first.path().is_dir() && second.path().is_dir(), "both live");
        for name in names {
            assert_eq!(parent.path().join(name).exists(), !name.contains("dead"), "{name}");
        }
        drop(first);
        super::super::publish(second, &parent.path().join("kept")).unwrap();
        let left = fs::read_dir(parent.path()).unwrap().count();
        assert_eq!(left, names.len(), "one of them went, one was kept");
    }

    #[test]
    fn new_folders_stay_if_something_is_in_them() {
        let parent = tempfile::tempdir().unwrap();
        let (empty, used) = (parent.path().join("a/b/c"), parent.path().join("x/y/z"));
        let tidy = [Tidy::new(&empty), Tidy::new(&used)];
        fs::create_dir_all(&empty).unwrap();
        fs::create_dir_all(&used).unwrap();
        fs::write(parent.path().join("x/y/file"), "").unwrap();
        drop(tidy);
        assert!(!parent.path().join("a").exists());
        assert!(!used.exists() && parent.path().join("x/y/file").exists());
    }
}
