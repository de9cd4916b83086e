//! Writing a file that is whole or not there.

use super::scratch::{self, Tidy};
use super::waiting::Waiting;
use super::WriteError;
use crate::text::printable_path;
use rustix::event::{poll, PollFd, PollFlags, Timespec};
use rustix::fs::OFlags;
use std::fs::{self, Metadata, OpenOptions};
use std::io::{self, Write};
use std::os::fd::AsFd;
use std::os::unix::fs::{FileTypeExt, MetadataExt, OpenOptionsExt};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Links to links that are followed, as many as Linux does.
const LINKS: usize = 40;

/// Writes a file: under a temporary name beside it, to the disk, then renamed. Folders that are missing are
/// made, so that nobody loses what took long for want of one. Of a symbolic link, the file that it leads to is
/// replaced; a new file has the permissions that the umask leaves.
///
/// If anything fails, or the program is killed, a file of that name is as it was before, or not
/// there. Only a kill can leave the temporary file, `.wheatstone-XXXXXX.part`; the next write in its folder
/// removes it.
///
/// A device, pipe or socket, and the file that is standard output or error, is written to, not replaced.
///
/// # Errors
/// If the file cannot be written; for a pipe that nobody reads, or one that takes nothing for too long, see
/// [`on_wait`](super::on_wait).
pub fn write(file: &Path, content: &[u8]) -> Result<(), WriteError> {
    put(file, content).map_err(|source| WriteError { file: file.to_owned(), source })
}

fn put(file: &Path, content: &[u8]) -> io::Result<()> {
    match target(file)? {
        Target::Output => pour(&mut io::stdout().lock(), content),
        Target::Error => pour(&mut io::stderr().lock(), content),
        Target::Special(there) => feed(file, &there, content),
        Target::File(file) => replace(&file, content),
    }
}

/// The file that [`write`] makes or replaces; none where it writes to what is there, or can write nothing.
pub fn replaced(file: &Path) -> Option<PathBuf> {
    match target(file) {
        Ok(Target::File(file)) => Some(file),
        _ => None,
    }
}

/// The destination that a name leads to.
enum Target {
    /// Standard output.
    Output,
    /// Standard error.
    Error,
    /// A device, pipe or socket.
    Special(Metadata),
    /// A file that is there or not.
    File(PathBuf),
}

