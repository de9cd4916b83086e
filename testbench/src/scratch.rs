//! Folders that are not left behind: temporary ones, also of killed processes, and empty ones.

use std::fs::{self, File, Permissions};
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use wheatstone_golden::picture::WriteError;

const PREFIX: &str = ".wheatstone-";
const SUFFIX: &str = ".part";

/// A temporary folder of this process alone, removed when dropped.
///
/// It is locked as long as its owner lives; one that is not locked belongs to nobody, and goes when
/// the next is made beside it.
pub(crate) struct Scratch {
    folder: TempDir,
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
            let folder = tempfile::Builder::new()
                .prefix(PREFIX)
                .suffix(SUFFIX)
                // As for any new folder: the umask decides.
                .permissions(Permissions::from_mode(0o777))
                .tempdir_in(parent)?;
            match lock(folder.path()) {
                Ok(lock) => return Ok(Scratch { folder, _lock: lock }),
                // Another process took it for one that belongs to nobody.
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Gives the folder its name for good.
    pub fn persist(self, name: &Path) -> io::Result<()> {
        fs::rename(self.path(), name)?;
        let _ = self.folder.keep();
        Ok(())
    }
}

/// Locks a folder that is still there then.
fn lock(folder: &Path) -> io::Result<File> {
    let file = File::open(folder)?;
    // Where the file system has no locks, nobody sweeps either.
    let _ = file.lock();
    fs::metadata(folder)?;
    Ok(file)
}

/// Removes the temporary folders of dead processes. What cannot be removed now, as a child of the dead
/// may still write there, goes another time.
fn sweep(parent: &Path) {
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && name.starts_with(PREFIX) && name.ends_with(SUFFIX) {
            let _ = remove_if_free(&entry.path());
        }
    }
}

/// Removes a folder that nobody has locked; keeps it locked meanwhile, so that nobody takes it for new.
fn remove_if_free(folder: &Path) -> io::Result<()> {
    let file = File::open(folder)?;
    file.try_lock()?;
    fs::remove_dir_all(folder)
}

/// Folders that were not there before: those that are empty are removed when this is dropped.
pub(crate) struct Tidy(Vec<PathBuf>);

impl Tidy {
    /// A folder that may be made, and those above it.
    pub fn new(folder: &Path) -> Tidy {
        let missing = folder.ancestors().take_while(|f| !f.as_os_str().is_empty() && !f.exists());
        Tidy(missing.map(Path::to_path_buf).collect())
    }
}

impl Drop for Tidy {
    fn drop(&mut self) {
        // The lowest comes first; one with something in it cannot be removed.
        self.0.iter().for_each(|folder| drop(fs::remove_dir(folder)));
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
        second.persist(&parent.path().join("kept")).unwrap();
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
