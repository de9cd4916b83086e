//! Text that users write: how it is decoded, and how parts of it are shown on a terminal.
//!
//! All text is UTF-8. A byte order mark in front is dropped, and lines may end in LF, CRLF or CR:
//! decoded text has LF alone, so that `str::lines` and every reader count the same lines as an
//! editor. Text in UTF-16 or UTF-32 is refused by that name.

use std::fmt;
use std::path::Path;

/// Most characters of untrusted text in a message.
pub const SHOWN: usize = 200;

/// The reason why bytes are no text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TextError {
    /// The text has another encoding.
    #[error("{0} text; save it as UTF-8")]
    Encoding(&'static str),
    /// Some bytes are no character.
    #[error("bytes that are not UTF-8; save it as UTF-8")]
    Bytes {
        /// Line of the first of them, from 1.
        line: usize,
    },
}

impl TextError {
    /// Line of the error, from 1, where there is one.
    pub fn line(&self) -> Option<usize> {
        match *self {
            TextError::Encoding(_) => None,
            TextError::Bytes { line } => Some(line),
        }
    }
}

/// Decodes text that must be UTF-8 throughout.
pub fn decode(bytes: &[u8]) -> Result<String, TextError> {
    let bytes = without_mark(bytes)?;
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        TextError::Bytes { line: 1 + with_line_feeds(before.into()).matches('\n').count() }
    })?;
    Ok(with_line_feeds(text.into()))
}

/// Decodes text whose names and comments may be in an older encoding, as exporters write them:
/// each byte that is not UTF-8 becomes the Latin-1 character of its number. A name is then the same
/// wherever it is written in the same way.
pub fn decode_with_latin1(bytes: &[u8]) -> Result<String, TextError> {
    let bytes = without_mark(bytes)?;
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        text.extend(chunk.invalid().iter().map(|&byte| char::from(byte)));
    }
    Ok(with_line_feeds(text))
}

/// Drops the byte order mark of UTF-8 and refuses those of others, and text that shows without a
/// mark, by the zeros in its first characters, that it has two or four bytes for each.
fn without_mark(bytes: &[u8]) -> Result<&[u8], TextError> {
    let encoding = match *bytes {
        [0xff, 0xfe, 0, 0, ..] | [1..=255, 0, 0, 0, ..] => "UTF-32 (little-endian)",
        [0, 0, 0xfe, 0xff, ..] | [0, 0, 0, 1..=255, ..] => "UTF-32 (big-endian)",
        [0xff, 0xfe, ..] | [1..=255, 0, 1..=255, 0, ..] => "UTF-16 (little-endian)",
        [0xfe, 0xff, ..] | [0, 1..=255, 0, 1..=255, ..] => "UTF-16 (big-endian)",
        _ => return Ok(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
    };
    Err(TextError::Encoding(encoding))
}

/// Makes every line end in LF.
fn with_line_feeds(text: String) -> String {
    if text.contains('\r') {
        text.replace("\r\n", "\n").replace('\r', "\n")
    } else {
        text
    }
}

/// Untrusted text for one line of a terminal, of at most [`SHOWN`] characters.
pub fn printable(text: &str) -> String {
    printable_within(text, SHOWN)
}

/// Untrusted text for one line of a terminal: what moves the cursor, hides or reorders text is
/// replaced, and what exceeds `most` characters cut off.
pub fn printable_within(text: &str, most: usize) -> String {
    let mut rest = text.chars();
    let mut shown: String = rest.by_ref().take(most).map(visible).collect();
    if rest.next().is_some() {
        shown.push('…');
    }
    shown
}

/// A path for one line of a terminal; of a long one the end, which has the name.
pub fn printable_path(path: &Path) -> String {
    let text = path.display().to_string();
    let length = text.chars().count();
    let end: String = text.chars().skip(length.saturating_sub(2 * SHOWN)).map(visible).collect();
    if length > 2 * SHOWN {
        format!("…{end}")
    } else {
        end
    }
}

/// A number with its thousands apart.
#[derive(Clone, Copy, Debug)]
pub struct Grouped(pub u64);

impl fmt::Display for Grouped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 < 1000 {
            return write!(f, "{}", self.0);
        }
        write!(f, "{},{:03}", Grouped(self.0 / 1000), self.0 % 1000)
    }
}