fn target(file: &Path) -> io::Result<Target> {
    Ok(match fs::metadata(file) {
        Ok(there) if there.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Ok(there) if is(&there, io::stdout()) => Target::Output,
        Ok(there) if is(&there, io::stderr()) => Target::Error,
        Ok(there) if !there.is_file() => Target::Special(there),
        Ok(_) if fs::symlink_metadata(file)?.is_symlink() => Target::File(fs::canonicalize(file)?),
        Ok(_) => Target::File(file.to_owned()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Target::File(led_to(file)?),
        Err(error) => return Err(error),
    })
}

/// True if a file is the one that an open stream writes to.
fn is(file: &Metadata, stream: impl AsFd) -> bool {
    rustix::fs::fstat(stream).is_ok_and(|s| (s.st_dev, s.st_ino) == (file.dev(), file.ino()))
}

/// The path that a dangling link leads to.
fn led_to(file: &Path) -> io::Result<PathBuf> {
    let mut file = file.to_owned();
    for _ in 0..LINKS {
        match fs::read_link(&file) {
            Ok(next) => file = super::parent(&file).join(next),
            Err(_) => return Ok(file),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

fn replace(file: &Path, content: &[u8]) -> io::Result<()> {
    if file.file_name().is_none() {
        return Err(io::Error::other("not the name of a file"));
    }
    let folder = super::parent(file);
    let _tidy = Tidy::new(folder);
    fs::create_dir_all(folder)?;
    let (_mark, mut temporary) = scratch::file(folder)?;
    // Past the wrapper, whose errors name the temporary path.
    temporary.as_file_mut().write_all(content)?;
    super::sync(temporary.as_file())?;
    temporary.persist(file).map_err(|error| error.error)?;
    super::sync_folder(folder)
}

/// Writes to what is no regular file, without waiting for ever.
fn feed(file: &Path, there: &Metadata, content: &[u8]) -> io::Result<()> {
    if there.file_type().is_socket() {
        let socket = UnixStream::connect(file)?;
        socket.set_nonblocking(true)?;
        return push(socket, file, content);
    }
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    let opened = OpenOptions::new().write(true).custom_flags(flags.bits() as i32).open(file);
    let opened = opened.map_err(|error| match error.raw_os_error() {
        Some(code) if code == rustix::io::Errno::NXIO.raw_os_error() => {
            io::Error::other("no program reads from it")
        }
        _ => error,
    })?;
    push(opened, file, content)
}

/// Writes all to what does not block.
fn push(mut stream: impl Write + AsFd, file: &Path, mut rest: &[u8]) -> io::Result<()> {
    let whom = || format!("the reader of {}, which reads nothing", printable_path(file));
    while !rest.is_empty() {
        match stream.write(rest) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(written) => rest = &rest[written..],
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                Waiting::usual().wait(|time| takes_more(&stream, time), whom)?;
            }
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// Waits until a pipe, device or socket takes more; says whether it did in this time.
fn takes_more(stream: &impl AsFd, limit: Duration) -> io::Result<bool> {
    let seconds = limit.as_secs().try_into().unwrap_or(i64::MAX);
    let time = Timespec { tv_sec: seconds, tv_nsec: limit.subsec_nanos().into() };
    match poll(&mut [PollFd::new(stream, PollFlags::OUT)], Some(&time)) {
        Ok(number) => Ok(number > 0),
        // The write that follows finds out.
        Err(rustix::io::Errno::INTR) => Ok(true),
        Err(error) => Err(error.into()),
    }
}

fn pour(stream: &mut impl Write, content: &[u8]) -> io::Result<()> {
    stream.write_all(content)?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::{symlink, PermissionsExt};

    fn names(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name());
        let mut names: Vec<String> = names.map(|n| n.into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_link_stays_and_its_file_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("sub")).unwrap();
        symlink("sub/b", at("a")).unwrap();
        symlink("c", at("sub/b")).unwrap();
        for content in ["new", "newer"] {
            write(&at("a"), content.as_bytes()).unwrap();
            assert_eq!(fs::read_to_string(at("sub/c")).unwrap(), content);
        }
        assert!(at("a").is_symlink() && at("sub/b").is_symlink() && !at("sub/c").is_symlink());
        symlink("y", at("x")).unwrap();
        symlink("x", at("y")).unwrap();
        assert!(write(&at("x"), b"").is_err());
        assert!(write(&at("sub"), b"").unwrap_err().to_string().contains("directory"));
        assert_eq!(names(folder.path()), ["a", "sub", "x", "y"]);
        // Any name that the file system takes.
        let long = at(&"n".repeat(255));
        write(&long, b"content").unwrap();
        let mode = fs::metadata(&long).unwrap().permissions().mode();
        fs::write(at("plain"), "").unwrap();
        assert_eq!(mode, fs::metadata(at("plain")).unwrap().permissions().mode());
    }

    #[test]
    fn devices_and_pipes_are_written_to() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let error = write(&pipe, b"content").unwrap_err().to_string();
        assert!(error.ends_with("cannot be written: no program reads from it"), "{error}");
        // More than a pipe holds.
        let content = vec![7; 300_000];
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).unwrap()
        });
        // The reader may not have opened it yet.
        while write(&pipe, &content).is_err() {
            std::thread::yield_now();
        }
        assert_eq!(reader.join().unwrap(), content);
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());

        let link = folder.path().join("link");
        symlink("/dev/null", &link).unwrap();
        write(&link, b"content").unwrap();
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
        let error = write(Path::new("/dev/full"), b"content").unwrap_err().to_string();
        assert!(error.contains("No space left"), "{error}");

        let socket = folder.path().join("socket");
        let listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        write(&socket, b"content").unwrap();
        let mut said = String::new();
        io::Read::read_to_string(&mut listener.accept().unwrap().0, &mut said).unwrap();
        assert_eq!(said, "content");
    }

    #[test]
    fn a_file_is_on_the_disk_before_it_has_its_name() {
        let folder = tempfile::tempdir().unwrap();
        for content in ["old", "new"] {
            write(&folder.path().join("a/file"), content.as_bytes()).unwrap();
            assert_eq!(super::super::synced::take(folder.path()), ["a/*", "a"]);
        }
    }

    #[test]
    fn what_a_killed_writer_left_is_swept() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(".wheatstone-abc.part"), "half").unwrap();
        let (_mark, alive) = scratch::file(folder.path()).unwrap();
        write(&folder.path().join("a/b/file"), b"content").unwrap();
        write(&folder.path().join("file"), b"content").unwrap();
        let alive = alive.path().file_name().unwrap().to_str().unwrap();
        assert_eq!(names(folder.path()), [alive, "a", "file"]);
    }

    #[test]
    fn a_failure_leaves_no_new_folder() {
        let folder = tempfile::tempdir().unwrap();
        assert!(write(&folder.path().join("a/b").join("n".repeat(256)), b"").is_err());
        assert_eq!(names(folder.path()), [""; 0]);
    }
}
