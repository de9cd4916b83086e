//! Statements of scene files that were not followed, and their places.

use crate::text::{printable, printable_path, printable_within};
use std::fmt;
use std::path::{Path, PathBuf};

/// Most warnings of one kind that are kept.
const KEPT: usize = 10;
/// Most characters of a statement in a warning.
const STATEMENT: usize = 80;

/// A statement of a file that was not followed, or not to the letter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The file.
    pub file: PathBuf,
    /// Line in the file, from 1.
    pub line: usize,
    /// The statement as it stands there, cut short.
    pub statement: String,
    /// The fault, and what was done instead.
    pub problem: &'static str,
    /// More about this one; may be empty.
    pub detail: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Warning { file, line, statement, problem, detail } = self;
        write!(f, "{}:{line}: {statement}: {problem}", printable_path(file))?;
        if detail.is_empty() {
            return Ok(());
        }
        write!(f, " ({detail})")
    }
}

/// Warnings of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Kind {
    first: Vec<Warning>,
    more: usize,
}

/// All warnings of a scene: the first ten of each kind, and how many there are beyond.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings {
    kinds: Vec<Kind>,
}

impl Warnings {
    /// Adds one; a kind is what has the same `problem`.
    pub fn add(
        &mut self,
        file: &Path,
        line: usize,
        statement: &str,
        problem: &'static str,
        detail: &str,
    ) {
        let same = |kind: &&mut Kind| kind.first.iter().any(|w| w.problem == problem);
        let known = self.kinds.iter_mut().find(same);
        if let Some(kind) = known.filter(|kind| kind.first.len() == KEPT) {
            kind.more += 1;
            return;
        }
        let warning = Warning {
            file: file.to_owned(),
            line,
            statement: printable_within(statement, STATEMENT),
            problem,
            detail: printable(detail),
        };
        match self.kinds.iter_mut().find(same) {
            Some(kind) => kind.first.push(warning),
            None => self.kinds.push(Kind { first: vec![warning], more: 0 }),
        }
    }

    /// Number of warnings.
    pub fn count(&self) -> usize {
        self.kinds.iter().map(|kind| kind.first.len() + kind.more).sum()
    }

    /// The ones that were kept.
    pub fn iter(&self) -> impl Iterator<Item = &Warning> {
        self.kinds.iter().flat_map(|kind| &kind.first)
    }

    /// A line for each, and one for those of a kind beyond the first ten.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for Kind { first, more } in &self.kinds {
            lines.extend(first.iter().map(Warning::to_string));
            if let Some(Warning { file, problem, .. }) = first.last().filter(|_| *more > 0) {
                lines.push(format!("{}: {problem}: and {more} more", printable_path(file)));
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_of_a_kind_are_kept_and_the_others_counted() {
        let mut warnings = Warnings::default();
        for line in 1..=12 {
            warnings.add(Path::new("a.obj"), line, "f 9", "no such point", "");
        }
        warnings.add(Path::new("b.mtl"), 7, "Kd \u{1b}", "no colour", "of three");
        assert_eq!((warnings.count(), warnings.iter().count()), (13, 11));
        let lines = warnings.lines();
        assert_eq!(lines.len(), 12);
        assert_eq!(lines[9], "a.obj:10: f 9: no such point");
        assert_eq!(lines[10], "a.obj: no such point: and 2 more");
        assert_eq!(lines[11], "b.mtl:7: Kd �: no colour (of three)");
    }
}