/// True if a character has no place on a line of a terminal: control characters, line separators, invisible characters
/// and those that turn the direction of writing.
pub fn is_hidden(c: char) -> bool {
    let is_format = matches!(
        c,
        '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}'
    );
    is_format || c.is_control()
}

/// The replacement character for what [`is_hidden`].
fn visible(c: char) -> char {
    if is_hidden(c) {
        '\u{fffd}'
    } else {
        c
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_is_dropped_and_lines_end_in_one_way() {
        assert_eq!(decode(b"\xef\xbb\xbfa\r\nb\rc\n\rd"), Ok("a\nb\nc\n\nd".into()));
        assert_eq!(decode("ä\n".as_bytes()), Ok("ä\n".into()));
        assert_eq!(decode(b""), Ok(String::new()));
        assert_eq!(decode(b"a"), Ok("a".into()));
    }

    #[test]
    fn other_encodings_are_named() {
        let units = |text: &str| text.encode_utf16().collect::<Vec<u16>>();
        for mark in ["", "\u{feff}"] {
            let text = format!("{mark}v 1 2 3\n");
            let little: Vec<u8> = units(&text).iter().flat_map(|u| u.to_le_bytes()).collect();
            let big: Vec<u8> = units(&text).iter().flat_map(|u| u.to_be_bytes()).collect();
            let wide: Vec<u8> = text.chars().flat_map(|c| (c as u32).to_le_bytes()).collect();
            let wide_big: Vec<u8> = text.chars().flat_map(|c| (c as u32).to_be_bytes()).collect();
            let named = [
                (little, "UTF-16 (little-endian)"),
                (big, "UTF-16 (big-endian)"),
                (wide, "UTF-32 (little-endian)"),
                (wide_big, "UTF-32 (big-endian)"),
            ];
            for (bytes, name) in named {
                for decoded in [decode(&bytes), decode_with_latin1(&bytes)] {
                    assert_eq!(decoded, Err(TextError::Encoding(name)), "{mark:?}");
                }
            }
        }
        let said = TextError::Encoding("UTF-16 (big-endian)").to_string();
        assert_eq!(said, "UTF-16 (big-endian) text; save it as UTF-8");
    }

    #[test]
    fn bytes_of_older_encodings_are_refused_or_taken_for_latin_1() {
        let bytes = b"a\r\nb\rcaf\xe9 \xc3\xa9\xff";
        assert_eq!(decode(bytes), Err(TextError::Bytes { line: 3 }));
        assert_eq!(decode_with_latin1(bytes), Ok("a\nb\ncafé éÿ".into()));
        // Nothing that is cut off gets lost.
        assert_eq!(decode_with_latin1(b"\xe2\x82"), Ok("â\u{82}".into()));
    }

    #[test]
    fn what_is_shown_stays_on_its_line() {
        assert_eq!(printable("a\u{1b}[2J\tb\u{7f}\u{9b}\u{202e}\u{2028}ä"), "a�[2J�b����ä");
        assert_eq!(printable(&"ä".repeat(201)), "ä".repeat(200) + "…");
        assert_eq!(printable(&"ä".repeat(200)), "ä".repeat(200));
        assert_eq!(printable_within("abcd", 3), "abc…");
        assert_eq!(printable_path(Path::new("a\nb/c.obj")), "a�b/c.obj");
        let long = printable_path(Path::new(&("a/".repeat(300) + "c.obj")));
        assert!(long.starts_with('…') && long.ends_with("/c.obj"), "{long}");
        assert_eq!(long.chars().count(), 401);
    }
}
