//! Files of one folder that belong together.

use super::scratch::{is_temporary, own};
use super::{publish, Scratch, Tidy, WriteError};
use rustix::fs::{renameat_with, RenameFlags, CWD};
use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs::{self, DirEntry, File, Metadata};
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

/// Files that appear in a folder together, and replace those of an older set together.
///
/// They are made in a new folder. It gets hard links to all other files of the old one, and is exchanged for
/// it: at any time the folder has one of the two sets, whole. What somebody else put into the old folder
/// meanwhile is moved over. The new folder has the owner and the permissions of the old one, but neither its
/// access control lists nor its extended attributes.
///
/// Some folders cannot be exchanged: one with folders in it, the working folder of this process, a mount point,
/// one beside which nothing can be made, and any on a file system without exchange or hard links. There the files
/// of the older set are removed first, then those of the new one are renamed into place: a kill in that moment
/// leaves some of one set, never files of both. The file that was added last is the first to go and the last to
/// come: as long as it is there, its set is whole.
#[derive(Debug)]
pub struct Set {
    folder: PathBuf,
    scratch: Scratch,
    names: Vec<OsString>,
    _tidy: Tidy,
}

impl Set {
    /// A set for a folder, which is made with those above it if need be.
    ///
    /// # Errors
    /// Where neither beside the folder nor in it anything can be written.
    pub fn new(folder: &Path) -> Result<Set, WriteError> {
        let tidy = Tidy::new(folder);
        let make = || match fs::canonicalize(folder) {
            Ok(old) => {
                let beside = beside(&old).map(Scratch::new);
                let scratch = match beside {
                    Some(Ok(scratch)) => scratch,
                    _ => Scratch::new(&old)?,
                };
                Ok((old, scratch))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                fs::create_dir_all(super::parent(folder))?;
                Ok((folder.to_owned(), Scratch::new(super::parent(folder))?))
            }
            Err(error) => Err(error),
        };
        let (place, scratch) =
            make().map_err(|source| WriteError { file: folder.to_owned(), source })?;
        Ok(Set { folder: place, scratch, names: Vec::new(), _tidy: tidy })
    }

    /// Where to write the file of that name meanwhile.
    pub fn add(&mut self, name: impl Into<OsString>) -> PathBuf {
        let name = name.into();
        let file = self.scratch.path().join(&name);
        self.names.push(name);
        file
    }

    /// Puts the files in their place, and removes those of an older set that are `stale`.
    ///
    /// # Errors
    /// Where that cannot be done; the folder then has what it had, or nothing of either set.
    pub fn finish(self, stale: &[&str]) -> Result<(), WriteError> {
        let folder = self.folder.clone();
        self.put(stale).map_err(|source| WriteError { file: folder, source })
    }

    fn put(self, stale: &[&str]) -> io::Result<()> {
        for name in &self.names {
            File::open(self.scratch.path().join(name))?.sync_all()?;
        }
        if !self.is_inside() {
            super::sync_folder(self.scratch.path())?;
            let (new, place) = (self.scratch.path(), &self.folder);
            match renameat_with(CWD, new, CWD, place, RenameFlags::NOREPLACE) {
                Ok(()) => {
                    self.scratch.keep();
                    return super::sync_folder(super::parent(&self.folder));
                }
                Err(_) => {
                    fs::create_dir_all(place)?;
                    let _lock = lock(place)?;
                    if self.exchange(stale)? {
                        return super::sync_folder(super::parent(place));
                    }
                }
            }
        }
        self.one_by_one(stale)
    }

    /// Whether the files are made in the folder itself.
    fn is_inside(&self) -> bool {
        self.scratch.path().parent() == Some(&self.folder)
    }

    /// Replaces the folder; says whether it could.
    fn exchange(&self, stale: &[&str]) -> io::Result<bool> {
        let own: BTreeSet<&OsStr> = self
            .names
            .iter()
            .map(OsString::as_os_str)
            .chain(stale.iter().map(OsStr::new))
            .collect();
        let (new, old) = (self.scratch.path(), fs::metadata(&self.folder)?);
        if beside(&self.folder).is_none() || like(new, &old).is_err() {
            return Ok(false);
        }
        for entry in others(&self.folder, &own)? {
            if fs::hard_link(entry.path(), new.join(entry.file_name())).is_err() {
                return Ok(false);
            }
        }
        super::sync_folder(new)?;
        if publish::exchange(new, &self.folder).is_err() {
            return Ok(false);
        }
        // The names are exchanged: the older folder is the temporary one now.
        for entry in others(new, &own)? {
            let place = self.folder.join(entry.file_name());
            let inode = |metadata: Metadata| metadata.ino();
            if fs::symlink_metadata(&place).ok().map(inode) != entry.metadata().ok().map(inode) {
                fs::rename(entry.path(), place)?;
            }
        }
        Ok(true)
    }

