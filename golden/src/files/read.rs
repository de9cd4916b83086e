//! Reading what a stranger may have made.

use crate::text::printable_path;
use rustix::io::Errno;
use std::fs::{self, Metadata, OpenOptions};
use std::io::{self, Read};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

/// A file was not read.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be read: {source}", printable_path(.file))]
pub struct ReadError {
    /// The file.
    pub file: PathBuf,
    /// The cause.
    pub source: io::Error,
}

/// Most bytes of a file of the project's own: of a record, a page, a library of cells.
pub const OWN_LIMIT: u64 = 64 << 20;

/// The text of one of the project's own files, of at most [`OWN_LIMIT`] bytes.
///
/// # Errors
/// The errors of [`read`], and one for bytes that are not UTF-8.
pub fn read_own(file: &Path) -> io::Result<String> {
    String::from_utf8(bounded(file, OWN_LIMIT)?).map_err(io::Error::other)
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// Of a pipe, a device, a socket or a folder, without waiting for any of them; of a larger file; and of one
/// that cannot be read.
pub fn read(file: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    bounded(file, limit).map_err(|source| ReadError { file: file.to_owned(), source })
}

fn bounded(file: &Path, limit: u64) -> io::Result<Vec<u8>> {
    // Before it is opened too: opening alone can make a device do something.
    regular(kind(&fs::metadata(file)?))?;
    let flags = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY;
    let opened = OpenOptions::new().read(true).custom_flags(flags.bits() as i32).open(file)?;
    let metadata = opened.metadata()?;
    regular(kind(&metadata))?;
    let mut content = Vec::new();
    if metadata.len() <= limit {
        opened.take(limit.saturating_add(1)).read_to_end(&mut content)?;
    }
    if metadata.len().max(content.len() as u64) > limit {
        let message = format!("larger than {}, the most that is read of such a file", Size(limit));
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(content)
}

/// The kind of thing that a path leads to, if it leads to something that is no regular file: `a folder`,
/// `a pipe (FIFO)`, `a socket`, `a device`, or `a symbolic link that leads to itself`.
pub fn irregular(path: &Path) -> Option<&'static str> {
    let is_loop = |error: io::Error| error.raw_os_error() == Some(Errno::LOOP.raw_os_error());
    match fs::metadata(path) {
        Ok(there) => kind(&there),
        Err(error) => is_loop(error).then_some("a symbolic link that leads to itself"),
    }
}

fn kind(there: &Metadata) -> Option<&'static str> {
    if there.is_dir() {
        Some("a folder")
    } else {
        super::special(there.file_type())
    }
}

fn regular(kind: Option<&str>) -> io::Result<()> {
    kind.map_or(Ok(()), |kind| {
        Err(io::Error::other(format!("expected a regular file, found {kind}")))
    })
}

/// A number of bytes in the largest unit that divides it.
struct Size(u64);

impl std::fmt::Display for Size {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let units = [(30, "GiB"), (20, "MiB"), (10, "KiB")];
        let whole = |&&(shift, _): &&(u32, &str)| self.0 != 0 && self.0.trailing_zeros() >= shift;
        match units.iter().find(whole) {
            Some((shift, unit)) => write!(f, "{} {unit}", self.0 >> shift),
            None => write!(f, "{} bytes", self.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(file: &Path, limit: u64) -> String {
        read(file, limit).unwrap_err().to_string()
    }

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "12345").unwrap();
        assert_eq!(read(&file, 5).unwrap(), b"12345");
        assert_eq!(
            refused(&file, 4),
            format!(
                "{}: cannot be read: larger than 4 bytes, the most that is read of such a file",
                file.display()
            )
        );
        // A file with a hole is as large as it says.
        fs::File::create(&file).unwrap().set_len(1 << 40).unwrap();
        assert!(refused(&file, 64 << 20).contains("larger than 64 MiB"), "{}", refused(&file, 9));
        // One that does not say how large it is.
        assert!(!read(Path::new("/proc/self/status"), 1 << 20).unwrap().is_empty());
        assert!(refused(Path::new("/proc/self/status"), 16).contains("larger than 16 bytes"));
        assert!(refused(&folder.path().join("none"), 9).contains("No such file"));
    }

    #[test]
    fn what_is_no_file_is_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let (pipe, socket) = (folder.path().join("pipe"), folder.path().join("socket"));
        let status = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(status.success());
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        let link = folder.path().join("link");
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        for (file, kind) in [
            (pipe.as_path(), "a pipe (FIFO)"),
            (&link, "a pipe (FIFO)"),
            (&socket, "a socket"),
            (folder.path(), "a folder"),
            (Path::new("/dev/zero"), "a device"),
        ] {
            let text = refused(file, 1 << 20);
            assert!(text.ends_with(&format!("expected a regular file, found {kind}")), "{text}");
            assert_eq!(irregular(file), Some(kind));
        }
        let itself = folder.path().join("itself");
        std::os::unix::fs::symlink("itself", &itself).unwrap();
        assert_eq!(irregular(&itself), Some("a symbolic link that leads to itself"));
        assert_eq!(irregular(&folder.path().join("none")), None);
    }
}
