//! Statements of OBJ and MTL files: lines, comments, words, numbers and names.
//!
//! A `#` begins a comment at the start of a line, and after white space in statements of numbers.
//! In a name it is a character like others. A line that ends in a backslash goes on in the next;
//! where it ends in a name only if white space precedes the backslash, which else ends a path.

use super::super::error::InputError;
use super::super::warning::Warnings;
use crate::progress::over;
use crate::text::printable_path;
use std::borrow::Cow;
use std::path::Path;

/// Statements, in small letters, that hold numbers or indices and no name; frequent ones first.
const OF_NUMBERS: &str = "v f vn vt l vp fo p s curv kd ks ke ka tf d tr ns ni illum";

/// True if a word is one of a list with blanks between.
pub fn is_one_of(list: &str, word: &str) -> bool {
    list.split(' ').any(|listed| listed == word)
}

/// A statement of a file.
pub struct Statement<'a> {
    /// The file.
    pub file: &'a Path,
    /// Its first line, from 1.
    pub line: usize,
    /// Its first word in small letters.
    pub keyword: Cow<'a, str>,
    /// All of it, without comment.
    pub text: &'a str,
    /// The text after the first word.
    pub rest: &'a str,
}

/// Hands on the statements of a decoded file one by one.
pub fn each<E>(
    file: &Path,
    text: &str,
    mut found: impl FnMut(&Statement) -> Result<(), E>,
) -> Result<(), E> {
    let lines = over(format!("reading {}", printable_path(file)), "lines", text.lines());
    let mut lines = (1..).zip(lines);
    while let Some((line, first)) = lines.next() {
        let first = trimmed(first);
        if first.is_empty() || first.starts_with('#') {
            continue;
        }
        let (word, _) = halves(first);
        let keyword = in_small_letters(word);
        let numbers = is_one_of(OF_NUMBERS, &keyword);
        let mut text = Cow::Borrowed(if numbers { without_comment(first) } else { first });
        while goes_on(&text, numbers) {
            let mut longer = text.into_owned();
            longer.pop();
            let next = lines.next();
            if let Some((_, next)) = next {
                longer.push(' ');
                longer.push_str(if numbers { without_comment(next) } else { trimmed(next) });
            }
            text = Cow::Owned(longer);
            if next.is_none() {
                break;
            }
        }
        let text = text.trim();
        let (_, rest) = halves(text);
        found(&Statement { file, line, keyword, text, rest })?;
    }
    Ok(())
}

/// A line without blanks round it, nor a byte order mark, which files that were put together from
/// others have within.
fn trimmed(line: &str) -> &str {
    line.trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}')
}

fn in_small_letters(word: &str) -> Cow<'_, str> {
    if word.bytes().any(|b| b.is_ascii_uppercase()) {
        word.to_ascii_lowercase().into()
    } else {
        word.into()
    }
}

fn goes_on(text: &str, numbers: bool) -> bool {
    let before = text.strip_suffix('\\');
    before.is_some_and(|before| numbers || before.ends_with(char::is_whitespace))
}

/// A word and what follows it.
fn halves(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim())
}

/// The text before a `#` at the beginning or after white space.
pub fn without_comment(text: &str) -> &str {
    let begins =
        |&(at, _): &(usize, &str)| text[..at].chars().next_back().is_none_or(|c| c.is_whitespace());
    let end = text.match_indices('#').find(begins).map_or(text.len(), |(at, _)| at);
    trimmed(&text[..end])
}

/// A number as programs write it; what they write for none, such as `-nan(ind)` or `1.#QNAN`, is
/// NaN.
pub fn number(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| {
        let bare = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
        (bare.starts_with("nan(") || bare.starts_with("1.#")).then_some(f64::NAN)
    })
}

impl<'a> Statement<'a> {
    /// The words after the first.
    pub fn words(&self) -> impl Iterator<Item = &'a str> {
        self.rest.split_whitespace()
    }

    /// The numbers, of which there must be at least so many. They may be NaN or infinite.
    pub fn numbers(&self, least: usize) -> Result<Vec<f64>, InputError> {
        let parsed = |word| number(word).ok_or_else(|| self.wrong("a number", word));
        let numbers = self.words().map(parsed).collect::<Result<Vec<f64>, _>>()?;
        if numbers.len() < least {
            let expected = format!("at least {least} number{}", if least == 1 { "" } else { "s" });
            return Err(self.wrong(expected, numbers.len().to_string()));
        }
        Ok(numbers)
    }

    /// The error that something else was expected in it.
    pub fn wrong(&self, expected: impl Into<String>, found: impl Into<String>) -> InputError {
        let (field, _) = halves(self.text);
        InputError::new(self.file, self.line, field, expected, found)
    }

    /// Adds a warning.
    pub fn warn(&self, warnings: &mut Warnings, problem: &'static str) {
        warnings.add(self.file, self.line, self.text, problem, "");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Line, keyword and rest of every statement.
    fn statements(text: &str) -> Vec<(usize, String, String)> {
        let mut all = Vec::new();
        let found = |s: &Statement| {
            all.push((s.line, s.keyword.to_string(), s.rest.to_string()));
            Ok::<(), ()>(())
        };
        each(Path::new("a.obj"), text, found).expect("nothing fails");
        all
    }

    #[test]
    fn a_hash_begins_a_comment_where_it_can_be_one() {
        let text = "# a\n #b\\\nv 1 2 3 # c\nv 1.#QNAN 2 3#4\nusemtl Grey #1\nmap_Kd t#1.png\nf #";
        let all = statements(text);
        let rest: Vec<&str> = all.iter().map(|(_, _, rest)| rest.as_str()).collect();
        assert_eq!(rest, ["1 2 3", "1.#QNAN 2 3#4", "Grey #1", "t#1.png", ""]);
        assert_eq!(all[4].0, 7);
        assert_eq!(without_comment("red # the other"), "red");
    }

    #[test]
    fn lines_go_on_after_a_backslash_but_not_paths() {
        let text = "f 1 2\\\n3 \\ # more\n\t4\nmtllib a.mtl \\\n b.mtl\nmap_Kd C:\\tex\\\nnewmtl b\nv 1 \\";
        let all = statements(text);
        let said: Vec<(usize, &str)> = all.iter().map(|(n, _, rest)| (*n, rest.as_str())).collect();
        assert_eq!(
            said,
            [(1, "1 2 3  4"), (4, "a.mtl  b.mtl"), (6, "C:\\tex\\"), (7, "b"), (8, "1")]
        );
    }

    #[test]
    fn keywords_of_any_case_and_marks_within_are_read() {
        let all = statements("\u{feff}V\t1\nMap_KD a B\n\u{a0}\nusemtl");
        let words: Vec<&str> = all.iter().map(|(_, word, _)| word.as_str()).collect();
        assert_eq!(words, ["v", "map_kd", "usemtl"]);
        assert_eq!(all[1].2, "a B");
    }

    #[test]
    fn what_programs_write_for_no_number_is_none() {
        for word in ["nan", "-nan(ind)", "1.#QNAN", "-1.#IND00", "NaN"] {
            assert!(number(word).is_some_and(f64::is_nan), "{word}");
        }
        for word in ["1,5", "x", "", "1.0f", "0x10", "--1"] {
            assert_eq!(number(word), None, "{word}");
        }
        assert_eq!(
            ["1e-05", "+.5", "5.", "-inf"].map(number).map(Option::unwrap)[..3],
            [1e-5, 0.5, 5.0]
        );
    }
}
