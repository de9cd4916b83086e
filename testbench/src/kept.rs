//! The contents of the caches, checked whenever they are used: evidence, or code that is run in this process.
//!
//! A digest over content and key stands beside the content. What was changed, cut short, or belongs to
//! another key is as if it were not there; that it was there is told.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;
use wheatstone_golden::files::{self, Scratch, WriteError};

/// The file of a folder that has the digest of the others.
const DIGEST: &str = "blake3";
/// Most bytes of a file that is kept.
pub(crate) const LIMIT: u64 = 1 << 30;

/// Result of a search in a cache.
pub(crate) enum Kept<T> {
    /// The content, as it was kept.
    Sound(T),
    /// Something else.
    Damaged,
    /// Nothing.
    Absent,
}

/// The files of a folder: name and content.
pub(crate) type Files = BTreeMap<String, Vec<u8>>;

/// Hashes two byte strings so that no other pair gives the same input.
pub(crate) fn entry(hash: &mut blake3::Hasher, name: &[u8], content: &[u8]) {
    for bytes in [name, content] {
        hash.update(&(bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    }
}

/// A hash as part of a file name.
pub(crate) fn short(hash: &blake3::Hasher) -> String {
    hash.finalize().to_hex()[..24].to_owned()
}

fn digest<'a>(key: &str, content: impl IntoIterator<Item = (&'a String, &'a Vec<u8>)>) -> String {
    let mut hash = blake3::Hasher::new();
    entry(&mut hash, b"key", key.as_bytes());
    content.into_iter().for_each(|(name, content)| entry(&mut hash, name.as_bytes(), content));
    hash.finalize().to_hex().to_string()
}

/// Puts the digest of a finished folder into it.
pub(crate) fn seal(folder: &Path, key: &str) -> io::Result<()> {
    let digest = digest(key, &all(folder)?);
    fs::write(folder.join(DIGEST), format!("{digest}\n"))
}

/// The files of a folder that was sealed with this key.
pub(crate) fn folder(folder: &Path, key: &str) -> Kept<Files> {
    if !folder.is_dir() {
        return Kept::Absent;
    }
    let Ok(mut files) = all(folder) else { return Kept::Damaged };
    let said = files.remove(DIGEST).unwrap_or_default();
    match said.trim_ascii_end() == digest(key, &files).as_bytes() {
        true => Kept::Sound(files),
        false => Kept::Damaged,
    }
}

fn all(folder: &Path) -> io::Result<Files> {
    let read = |entry: io::Result<fs::DirEntry>| {
        let entry = entry?;
        let content = files::read(&entry.path(), LIMIT).map_err(|error| error.source)?;
        Ok((entry.file_name().to_string_lossy().into_owned(), content))
    };
    fs::read_dir(folder)?.map(read).collect()
}

/// Keeps a text in a file, with its digest in the first line.
pub(crate) fn write_text(file: &Path, key: &str, text: String) -> Result<(), WriteError> {
    let text = text.into_bytes();
    let digest = digest(key, [(&String::new(), &text)]);
    files::write(file, &[digest.as_bytes(), b"\n", &text].concat())
}

/// The text that was kept in a file under this key.
pub(crate) fn text(file: &Path, key: &str) -> Kept<String> {
    if !file.exists() {
        return Kept::Absent;
    }
    let sound = || {
        let content = String::from_utf8(files::read(file, LIMIT).ok()?).ok()?;
        let (said, text) = content.split_once('\n')?;
        let text = text.to_owned().into_bytes();
        let is_sound = said == digest(key, [(&String::new(), &text)]);
        is_sound.then(|| String::from_utf8(text).ok())?
    };
    sound().map_or(Kept::Damaged, Kept::Sound)
}

/// True if these bytes are an object file to its end: the table of sections is near it. One that is cut
/// short is a deadly signal when it is loaded.
pub(crate) fn is_whole_object(content: &[u8]) -> bool {
    let number = |at: usize, bytes: usize| {
        let bytes = content.get(at..at + bytes)?;
        Some(bytes.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte)))
    };
    let end = || number(0x28, 8)?.checked_add(number(0x3a, 2)? * number(0x3c, 2)?);
    let is_64_little = content.get(4..6) == Some(&[2, 1]);
    let is_to_its_end = end().is_some_and(|end| end <= content.len() as u64);
    content.len() >= 64 && content.starts_with(b"\x7fELF") && (!is_64_little || is_to_its_end)
}

/// Name of the copy of an object that is loaded.
pub(crate) const COPY: &str = "model.so";

/// A folder with a copy of an object beside its own folder. The loader maps it, and what is no longer there would
/// be a deadly signal: of a copy without a name nobody can cut anything off. No copy has the name of another
/// one, as the loader takes two of one name for the same.
pub(crate) fn copy(object: &Path, content: &[u8]) -> io::Result<Scratch> {
    let cache = object.parent().and_then(Path::parent).unwrap_or(Path::new("."));
    let scratch = Scratch::new(cache).or_else(|_| Scratch::new(&std::env::temp_dir()))?;
    fs::write(scratch.path().join(COPY), content)?;
    Ok(scratch)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_what_was_sealed_or_damaged() {
        let parent = tempfile::tempdir().unwrap();
        let place = parent.path().join("x");
        assert!(matches!(folder(&place, "k"), Kept::Absent));
        fs::create_dir(&place).unwrap();
        assert!(matches!(folder(&place, "k"), Kept::Damaged), "it has no digest");
        let make = |content: &str| fs::write(place.join("model.so"), content).unwrap();
        make("content");
        seal(&place, "k").unwrap();
        let Kept::Sound(files) = folder(&place, "k") else { panic!("sound") };
        assert_eq!(files, Files::from([("model.so".into(), b"content".to_vec())]));
        assert!(matches!(folder(&place, "other"), Kept::Damaged));
        for content in ["", "conten", "Content"] {
            make(content);
            assert!(matches!(folder(&place, "k"), Kept::Damaged), "{content:?}");
        }
        make("content");
        assert!(matches!(folder(&place, "k"), Kept::Sound(_)));
        fs::write(place.join("more"), "").unwrap();
        assert!(matches!(folder(&place, "k"), Kept::Damaged));
    }

    #[test]
    fn a_text_is_what_was_kept_or_damaged() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        assert!(matches!(text(&file, "k"), Kept::Absent));
        write_text(&file, "k", "{\"cells\": 120}\n".into()).unwrap();
        assert!(matches!(text(&file, "k"), Kept::Sound(t) if t == "{\"cells\": 120}\n"));
        assert!(matches!(text(&file, "other"), Kept::Damaged));
        let sound = fs::read(&file).unwrap();
        for n in 0..sound.len() {
            let mut changed = sound.clone();
            changed[n] ^= 1;
            fs::write(&file, &changed).unwrap();
            assert!(matches!(text(&file, "k"), Kept::Damaged), "byte {n}");
            fs::write(&file, &sound[..n]).unwrap();
            assert!(matches!(text(&file, "k"), Kept::Damaged), "cut at {n}");
        }
    }

    #[test]
    fn an_object_that_is_cut_short_is_seen() {
        let own = fs::read(std::env::current_exe().unwrap()).unwrap();
        assert!(is_whole_object(&own));
        for length in [0, 3, 4, 16, 63, 4096, own.len() / 2] {
            assert!(!is_whole_object(&own[..length]), "{length}");
        }
        assert!(!is_whole_object(b"#!/bin/sh"));
    }
}
