//! Points that cannot be covered, each with the reason.

use crate::coverage::Kind;
use thiserror::Error;

/// The list in the workspace.
pub const FILE: &str = "testbench/coverage_waivers.txt";

/// A line of the list: points of a file that cannot be covered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Waiver {
    /// File of `rtl`.
    pub file: String,
    /// Kind of the points.
    pub kind: Kind,
    /// Their names, with `*` for anything.
    pub name: String,
    /// The reason why they cannot be covered.
    pub reason: String,
}

/// A line of the list cannot be read.
#[derive(Debug, Error, PartialEq, Eq)]
#[error("{FILE}: line {0}: expected FILE line|toggle NAME: REASON")]
pub struct WaiverError(usize);

impl Waiver {
    /// Reads the list: `FILE KIND NAME: REASON` a line; empty lines and those that begin with `#` say
    /// nothing.
    pub fn parse(text: &str) -> Result<Vec<Waiver>, WaiverError> {
        let lines = text.lines().enumerate();
        let lines = lines.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
        lines.map(|(n, line)| Waiver::read(line).ok_or(WaiverError(n + 1))).collect()
    }

    fn read(line: &str) -> Option<Waiver> {
        let (point, reason) = line.split_once(": ")?;
        let mut words = point.splitn(3, ' ');
        let (file, kind, name) = (words.next()?, words.next()?, words.next()?);
        let kind = [Kind::Line, Kind::Toggle].into_iter().find(|k| k.name() == kind)?;
        let reason = reason.trim();
        (!reason.is_empty()).then(|| Waiver {
            file: file.to_owned(),
            kind,
            name: name.to_owned(),
            reason: reason.to_owned(),
        })
    }

    /// True if it speaks of a point.
    pub fn covers(&self, file: &str, kind: Kind, name: &str) -> bool {
        self.file == file && self.kind == kind && matches(&self.name, name)
    }
}

/// True if a name fits a pattern in which `*` is anything.
fn matches(pattern: &str, name: &str) -> bool {
    let Some((head, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(tail) = name.strip_prefix(head) else { return false };
    (0..=tail.len()).filter(|n| tail.is_char_boundary(*n)).any(|n| matches(rest, &tail[n..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_and_lines() {
        assert!(matches("x_q[*]", "x_q[3]") && matches("*", "") && matches("a*c*", "abcd"));
        assert!(!matches("x_q[*]", "x_q") && !matches("a", "ab"));
        let read = Waiver::parse("# why\n\nsam_a.v toggle x[*]: it is: so\n").unwrap();
        assert!(read[0].covers("sam_a.v", Kind::Toggle, "x[1]") && read[0].reason == "it is: so");
        assert!(!read[0].covers("sam_a.v", Kind::Line, "x[1]"));
        assert_eq!(Waiver::parse("sam_a.v toggle x\n"), Err(WaiverError(1)));
        assert_eq!(Waiver::parse("#\nsam_a.v bit x: y\n"), Err(WaiverError(2)));
    }
}
