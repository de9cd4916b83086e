//! The log that strace writes of the calls of a program.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A place to be killed at: a call, and its number among the calls of that name in a thread, from 1.
pub type Point = (String, u32);

/// Thread, name and arguments of a call that begins on a line.
fn call(line: &str) -> Option<(&str, &str, &str)> {
    let (thread, rest) = line.trim().split_once(char::is_whitespace)?;
    let (call, arguments) = rest.trim_start().split_once('(')?;
    let is_name = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    (!call.is_empty() && call.bytes().all(is_name)).then_some((thread, call, arguments))
}

/// The places in a log: how often each thread makes a call. Files that are opened for reading do not count as such,
/// but strace counts them.
pub fn places(log: &str) -> Vec<Point> {
    let mut counts: BTreeMap<(&str, &str), u32> = BTreeMap::new();
    let mut places = BTreeSet::new();
    for (thread, call, arguments) in log.lines().filter_map(call) {
        let count = counts.entry((thread, call)).or_default();
        *count += 1;
        if call != "openat"
            || ["O_CREAT", "O_WRONLY", "O_RDWR"].iter().any(|w| arguments.contains(w))
        {
            places.insert((call.to_owned(), *count));
        }
    }
    places.into_iter().collect()
}

/// The files that got their names before they were on the disk, in a log with the files behind descriptors (`-y`);
/// `folder` is the one that the program worked in, without links.
pub fn early(log: &str, folder: &Path) -> Vec<String> {
    let mut written: BTreeSet<PathBuf> = BTreeSet::new();
    let mut early = Vec::new();
    for (_, call, arguments) in log.lines().filter_map(call) {
        // Of a file that is copied to another one, the latter.
        let is_copy = call == "copy_file_range";
        let mut files = opened(arguments);
        let file = if is_copy { files.nth(1) } else { files.next() };
        match (call, file) {
            ("fsync" | "fdatasync", Some(file)) => drop(written.remove(&file)),
            (
                "write" | "pwrite64" | "writev" | "ftruncate" | "copy_file_range" | "sendfile",
                file,
            ) => {
                written.extend(file);
            }
            ("unlink" | "unlinkat", within) => {
                let name = arguments.split('"').nth(1).unwrap_or_default();
                written.remove(&within.unwrap_or_else(|| folder.into()).join(name));
            }
            ("rename" | "renameat" | "renameat2", _) => {
                let mut names = arguments.split('"').skip(1).step_by(2);
                let (Some(old), Some(new)) = (names.next(), names.next()) else { continue };
                let old = folder.join(old);
                let unsafe_ones = written.iter().filter(|file| file.starts_with(&old));
                early.extend(unsafe_ones.map(|file| {
                    let file = file.strip_prefix(&old).unwrap_or(file);
                    let file = Path::new(new).join(file);
                    let file = file.display().to_string();
                    format!("{} got its name before it was on the disk", file.trim_end_matches('/'))
                }));
            }
            _ => {}
        }
    }
    early
}

/// The files behind the descriptors among arguments: `3</tmp/file>`.
fn opened(arguments: &str) -> impl Iterator<Item = PathBuf> + '_ {
    let parts = arguments.split(", ");
    parts.filter_map(|part| {
        let (descriptor, file) = part.split_once('<')?;
        let (file, _) = file.split_once('>')?;
        let is_number = !descriptor.is_empty() && descriptor.bytes().all(|b| b.is_ascii_digit());
        (is_number && file.starts_with('/')).then(|| file.into())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read_from_a_log() {
        let log = "12  openat(AT_FDCWD, \"/lib\", O_RDONLY|O_CLOEXEC) = 3\n\
             12  openat(AT_FDCWD, \"f\", O_WRONLY|O_CREAT, 0666) = 3\n12  write(3, \"a\", 1) = 1\n\
             13  write(3, \"openat(\", 7) = 7\n13  write(3, <unfinished ...>\n12  --- SIGCHLD {si_signo=1} ---\n\
             13  <... write resumed>) = 1\n12  fsync(3) = 0\n12  +++ exited with 0 +++\n";
        let place = |call: &str, number| (call.to_owned(), number);
        let expected =
            [place("fsync", 1), place("openat", 2), place("write", 1), place("write", 2)];
        assert_eq!(places(log), expected);
    }

    #[test]
    fn files_that_are_named_before_they_are_on_the_disk_are_found() {
        let log = "12  openat(AT_FDCWD</w>, \"p/.a\", O_RDWR|O_CREAT|O_EXCL, 0666) = 3</w/p/.a>\n\
             12  write(3</w/p/.a>, \"x, 5</w/y>\", 9) = 9\n\
             12  fsync(3</w/p/.a>) = 0\n\
             12  rename(\"p/.a\", \"p/a\") = 0\n\
             12  write(1<pipe:[1234]>, \"a\", 1) = 1\n\
             13  writev(4</w/.f/b>, [{iov_base=\"1\", iov_len=1}], 1) = 1\n\
             13  copy_file_range(4</w/.f/b>, NULL, 5</w/.f/c>, NULL, 7, 0) = 7\n\
             13  write(5</w/.f/d>, \"x\", 1) = 1\n\
             13  write(5</w/.f/e>, \"x\", 1) = 1\n\
             13  unlinkat(6</w/.f>, \"d\", 0) = 0\n\
             13  unlink(\"/w/.f/e\") = 0\n\
             13  fsync(4</w/.f/b> <unfinished ...>\n\
             12  renameat2(AT_FDCWD</w>, \"/w/.f\", AT_FDCWD</w>, \"/w/f\", RENAME_NOREPLACE) = 0\n";
        let folder = Path::new("/w");
        assert_eq!(early(log, folder), ["/w/f/c got its name before it was on the disk"]);
        let without = log.replace("12  fsync(3</w/p/.a>) = 0\n", "");
        let expected = "p/a got its name before it was on the disk";
        assert_eq!(early(&without, folder)[0], expected);
    }
}
