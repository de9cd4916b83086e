//! Text of a manifest: what a pack may say.

/// Most characters of a text.
pub(super) const LONGEST: usize = 200;

/// A text as a manifest has it: in printable ASCII characters, the others escaped, and cut if it is long.
pub(super) fn plain(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        let part = if is_plain(c) { c.to_string() } else { c.escape_default().to_string() };
        if plain.len() + part.len() > LONGEST - 3 {
            return plain + "...";
        }
        plain += &part;
    }
    plain
}

/// True if a manifest may have this character in a text.
pub(super) fn is_plain(c: char) -> bool {
    c == ' ' || c.is_ascii_graphic()
}

/// The fault of a text; none if it is a line that a manifest may have.
pub(super) fn fault(text: &str) -> Option<String> {
    if text.len() > LONGEST {
        return Some(format!("at most {LONGEST} characters"));
    }
    (!text.chars().all(is_plain)).then(|| "printable ASCII characters in one line".into())
}

/// True if a text is a hash as this program writes it.
pub(super) fn is_hash(text: &str) -> bool {
    text.len() == 64 && text.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_may_be_read() {
        for text in ["a scene", "a\n\"b\"\\", "é\u{202e}`include", &"x".repeat(500), ""] {
            let plain = plain(text);
            assert_eq!(fault(&plain), None, "{plain}");
            assert_eq!(super::plain(&plain), plain);
        }
        assert_eq!(plain("a\nb"), "a\\nb");
        assert!(
            fault("a\nb").is_some() && fault("é").is_some() && fault(&"x".repeat(201)).is_some()
        );
    }
}
