//! Files and folders of a command line, looked at before the work: what cannot be written, or would overwrite
//! something else of the same run, is told at once.

use super::failure::Failure;
use super::options::{builtin_names, View};
use crate::pack;
use rustix::fs::{access, Access};
use std::path::{Path, PathBuf};
use std::{env, fs, io};
use wheatstone_golden::files;
use wheatstone_golden::text::printable_path;

/// The use of a place.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    Input,
    File,
    Folder,
}

/// Places that a command reads from and writes to, each with the option that names it.
#[derive(Default)]
pub(super) struct Places<'a> {
    all: Vec<(&'static str, &'a Path, Use)>,
}

impl<'a> Places<'a> {
    /// The files that a scene is read from.
    pub fn of_view(view: &'a View) -> Places<'a> {
        Places::default().scene(&view.scene).with("--rig", view.rig.as_deref(), Use::Input)
    }

    /// A scene; the name of a built-in one is that of no file.
    pub fn scene(self, name: &'a Option<String>) -> Places<'a> {
        let file = name.as_deref().filter(|name| !builtin_names().any(|known| known == *name));
        self.with("--scene", file.map(Path::new), Use::Input)
    }

    /// A file that is written.
    pub fn file(self, option: &'static str, path: &'a Option<PathBuf>) -> Places<'a> {
        self.with(option, path.as_deref(), Use::File)
    }

    /// A folder that files are written into.
    pub fn folder(self, option: &'static str, path: Option<&'a Path>) -> Places<'a> {
        self.with(option, path, Use::Folder)
    }

    fn with(mut self, option: &'static str, path: Option<&'a Path>, of: Use) -> Places<'a> {
        self.all.extend(path.map(|path| (option, path, of)));
        self
    }

    /// Refuses what cannot be written to, and what would be written twice, or is read too.
    pub fn check(&self) -> Result<(), Failure> {
        let written = self.all.iter().enumerate().filter(|(_, (.., of))| *of != Use::Input);
        for (n, &(option, path, of)) in written {
            let clash = || {
                let others = self.all.iter().enumerate().filter(|(m, (.., other))| match other {
                    Use::Input => of == Use::File,
                    _ => *m < n,
                });
                let same = others.map(|(_, other)| other).find(|other| is_same(path, other.1));
                same.map(|(other, ..)| format!("{other} names it too; name another one"))
            };
            if let Some(why) = unfit(path, of).or_else(|| in_a_pack(path)).or_else(clash) {
                let path = printable_path(path);
                return Err(Failure::Input(format!("{option} {path}: {why}")));
            }
        }
        Ok(())
    }
}

/// The reason why nothing can be written to a place, if there is one.
fn unfit(path: &Path, of: Use) -> Option<String> {
    if path.is_relative() && env::current_dir().is_err() {
        let why = "cannot be written: the working folder was deleted; change to one that is there";
        return Some(why.into());
    }
    match fs::metadata(path) {
        Ok(there) if there.is_dir() && of == Use::File => {
            Some("a folder; name a file in it".into())
        }
        Ok(there) if !there.is_dir() && of == Use::Folder => {
            let found = files::special(there.file_type()).unwrap_or("a file");
            Some(format!("{found}, where a folder is expected; name a folder"))
        }
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Some(format!("cannot be written: {error}; name another place"))
        }
        Err(_) if of == Use::File && path.as_os_str().as_encoded_bytes().ends_with(b"/") => {
            Some("the name of a folder; name a file".into())
        }
        // A set of files is made beside its folder, or in it.
        Ok(_) if of == Use::Folder => None,
        _ => {
            let place = if of == Use::File { files::replaced(path)? } else { path.to_owned() };
            let place = resolved(&place);
            let above = place.ancestors().skip(1).find(|folder| folder.exists())?;
            let error = access(above, Access::WRITE_OK | Access::EXEC_OK).err()?;
            let (above, error) = (printable_path(above), io::Error::from(error));
            Some(format!("nothing can be written into {above}: {error}; name another place"))
        }
    }
}

/// The reason why a place in a pack is none for files: a pack with others in it would be refused.
fn in_a_pack(path: &Path) -> Option<String> {
    let place = resolved(path);
    let pack = printable_path(place.ancestors().find(|folder| pack::is_pack(folder))?);
    Some(format!("{pack} is a vector pack, which has its own files alone; name a place outside it"))
}

/// True if both names are of the same place, and what is written there would be replaced.
fn is_same(one: &Path, other: &Path) -> bool {
    let place = |path: &Path| match path.is_dir() {
        true => Some(resolved(path)),
        false => files::replaced(path).as_deref().map(resolved),
    };
    place(one).is_some_and(|one| Some(one) == place(other))
}

/// A path without links, as far as it is there.
fn resolved(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let there = path.ancestors().find_map(|folder| {
        let rest = path.strip_prefix(folder).ok()?.components();
        Some(rest.fold(fs::canonicalize(folder).ok()?, |path, name| path.join(name)))
    });
    there.unwrap_or(path)
}
