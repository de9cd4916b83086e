//! Faults of a run.

use crate::Kind;
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use wheatstone_process::Output;

/// Processor time that an input may take, in seconds.
pub const SECONDS: u32 = 20;
/// Memory that the program may have, in kB: the address space.
pub const KILOBYTES: u32 = 2 << 20;

/// The files below a folder.
pub fn files(folder: &Path) -> io::Result<BTreeSet<PathBuf>> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        match entry.file_type()?.is_dir() {
            true => found.extend(files(&entry.path())?),
            false => drop(found.insert(entry.path())),
        }
    }
    Ok(found)
}

/// The fault of a run in a folder in which there were these files before, if there is one.
pub fn fault(
    kind: &Kind,
    output: &Output,
    folder: &Path,
    before: &BTreeSet<PathBuf>,
) -> io::Result<Option<String>> {
    let text = String::from_utf8_lossy(&[&output.stdout[..], &output.stderr].concat()).into_owned();
    if let Some(signal) = output.status.signal() {
        // The limit of the system: first a warning, then the end.
        let limit = format!("more than {SECONDS} s of processor time");
        let what = if [9, 24].contains(&signal) { limit } else { format!("signal {signal}") };
        return Ok(Some(what));
    }
    let code = output.status.code().unwrap_or(-1);
    if text.contains("panicked at") || code == 101 {
        return Ok(Some("it panicked".into()));
    }
    if !(0..=3).contains(&code) {
        return Ok(Some(format!("exit status {code}")));
    }
    let is_odd = |c: &char| c.is_control() && !matches!(c, '\n' | '\t') || is_hidden(*c);
    if let Some(odd) = text.chars().find(is_odd) {
        return Ok(Some(format!("it printed {odd:?}")));
    }
    let new: Vec<PathBuf> = files(folder)?.difference(before).cloned().collect();
    if let (Some(file), true) = (new.first(), code > 1) {
        return Ok(Some(format!("it failed and left {}", file.display())));
    }
    let is_part = |file: &&PathBuf| {
        file.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."))
    };
    if let Some(part) = new.iter().find(is_part) {
        return Ok(Some(format!("it left {}", part.display())));
    }
    let is_picture = |file: &&PathBuf| file.extension().is_some_and(|end| end == "png");
    if let Some(broken) = new.iter().filter(is_picture).find(|file| image::open(file).is_err()) {
        return Ok(Some(format!("{} is not whole", broken.display())));
    }
    Ok((code > 1 && !names_a_file(kind, &text)).then(|| "its message names no file".into()))
}

/// Characters that change the order of what is shown around them.
fn is_hidden(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// True if a text names a file of the input, or one that these name beside them. Errors of options name the option.
fn names_a_file(kind: &Kind, text: &str) -> bool {
    let named = |(name, _): &(String, Vec<u8>)| match name.rsplit_once('/') {
        Some((folder, _)) => text.contains(&format!("{folder}/")),
        None => text.contains(&name[..]),
    };
    kind.damaged.is_none() || kind.files.iter().any(named)
}
