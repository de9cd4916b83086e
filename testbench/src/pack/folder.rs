//! The files of a pack's folder, which anybody may have made.

use super::PackError;
use rustix::fs::{fstat, open, openat, FileType, Mode, OFlags};
use std::fs::File;
use std::io::{self, Read};
use std::os::fd::OwnedFd;
use std::path::{Path, PathBuf};

/// A folder that files are read from, by names in it.
pub(super) struct Folder {
    path: PathBuf,
    handle: OwnedFd,
}

impl Folder {
    /// Opens a folder.
    pub fn open(path: &Path) -> Result<Folder, PackError> {
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        let handle = open(path, flags, Mode::empty());
        let handle = handle.map_err(|error| PackError::at(path)(error.into()))?;
        Ok(Folder { path: path.to_owned(), handle })
    }

    /// The content of a regular file of at most `limit` bytes. It is opened once, through no link, and
    /// nothing is waited for.
    pub fn read(&self, name: &str, limit: u64) -> Result<Vec<u8>, PackError> {
        self.try_read(name, limit).map_err(PackError::at(self.path.join(name)))
    }

    fn try_read(&self, name: &str, limit: u64) -> io::Result<Vec<u8>> {
        let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let file =
            openat(&self.handle, name, flags, Mode::empty()).map_err(|error| match error {
                rustix::io::Errno::LOOP => {
                    io::Error::other("a symbolic link; a pack has files only")
                }
                error => error.into(),
            })?;
        let found = fstat(&file)?;
        if FileType::from_raw_mode(found.st_mode) != FileType::RegularFile {
            return Err(io::Error::other("not a regular file"));
        }
        let mut content = Vec::new();
        let size = u64::try_from(found.st_size).unwrap_or(u64::MAX);
        if size <= limit {
            content.reserve_exact(size as usize);
            // It may grow meanwhile.
            File::from(file).take(limit + 1).read_to_end(&mut content)?;
        }
        if size > limit || content.len() as u64 > limit {
            return Err(io::Error::other(format!("more than {limit} bytes, the most it may have")));
        }
        Ok(content)
    }

    /// A file or folder in it that is none of `names`.
    pub fn other_than(&self, names: &[&str]) -> Result<Option<String>, PackError> {
        let at = || PackError::at(&self.path);
        for entry in std::fs::read_dir(&self.path).map_err(at())? {
            let name = entry.map_err(at())?.file_name();
            if !names.iter().any(|known| *known == name) {
                return Ok(Some(name.to_string_lossy().into_owned()));
            }
        }
        Ok(None)
    }
}
