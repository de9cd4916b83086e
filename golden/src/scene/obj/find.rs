//! Files that other files name, as they are written on other machines.
//!
//! A name is relative to the folder of the file that it stands in. Quotes are dropped, backslashes
//! separate as slashes do, or keep a blank. What is not there under its whole path, such as `C:\me\tex\a.png`, is
//! looked for under the path's last parts in that folder, the longest first, then in any case of
//! letters. Folders do not count; a pipe or a device does, and is refused by who reads it.

use super::statement::without_comment;
use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};

/// Most parts of a path, from its end, that are looked for in a folder.
const PARTS: usize = 8;

/// Finds files; it remembers the folders that it has seen.
#[derive(Debug, Default)]
pub struct Finder {
    /// Names in a folder by their small letters.
    folders: HashMap<PathBuf, HashMap<String, OsString>>,
}

impl Finder {
    /// The file of this name, if there is one; the name may be followed by a comment.
    pub fn find(&mut self, folder: &Path, name: &str) -> Option<PathBuf> {
        let bare = unquoted(name);
        let shorter = unquoted(without_comment(name));
        // Some write a blank as others do on a command line.
        let unescaped = bare.replace("\\ ", " ");
        let more = [shorter, &unescaped].into_iter().filter(|name| *name != bare);
        let mut names = std::iter::once(bare).chain(more);
        names.find_map(|name| self.named(folder, name))
    }

    fn named(&mut self, folder: &Path, name: &str) -> Option<PathBuf> {
        let whole = folder.join(name);
        if name.is_empty() || is_there(&whole) {
            return Some(whole).filter(|_| !name.is_empty());
        }
        let name = name.replace('\\', "/");
        let whole = folder.join(&name);
        if is_there(&whole) {
            return Some(whole);
        }
        // `C:` and what it leads to.
        let bare = match name.as_bytes() {
            [letter, b':', ..] if letter.is_ascii_alphabetic() => &name[2..],
            _ => &name,
        };
        let normal = |part: Component| match part {
            Component::Normal(part) => Some(part.to_string_lossy().into_owned()),
            _ => None,
        };
        let parts: Vec<String> = Path::new(bare).components().filter_map(normal).collect();
        let first = parts.len().saturating_sub(PARTS);
        (first..parts.len()).find_map(|n| self.in_any_case(folder, &parts[n..]))
    }

    /// The file that a path of these parts leads to from a folder.
    fn in_any_case(&mut self, folder: &Path, parts: &[String]) -> Option<PathBuf> {
        let exact = parts.iter().fold(folder.to_owned(), |path, part| path.join(part));
        if is_there(&exact) {
            return Some(exact);
        }
        let mut path = folder.to_owned();
        for part in parts {
            let names = self.folders.entry(path.clone()).or_insert_with_key(|path| listed(path));
            path.push(names.get(&part.to_lowercase())?);
        }
        is_there(&path).then_some(path)
    }
}

/// True if a path leads to anything but a folder; its reader refuses what is no file.
fn is_there(path: &Path) -> bool {
    path.metadata().is_ok_and(|there| !there.is_dir())
}

/// Names in a folder by their small letters; none if it cannot be read.
fn listed(folder: &Path) -> HashMap<String, OsString> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<OsString> = entries.map(|entry| entry.file_name()).collect();
    // Of several names that differ in case alone, the first, whatever the order of the folder.
    names.sort_by(|a, b| b.cmp(a));
    names.into_iter().map(|name| (name.to_string_lossy().to_lowercase(), name)).collect()
}

/// A name without the quotes round it.
pub fn unquoted(name: &str) -> &str {
    let name = name.trim();
    let within = |quote| name.strip_prefix(quote)?.strip_suffix(quote);
    within('"').or_else(|| within('\'')).unwrap_or(name).trim()
}

/// Names of libraries in a statement that may name several, with blanks in them: each ends in
/// `.mtl`. Where none does, each word is one.
pub fn library_names(text: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut words: Vec<&str> = Vec::new();
    for word in text.split_whitespace() {
        words.push(word);
        let bare = word.trim_end_matches(['"', '\'']).as_bytes();
        let end = &bare[bare.len().saturating_sub(".mtl".len())..];
        if end.eq_ignore_ascii_case(b".mtl") {
            names.push(words.join(" "));
            words.clear();
        }
    }
    let rest = words.join(" ");
    names.extend(without_comment(&rest).split_whitespace().map(str::to_string));
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn names_from_other_machines_are_found_in_the_own_folder() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let folder = folder.path();
        fs::create_dir_all(folder.join("Tex/deep")).expect("a folder");
        for name in ["a b.png", "t#1.png", "Tex/Wood.JPG", "Tex/deep/x.png"] {
            fs::write(folder.join(name), "").expect("written");
        }
        let pipe = std::process::Command::new("mkfifo").arg(folder.join("pipe.mtl")).status();
        assert!(pipe.is_ok_and(|status| status.success()));
        let mut finder = Finder::default();
        let mut found = |name: &str| {
            let path = finder.find(folder, name)?;
            Some(path.strip_prefix(folder).expect("within").display().to_string())
        };
        let outside = folder.join("a b.png").display().to_string();
        let cases = [
            ("a b.png", "a b.png"),
            (" \"a b.png\" ", "a b.png"),
            ("'a b.png'", "a b.png"),
            ("a b.png # the wood", "a b.png"),
            ("a\\ b.png", "a b.png"),
            ("t#1.png", "t#1.png"),
            ("A B.PNG", "a b.png"),
            ("tex\\wood.jpg", "Tex/Wood.JPG"),
            ("C:\\Users\\me\\tex\\wood.jpg", "Tex/Wood.JPG"),
            ("D:Tex/Wood.JPG", "Tex/Wood.JPG"),
            ("/home/me/Tex/deep/x.png", "Tex/deep/x.png"),
            ("..\\textures\\a b.png", "a b.png"),
            ("./Tex/../a b.png", "Tex/../a b.png"),
            // Its reader says what it is.
            ("Pipe.mtl", "pipe.mtl"),
            (&outside, "a b.png"),
        ];
        for (name, expected) in cases {
            assert_eq!(found(name).as_deref(), Some(expected), "{name}");
        }
        for name in ["", "  ", "Tex", "wood.jpg", "\"", "c.png", "a\0b", &"a/".repeat(9000)] {
            assert_eq!(found(name), None, "{name}");
        }
    }

    #[test]
    fn several_libraries_are_told_from_names_with_blanks() {
        assert_eq!(library_names("a.mtl"), ["a.mtl"]);
        assert_eq!(library_names("a.mtl  b c.MTL d.mtl.mtl"), ["a.mtl", "b c.MTL", "d.mtl.mtl"]);
        assert_eq!(library_names("\"my a.mtl\" 'b.mtl'"), ["\"my a.mtl\"", "'b.mtl'"]);
        assert_eq!(library_names("one two"), ["one", "two"]);
        assert_eq!(library_names("a.mtl # of the wood"), ["a.mtl"]);
        assert!(library_names("").is_empty());
    }
}
