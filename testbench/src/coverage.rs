//! Counts of lines and toggles that models keep of their own code, and the sum over all models.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use wheatstone_golden::files::{self, Scratch};

/// A kind of point: a line that is run, or a bit that changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A block of statements.
    Line,
    /// A bit of a signal.
    Toggle,
}

impl Kind {
    /// Name in reports and waivers.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Line => "line",
            Kind::Toggle => "toggle",
        }
    }
}

/// A point of the source. Instances, and builds with other parameters, have their points in common.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// File of `rtl`.
    pub file: String,
    /// Line in it.
    pub line: u32,
    /// Kind of the point.
    pub kind: Kind,
    /// The signal's bit, or what begins at the line: `block`, `if`, `else`, …
    pub name: String,
}

/// Points with their counts.
pub type Counts = BTreeMap<Point, u64>;

/// Most bytes that a model writes of its counts.
const LIMIT: u64 = 1 << 30;

/// Adds up what models count.
#[derive(Debug, Default)]
pub struct Collector(Mutex<Collected>);

#[derive(Debug, Default)]
struct Collected {
    counts: Counts,
    error: Option<io::Error>,
}

impl Collector {
    /// Adds what `write` puts into the file of the path it gets; keeps the first error.
    pub(crate) fn add(&self, write: impl FnOnce(&Path) -> io::Result<()>) {
        let read = || {
            let folder = Scratch::new(&std::env::temp_dir())?;
            let file = folder.path().join("coverage");
            write(&file)?;
            let text = files::read(&file, LIMIT).map_err(|error| error.source)?;
            parse(&String::from_utf8_lossy(&text))
        };
        let counted = read();
        let mut collected = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match counted {
            Ok(counts) => {
                for (point, count) in counts {
                    *collected.counts.entry(point).or_default() += count;
                }
            }
            Err(error) => drop(collected.error.get_or_insert(error)),
        }
    }

    /// Takes the counts so far; nothing is left.
    pub fn take(&self) -> io::Result<Counts> {
        let mut collected = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Collected { counts, error } = std::mem::take(&mut *collected);
        error.map_or(Ok(counts), Err)
    }
}

/// Reads a file of Verilator's: a line `C '<keys>' <count>` a point, keys between the characters 1
/// and 2, their values up to the next 1.
fn parse(text: &str) -> io::Result<Counts> {
    let mut counts = Counts::new();
    for line in text.lines().filter(|line| line.starts_with('C')) {
        let bad = || io::Error::other(format!("coverage: cannot read {line:?}"));
        let (keys, count) = line[1..].rsplit_once(' ').ok_or_else(bad)?;
        let count: u64 = count.parse().map_err(|_| bad())?;
        let point = point(keys.trim().trim_matches('\'')).ok_or_else(bad)?;
        *counts.entry(point).or_default() += count;
    }
    Ok(counts)
}

/// The point of its keys.
fn point(keys: &str) -> Option<Point> {
    let values: BTreeMap<&str, &str> =
        keys.split('\u{1}').filter_map(|pair| pair.split_once('\u{2}')).collect();
    let page = values.get("page")?;
    let kind = match page.split('/').next()? {
        "v_toggle" => Kind::Toggle,
        "v_line" | "v_branch" => Kind::Line,
        _ => return None,
    };
    let file = Path::new(values.get("f")?).file_name()?.to_str()?.to_owned();
    let line = values.get("l")?.parse().ok()?;
    Some(Point { file, line, kind, name: (*values.get("o")?).to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_instances_are_one() {
        let line = |hier: &str, count: u32| {
            format!(
                "C '\u{1}f\u{2}rtl/sam_a.v\u{1}l\u{2}7\u{1}n\u{2}3\u{1}page\u{2}v_toggle/sam_a\
                 \u{1}o\u{2}x_q[3]\u{1}h\u{2}TOP.{hier}' {count}\n"
            )
        };
        let text = format!("# SystemC::Coverage-3\n{}{}", line("a", 2), line("b", 3));
        let counts = parse(&text).unwrap();
        let name = "x_q[3]".to_owned();
        let point = Point { file: "sam_a.v".into(), line: 7, kind: Kind::Toggle, name };
        assert_eq!(counts, Counts::from([(point, 5)]));
        assert!(parse("C 'nothing' 1\n").is_err());
    }
}
