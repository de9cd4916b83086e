//! Commands as they are printed for a shell.

use std::borrow::Cow;
use std::ffi::{OsStr, OsString};
use std::fmt::Write;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use wheatstone_golden::text::is_hidden;

/// Words as a command for a shell, on one line of a terminal whatever is in them.
pub(crate) fn command_line<W: AsRef<OsStr>>(words: impl IntoIterator<Item = W>) -> String {
    words.into_iter().map(|word| quoted(word.as_ref())).collect::<Vec<_>>().join(" ")
}

/// A path as a word of a command that is no option.
pub(crate) fn operand(path: &Path) -> Cow<'_, OsStr> {
    let path = path.as_os_str();
    if !path.as_bytes().starts_with(b"-") {
        return path.into();
    }
    let mut longer = OsString::from("./");
    longer.push(path);
    longer.into()
}

/// A word as a POSIX shell reads it.
fn quoted(word: &OsStr) -> String {
    let is_plain = |b: &u8| b.is_ascii_alphanumeric() || b"_@%+=:,./-".contains(b);
    if !word.is_empty() && word.as_bytes().iter().all(is_plain) {
        return word.to_string_lossy().into_owned();
    }
    match word.to_str() {
        Some(text) if !text.chars().any(is_hidden) => format!("'{}'", text.replace('\'', r"'\''")),
        _ => escaped(word.as_bytes()),
    }
}

/// A word with what cannot be printed as octal numbers, for which POSIX has $'...' since 2024, and shells have long
/// had it.
fn escaped(word: &[u8]) -> String {
    let mut text = String::from("$'");
    // Writing to a string cannot fail.
    let octal = |text: &mut String, bytes: &[u8]| {
        for byte in bytes {
            let _ = write!(text, "\\{byte:03o}");
        }
    };
    for chunk in word.utf8_chunks() {
        for c in chunk.valid().chars() {
            match c {
                '\'' | '\\' => text.extend(['\\', c]),
                c if is_hidden(c) => octal(&mut text, c.encode_utf8(&mut [0; 4]).as_bytes()),
                c => text.push(c),
            }
        }
        octal(&mut text, chunk.invalid());
    }
    text + "'"
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;

    #[test]
    fn a_shell_reads_what_was_meant_and_a_terminal_shows_it() {
        let words: [&[u8]; 12] = [
            b"plain-1.0",
            b"",
            b"a b",
            b"it's",
            b"$(x) `y` \"z\" \\ ~ * !",
            b"a\nb\t",
            b"\x1b[2J'\\n",
            b"\x017",
            b"caf\xe9",
            "é \u{202e}é".as_bytes(),
            b"~",
            b"-x",
        ];
        for word in words {
            let line = command_line([OsStr::from_bytes(word)]);
            assert!(!line.chars().any(is_hidden), "{line:?}");
            let said = Command::new("bash").args(["-c", &format!("printf %s {line}")]).output();
            // Without an option before it.
            let said = said.expect("a shell").stdout;
            assert_eq!(said, word, "{line}");
        }
        assert_eq!(command_line(["gtkwave", "a b", "c"]), "gtkwave 'a b' c");
    }

    #[test]
    fn a_path_is_no_option() {
        assert_eq!(*operand(Path::new("-x")), *"./-x");
        assert_eq!(*operand(Path::new("a/-x")), *"a/-x");
    }
}
