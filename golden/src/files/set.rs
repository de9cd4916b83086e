//! Files of one folder that belong together.

use super::scratch::is_temporary;
use super::{publish, Lock, Scratch, Tidy, WriteError};
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
/// leaves some of one set, never files of both. The main file of a set is the first to go and the last to come:
/// as long as it is there, its set is whole.
#[derive(Debug)]
pub struct Set {
    folder: PathBuf,
    /// Path of the folder without symbolic links.
    place: PathBuf,
    scratch: Scratch,
    _tidy: Tidy,
}

impl Set {
    /// A set for a folder, which is made with those above it if need be.
    ///
    /// # Errors
    /// If nothing can be written, neither beside the folder nor in it.
    pub fn new(folder: &Path) -> Result<Set, WriteError> {
        let folder = if folder == Path::new("") { Path::new(".") } else { folder };
        let tidy = Tidy::new(folder);
        let make = || match fs::canonicalize(folder) {
            Ok(place) => match beside(&place).map(Scratch::new) {
                Some(Ok(scratch)) => Ok((place, scratch)),
                _ => Scratch::new(&place).map(|scratch| (place, scratch)),
            },
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let parent = super::parent(folder);
                fs::create_dir_all(parent)?;
                Ok((folder.to_owned(), Scratch::new(parent)?))
            }
            Err(error) => Err(error),
        };
        let (place, scratch) = make().map_err(at(folder))?;
        Ok(Set { folder: folder.to_owned(), place, scratch, _tidy: tidy })
    }

    /// The folder to write the files into.
    pub fn path(&self) -> &Path {
        self.scratch.path()
    }

    /// The name that a file in [`Set::path`] is going to have.
    pub fn named(&self, file: &Path) -> PathBuf {
        let name = file.strip_prefix(self.path());
        name.map_or_else(|_| file.to_owned(), |name| self.folder.join(name))
    }

    /// Puts the files into their place, and removes those of an older set: the ones with the same names and those that
    /// are `stale`.
    ///
    /// # Errors
    /// If that cannot be done; the folder then has what it had, or nothing of either set.
    pub fn finish(self, main: &str, stale: impl Fn(&str) -> bool) -> Result<(), WriteError> {
        let mut names = Vec::new();
        for entry in fs::read_dir(self.path()).map_err(at(&self.folder))? {
            names.push(entry.map_err(at(&self.folder))?.file_name());
        }
        names.sort_by_key(|name| name == main);
        for name in &names {
            let file = self.path().join(name);
            File::open(&file)
                .and_then(|file| super::sync(&file))
                .map_err(at(&self.named(&file)))?;
        }
        let own: BTreeSet<&OsStr> = names.iter().map(OsString::as_os_str).collect();
        let is_own = |name: &OsStr| own.contains(name) || name.to_str().is_some_and(&stale);
        if self.scratch.path().parent() != Some(&self.place) {
            match self.replace(&is_own) {
                Ok(Replaced::New) => {
                    self.scratch.keep();
                    return Ok(());
                }
                Ok(Replaced::Older) => return Ok(()),
                Ok(Replaced::Not) => {}
                Err(source) => return Err(at(&self.folder)(source)),
            }
        }
        self.one_by_one(&names, &is_own)
    }

    /// Puts the new folder into its place, if it can.
    fn replace(&self, is_own: &dyn Fn(&OsStr) -> bool) -> io::Result<Replaced> {
        let (new, place) = (self.path(), &self.place);
        super::sync_folder(new)?;
        if renameat_with(CWD, new, CWD, place, RenameFlags::NOREPLACE).is_ok() {
            super::sync_folder(super::parent(place))?;
            return Ok(Replaced::New);
        }
        fs::create_dir_all(place)?;
        let _lock = Lock::of_folder(place).map_err(|error| error.source)?;
        let old = fs::metadata(place)?;
        if beside(place).is_none() || like(new, &old).is_err() {
            return Ok(Replaced::Not);
        }
        for entry in others(place, is_own)? {
            if fs::hard_link(entry.path(), new.join(entry.file_name())).is_err() {
                return Ok(Replaced::Not);
            }
        }
        super::sync_folder(new)?;
        if publish::exchange(new, place).is_err() {
            return Ok(Replaced::Not);
        }
        // The names are exchanged: the older folder is the temporary one now.
        for entry in others(new, is_own)? {
            let moved = place.join(entry.file_name());
            let inode = |metadata: Metadata| metadata.ino();
            if fs::symlink_metadata(&moved).ok().map(inode) != entry.metadata().ok().map(inode) {
                fs::rename(entry.path(), moved)?;
            }
        }
        super::sync_folder(super::parent(place))?;
        Ok(Replaced::Older)
    }

    /// Replaces the files, of which the main one is the last.
    fn one_by_one(
        &self,
        names: &[OsString],
        is_own: &dyn Fn(&OsStr) -> bool,
    ) -> Result<(), WriteError> {
        if let Some(taken) = names.iter().find(|&name| self.place.join(name).is_dir()) {
            return Err(at(&self.folder.join(taken))(io::ErrorKind::IsADirectory.into()));
        }
        let remove = |name: &OsStr| match fs::remove_file(self.place.join(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(at(&self.folder.join(name))(error))
            }
            _ => Ok(()),
        };
        names.iter().rev().try_for_each(|name| remove(name))?;
        for entry in fs::read_dir(&self.place).map_err(at(&self.folder))?.flatten() {
            if is_own(&entry.file_name()) {
                remove(&entry.file_name())?;
            }
        }
        // Nothing of the older set comes back where the new one is.
        super::sync_folder(&self.place).map_err(at(&self.folder))?;
        for name in names {
            if let Err(error) = fs::rename(self.path().join(name), self.place.join(name)) {
                names.iter().rev().for_each(|name| drop(remove(name)));
                return Err(at(&self.folder.join(name))(error));
            }
        }
        super::sync_folder(&self.place).map_err(at(&self.folder))
    }
}