    /// Replaces the files, the last one of the set first and last.
    fn one_by_one(&self, stale: &[&str]) -> io::Result<()> {
        let place = |name: &OsString| self.folder.join(name);
        if let Some(taken) = self.names.iter().find(|&name| place(name).is_dir()) {
            let message = format!("{} is a folder", taken.display());
            return Err(io::Error::new(io::ErrorKind::IsADirectory, message));
        }
        let remove = |name: &Path| match fs::remove_file(self.folder.join(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        };
        self.names.iter().rev().try_for_each(|name| remove(name.as_ref()))?;
        stale.iter().try_for_each(|name| remove(name.as_ref()))?;
        // Nothing of the older set comes back where the new one is.
        super::sync_folder(&self.folder)?;
        for name in &self.names {
            if let Err(error) = fs::rename(self.scratch.path().join(name), place(name)) {
                self.names.iter().rev().for_each(|name| drop(remove(name.as_ref())));
                return Err(error);
            }
        }
        super::sync_folder(&self.folder)
    }
}

/// The folder beside which a new one can be made to be exchanged for this one.
fn beside(folder: &Path) -> Option<&Path> {
    let parent = folder.parent()?;
    let (here, above) = (fs::metadata(folder).ok()?, fs::metadata(parent).ok()?);
    let working = fs::metadata(".").ok()?;
    let is_working = (working.dev(), working.ino()) == (here.dev(), here.ino());
    let has_folders = fs::read_dir(folder)
        .ok()?
        .flatten()
        .any(|entry| entry.file_type().map_or(true, |kind| kind.is_dir()));
    (here.dev() == above.dev() && !is_working && !has_folders).then_some(parent)
}

/// What else is in a folder.
fn others(folder: &Path, own: &BTreeSet<&OsStr>) -> io::Result<Vec<DirEntry>> {
    let is_other = |entry: &DirEntry| {
        let name = entry.file_name();
        !own.contains(name.as_os_str()) && !is_temporary(&name.to_string_lossy())
    };
    fs::read_dir(folder)?.filter(|e| e.as_ref().map_or(true, is_other)).collect()
}

/// Gives a folder the owner and the permissions of another one.
fn like(folder: &Path, other: &Metadata) -> io::Result<()> {
    let now = fs::metadata(folder)?;
    if (now.uid(), now.gid()) != (other.uid(), other.gid()) {
        std::os::unix::fs::chown(folder, Some(other.uid()), Some(other.gid()))?;
    }
    fs::set_permissions(folder, other.permissions())
}

/// The lock of a folder, by which sets follow one another. It is held for moments.
fn lock(folder: &Path) -> io::Result<File> {
    loop {
        let opened = File::open(folder)?;
        match own(&opened, folder) {
            Ok(()) => return Ok(opened),
            // Another set took its place meanwhile.
            Err(error) if error.kind() == io::ErrorKind::NotFound && folder.is_dir() => {}
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::{symlink, PermissionsExt};

    fn put(folder: &Path, files: &[(&str, &str)], stale: &[&str]) -> Result<(), WriteError> {
        let mut set = Set::new(folder)?;
        for (name, content) in files {
            fs::write(set.add(*name), content).unwrap();
        }
        set.finish(stale)
    }

    fn content(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
        let mut content: Vec<String> = entries
            .map(|entry| {
                let text = fs::read_to_string(entry.path()).unwrap_or("folder".into());
                format!("{}={text}", entry.file_name().display())
            })
            .collect();
        content.sort();
        content
    }

    #[test]
    fn a_set_replaces_an_older_one_and_leaves_the_rest() {
        let folder = tempfile::tempdir().unwrap();
        let p = folder.path().join("a/p");
        put(&p, &[("x", "1"), ("y", "1")], &[]).unwrap();
        fs::write(p.join("notes"), "mine").unwrap();
        fs::set_permissions(&p, fs::Permissions::from_mode(0o750)).unwrap();
        let before = fs::metadata(&p).unwrap();
        let link = folder.path().join("link");
        symlink("a/p", &link).unwrap();
        put(&link, &[("x", "2"), ("z", "2")], &["y"]).unwrap();
        assert_eq!(content(&p), ["notes=mine", "x=2", "z=2"]);
        let after = fs::metadata(&p).unwrap();
        assert_ne!(before.ino(), after.ino(), "the folder was exchanged");
        assert_eq!(after.permissions(), before.permissions());
        assert!(link.is_symlink());
        assert_eq!(content(&folder.path().join("a")), ["p=folder"]);
    }

    #[test]
    fn a_folder_with_folders_gets_its_files_one_by_one() {
        let folder = tempfile::tempdir().unwrap();
        let p = folder.path().join("p");
        fs::create_dir_all(p.join("sub")).unwrap();
        fs::write(p.join("y"), "older").unwrap();
        put(&p, &[("x", "1"), ("z", "1")], &["y"]).unwrap();
        assert_eq!(content(&p), ["sub=folder", "x=1", "z=1"]);
        // A name that is taken is seen before anything goes.
        let error = put(&p, &[("x", "2"), ("sub", "2")], &["z"]).unwrap_err().to_string();
        assert!(error.contains("sub is a folder"), "{error}");
        assert_eq!(content(&p), ["sub=folder", "x=1", "z=1"]);
        assert_eq!(content(folder.path()), ["p=folder"]);
    }

    #[test]
    fn a_set_that_is_not_finished_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut set = Set::new(&folder.path().join("a/b")).unwrap();
        fs::write(set.add("x"), "1").unwrap();
        set.add("never written");
        assert!(set.finish(&[]).is_err());
        assert_eq!(content(folder.path()), [""; 0]);
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(put(&file, &[("x", "")], &[]).is_err());
        assert!(put(&file.join("p"), &[("x", "")], &[]).is_err());
    }

    #[test]
    fn sets_of_several_threads_follow_one_another() {
        let folder = tempfile::tempdir().unwrap();
        let p = folder.path().join("p");
        std::thread::scope(|scope| {
            for thread in 0..4 {
                let p = &p;
                scope.spawn(move || {
                    for n in 0..8 {
                        let own = format!("{thread}-{n}");
                        put(p, &[(&own, ""), ("x", &own), ("y", &own)], &[]).unwrap();
                    }
                });
            }
        });
        let all = content(&p);
        assert_eq!(all.len(), 4 * 8 + 2, "{all:?}");
        assert_eq!(all[32].strip_prefix("x="), all[33].strip_prefix("y="), "of one set");
        assert_eq!(content(folder.path()), ["p=folder"]);
    }
}
