//! A whole folder that appears, or takes the place of an older one, at once.

use super::{Scratch, WriteError};
use rustix::fs::{renameat_with, RenameFlags, CWD};
use rustix::io::Errno;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Gives a finished folder its name for good. An older folder of that name is exchanged for it and then removed:
/// at any time one of the two is there, whole. Where the name is a symbolic link, the folder that it leads to is
/// replaced. All of the content is on the disk before.
///
/// `finished` must be beside `folder`: of the same file system. On one that cannot exchange folders (NFS, FAT) the
/// older one is renamed to `NAME.older` for that moment, where a kill leaves it.
///
/// # Errors
/// If the folder cannot be put there; it is then as it was before.
pub fn publish(finished: Scratch, folder: &Path) -> Result<(), WriteError> {
    put(finished, folder).map_err(|source| WriteError { file: folder.to_owned(), source })
}

fn put(finished: Scratch, folder: &Path) -> io::Result<()> {
    sync(finished.path())?;
    let place = match fs::metadata(folder) {
        Ok(there) if !there.is_dir() => return Err(io::ErrorKind::NotADirectory.into()),
        Ok(_) => fs::canonicalize(folder)?,
        Err(_) => folder.to_owned(),
    };
    let parent = super::parent(&place);
    match renameat_with(CWD, finished.path(), CWD, &place, RenameFlags::NOREPLACE) {
        Ok(()) => finished.keep(),
        Err(Errno::EXIST) => match exchange(finished.path(), &place) {
            Err(error) if cannot(error) => aside(finished.path(), &place)?,
            result => result?,
        },
        Err(error) if cannot(error) => aside(finished.path(), &place)?,
        Err(error) => return Err(error.into()),
    }
    super::sync_folder(parent)
}

/// True if a file system has no such way of renaming.
fn cannot(error: Errno) -> bool {
    matches!(error, Errno::INVAL | Errno::NOSYS | Errno::OPNOTSUPP)
}

/// Exchanges two folders; the first name is then that of the older one.
pub(super) fn exchange(new: &Path, place: &Path) -> Result<(), Errno> {
    renameat_with(CWD, new, CWD, place, RenameFlags::EXCHANGE)
}

/// Puts a folder in the place of an older one by renaming one after the other.
fn aside(new: &Path, place: &Path) -> io::Result<()> {
    let mut older = place.as_os_str().to_owned();
    older.push(".older");
    let older = PathBuf::from(older);
    if older.exists() {
        let message = format!("{} is in the way: remove it, or move it back", older.display());
        return Err(io::Error::new(io::ErrorKind::AlreadyExists, message));
    }
    if !place.exists() {
        return fs::rename(new, place);
    }
    fs::rename(place, &older)?;
    if let Err(error) = fs::rename(new, place) {
        fs::rename(&older, place)?;
        return Err(error);
    }
    fs::rename(&older, new)
}

/// Brings a folder with all that is in it to the disk.
fn sync(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let kind = entry.file_type()?;
        if kind.is_dir() {
            sync(&entry.path())?;
        } else if kind.is_file() {
            super::sync(&File::open(entry.path())?)?;
        }
    }
    super::sync_folder(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(parent: &Path, content: &str) -> Scratch {
        let scratch = Scratch::new(parent).unwrap();
        fs::create_dir(scratch.path().join("sub")).unwrap();
        fs::write(scratch.path().join("sub/file"), content).unwrap();
        scratch
    }

    fn names(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name());
        let mut names: Vec<String> = names.map(|n| n.into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_folder_appears_and_is_replaced_as_a_whole() {
        let parent = tempfile::tempdir().unwrap();
        let at = |name: &str| parent.path().join(name);
        std::os::unix::fs::symlink("x", at("link")).unwrap();
        publish(made(parent.path(), "1"), &at("x")).unwrap();
        fs::write(at("x/older"), "").unwrap();
        publish(made(parent.path(), "2"), &at("link")).unwrap();
        assert_eq!(fs::read_to_string(at("x/sub/file")).unwrap(), "2");
        assert_eq!(names(&at("x")), ["sub"]);
        fs::write(at("file"), "").unwrap();
        assert!(publish(made(parent.path(), "3"), &at("file")).is_err());
        assert!(publish(made(parent.path(), "3"), &at("none/x")).is_err());
        assert_eq!(names(parent.path()), ["file", "link", "x"]);
    }

    #[test]
    fn a_folder_is_on_the_disk_before_it_has_its_name() {
        let parent = tempfile::tempdir().unwrap();
        for content in ["old", "new"] {
            publish(made(parent.path(), content), &parent.path().join("x")).unwrap();
            assert_eq!(super::super::synced::take(parent.path()), ["*/sub/file", "*/sub", "*", ""]);
        }
    }

    #[test]
    fn without_exchange_the_older_folder_steps_aside() {
        let parent = tempfile::tempdir().unwrap();
        let at = |name: &str| parent.path().join(name);
        for content in ["1", "2"] {
            aside(made(parent.path(), content).path(), &at("x")).unwrap();
            assert_eq!(fs::read_to_string(at("x/sub/file")).unwrap(), content);
            assert_eq!(names(parent.path()), ["x"]);
        }
        fs::create_dir(at("x.older")).unwrap();
        let error = aside(made(parent.path(), "3").path(), &at("x")).unwrap_err().to_string();
        assert!(error.contains("x.older is in the way"), "{error}");
        assert_eq!(fs::read_to_string(at("x/sub/file")).unwrap(), "2");
    }
}
