//! Tells a tool that failed for want of room on the disk from one that failed at its input.

use rustix::io::Errno;
use std::fs;
use std::io::{Error, ErrorKind};
use std::path::Path;

/// Bytes that must have room where a tool works; some of them crash without saying why.
const LEAST: usize = 1 << 16;

/// The error that a file system has no room, if that is why a tool failed that worked in `folder` and `said` this.
pub(crate) fn lacking(folder: &Path, said: &str) -> Option<Error> {
    let known = [("No space left on device", Errno::NOSPC), ("Disk quota exceeded", Errno::DQUOT)];
    let told = known.into_iter().find(|(text, _)| said.contains(text));
    told.map(|(_, error)| error.into()).or_else(|| {
        let file = folder.join(".room");
        let error = fs::write(&file, [1; LEAST]).err();
        let _ = fs::remove_file(file);
        error.filter(|error| is_full(error) || Errno::from_io_error(error) == Some(Errno::FBIG))
    })
}

/// True if an error says that there is no room.
pub(crate) fn is_full(error: &Error) -> bool {
    matches!(error.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tool_that_had_no_room_is_told_from_others() {
        let folder = tempfile::tempdir().unwrap();
        assert!(lacking(folder.path(), "ERROR: syntax error").is_none());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        let said = "as: cannot write /tmp/cc.o: No space left on device";
        assert!(lacking(folder.path(), said).is_some_and(|error| is_full(&error)));
        assert!(lacking(Path::new("/none"), "").is_none(), "that has another reason");
        assert!(is_full(&fs::write("/dev/full", "x").unwrap_err()));
    }
}