/// Outcome of the replacement of a set's folder as a whole.
enum Replaced {
    /// There was none before.
    New,
    /// It took the place of an older one.
    Older,
    /// It must be filled file by file.
    Not,
}

fn at(file: &Path) -> impl Fn(io::Error) -> WriteError + '_ {
    move |source| WriteError { file: file.to_owned(), source }
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

/// Entries of a folder that are neither the set's own nor temporary.
fn others(folder: &Path, is_own: &dyn Fn(&OsStr) -> bool) -> io::Result<Vec<DirEntry>> {
    let is_other = |entry: &DirEntry| {
        let name = entry.file_name();
        !is_own(&name) && !is_temporary(&name.to_string_lossy())
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::{symlink, PermissionsExt};

    fn put(folder: &Path, files: &[(&str, &str)], stale: &[&str]) -> Result<(), WriteError> {
        let set = Set::new(folder)?;
        for (name, content) in files {
            fs::write(set.path().join(name), content).unwrap();
        }
        set.finish(files[0].0, |name| stale.contains(&name))
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
        assert!(error.contains("p/sub: cannot be written: is a directory"), "{error}");
        assert_eq!(content(&p), ["sub=folder", "x=1", "z=1"]);
        assert_eq!(content(folder.path()), ["p=folder"]);
    }

    #[test]
    fn a_set_is_on_the_disk_before_it_has_its_names() {
        let folder = tempfile::tempdir().unwrap();
        let synced = |files: &[(&str, &str)]| {
            put(&folder.path().join("p"), files, &[]).unwrap();
            super::super::synced::take(folder.path())
        };
        // A new folder, one that is exchanged, and one with a folder in it.
        assert_eq!(synced(&[("x", "1"), ("y", "1")]), ["*/y", "*/x", "*", ""]);
        assert_eq!(synced(&[("x", "2"), ("y", "2")]), ["*/y", "*/x", "*", "*", ""]);
        fs::create_dir(folder.path().join("p/sub")).unwrap();
        assert_eq!(synced(&[("x", "3"), ("y", "3")]), ["p/*/y", "p/*/x", "p", "p"]);
    }

    #[test]
    fn a_set_that_is_not_finished_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let set = Set::new(&folder.path().join("a/b")).unwrap();
        let file = set.path().join("x");
        fs::write(&file, "1").unwrap();
        assert_eq!(set.named(&file), folder.path().join("a/b/x"));
        drop(set);
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
