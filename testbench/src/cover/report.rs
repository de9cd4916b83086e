//! Coverage, file by file.

use super::functional::{division_name, Ratio, TERMS};
use super::{Bins, Counts, Kind, Point, Waiver};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write;
use wheatstone_golden::pipeline::Mode;

/// Points of a kind in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Share {
    /// Points.
    pub points: usize,
    /// Points that were covered.
    pub covered: usize,
    /// Points that were not covered and are waived.
    pub waived: usize,
}

impl Share {
    /// Points that are neither covered nor waived.
    pub fn missing(&self) -> usize {
        self.points - self.covered - self.waived
    }

    /// True if less is covered, or more missing or waived, than there was.
    pub fn is_worse(&self, old: &Share) -> bool {
        self.covered < old.covered || self.waived > old.waived || self.missing() > old.missing()
    }

    /// Per cent of the points that can be covered.
    pub fn percent(&self) -> f64 {
        match self.points - self.waived {
            0 => 100.0,
            can => 100.0 * self.covered as f64 / can as f64,
        }
    }
}

impl std::ops::Add for Share {
    type Output = Share;

    fn add(self, other: Share) -> Share {
        Share {
            points: self.points + other.points,
            covered: self.covered + other.covered,
            waived: self.waived + other.waived,
        }
    }
}

/// A file of the Verilog.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileCoverage {
    /// Blocks of lines.
    pub lines: Share,
    /// Bits.
    pub toggles: Share,
}

/// All files, and what is wrong.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// By name.
    pub files: BTreeMap<String, FileCoverage>,
    /// Points that are neither covered nor waived.
    pub missing: Vec<Point>,
    /// Points that are waived, with the reason.
    pub waived: Vec<(Point, String)>,
    /// Waivers that no point needs.
    pub stale: Vec<Waiver>,
}

impl Report {
    /// Sorts the points into what is covered, waived and missing.
    pub fn new(counts: &Counts, waivers: &[Waiver]) -> Report {
        let mut report = Report::default();
        let mut needed = vec![false; waivers.len()];
        for (point, &count) in counts {
            let mut share = Share { points: 1, ..Share::default() };
            let fits = |w: &Waiver| w.covers(&point.file, point.kind, &point.name);
            if count > 0 {
                share.covered = 1;
            } else if let Some(n) = waivers.iter().position(fits) {
                (share.waived, needed[n]) = (1, true);
                report.waived.push((point.clone(), waivers[n].reason.clone()));
            } else {
                report.missing.push(point.clone());
            }
            let file = report.files.entry(point.file.clone()).or_default();
            match point.kind {
                Kind::Line => file.lines = file.lines + share,
                Kind::Toggle => file.toggles = file.toggles + share,
            }
        }
        let unneeded = waivers.iter().zip(needed).filter(|(_, needed)| !needed);
        report.stale = unneeded.map(|(waiver, _)| waiver.clone()).collect();
        report
    }
}

impl FileCoverage {
    /// Lines and toggles of all files.
    pub fn total<'a>(files: impl Iterator<Item = &'a FileCoverage>) -> FileCoverage {
        files.fold(FileCoverage::default(), |sum, file| FileCoverage {
            lines: sum.lines + file.lines,
            toggles: sum.toggles + file.toggles,
        })
    }
}

fn plain_table(header: &[&str]) -> comfy_table::Table {
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::NOTHING);
    table.set_header(header);
    table
}

fn right(mut table: comfy_table::Table) -> String {
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(comfy_table::CellAlignment::Right);
    }
    table.to_string()
}

/// The tables for a terminal: files, then the crossing of the stimulus.
pub fn table(report: &Report, bins: Option<&Bins>) -> String {
    let mut table = plain_table(&["file", "lines", "waived", "", "toggles", "waived", ""]);
    let total = FileCoverage::total(report.files.values());
    let rows = report.files.iter().map(|(name, file)| (name.as_str(), file));
    for (name, file) in rows.chain([("all", &total)]) {
        let cells = [file.lines, file.toggles].map(|share| {
            let Share { points, covered, waived } = share;
            let waived = if waived > 0 { waived.to_string() } else { String::new() };
            [format!("{covered}/{points}"), waived, format!("{:.1} %", share.percent())]
        });
        table.add_row([name.to_owned()].into_iter().chain(cells.concat()));
    }
    let mut text = right(table);
    if let Some(bins) = bins {
        let _ = write!(text, "\n\n{}", crossing_table(bins));
    }
    text
}

/// Bins hit and bins, by mode and ratio, one of each division.
pub fn crossing(bins: &Bins) -> Vec<(String, Vec<(usize, usize)>)> {
    let of_mode = |mode: u8| {
        let ratios = match Mode(mode).is_binocular() {
            true => Ratio::ALL.map(Some).to_vec(),
            false => vec![None],
        };
        ratios.into_iter().map(move |ratio| (mode, ratio))
    };
    let row = |(mode, ratio): (u8, Option<Ratio>)| {
        let name = Mode::NAMES[usize::from(mode)];
        let label = ratio.map_or(name.into(), |ratio| format!("{name}, {}", ratio.name()));
        (label, TERMS.map(|terms| bins.share(mode, ratio, terms)).to_vec())
    };
    (0..4).flat_map(of_mode).map(row).collect()
}

/// The divisions, in the order of [`crossing`].
pub fn divisions() -> [&'static str; 3] {
    TERMS.map(division_name)
}

fn crossing_table(bins: &Bins) -> String {
    let header = ["mode, ratio: bins hit"].into_iter().chain(divisions());
    let mut table = plain_table(&header.collect::<Vec<_>>());
    for (label, shares) in crossing(bins) {
        let shares = shares.iter().map(|(hit, all)| format!("{hit}/{all}"));
        table.add_row([label].into_iter().chain(shares));
    }
    right(table)
}

/// The whole report for machines.
pub fn json(report: &Report, bins: Option<&Bins>, command: &str) -> String {
    let share = |share: &Share| {
        serde_json::json!({
            "points": share.points, "covered": share.covered, "waived": share.waived,
            "percent": share.percent(),
        })
    };
    let point = |point: &Point| {
        serde_json::json!({
            "file": point.file, "line": point.line, "kind": point.kind.name(), "name": point.name,
        })
    };
    let files = report.files.iter().map(|(name, file)| {
        let both =
            serde_json::json!({"lines": share(&file.lines), "toggles": share(&file.toggles)});
        (name.clone(), both)
    });
    let waived = report.waived.iter().map(|(p, reason)| {
        let mut value = point(p);
        value["reason"] = reason.as_str().into();
        value
    });
    let mut content = serde_json::json!({
        "command": command,
        "files": files.collect::<serde_json::Map<_, _>>(),
        "waived": waived.collect::<Vec<_>>(),
        "missing": report.missing.iter().map(point).collect::<Vec<_>>(),
    });
    if let Some(bins) = bins {
        let hits = bins.all().map(|(bin, hits)| (bin.to_string(), hits.into()));
        content["functional"] = hits.collect::<serde_json::Map<_, _>>().into();
    }
    format!("{content:#}\n")
}

/// A source with what was counted in front of every line: how often its block ran, then the share of its
/// bits that changed; `!` where something is missing, `w` where it is waived. The bits are named below.
pub fn annotated(file: &str, source: &str, counts: &Counts, report: &Report) -> String {
    let mut text = String::new();
    let missing: Vec<&Point> = report.missing.iter().filter(|p| p.file == file).collect();
    let waived: Vec<_> = report.waived.iter().filter(|(p, _)| p.file == file).collect();
    for (line, code) in (1u32..).zip(source.lines()) {
        let of = |kind: Kind| {
            let here = move |p: &Point| p.file == file && p.line == line && p.kind == kind;
            counts.iter().filter(move |(p, _)| here(p)).map(|(_, n)| *n)
        };
        let runs = of(Kind::Line).min().map_or(String::new(), |n| n.to_string());
        let bits = match of(Kind::Toggle).count() {
            0 => String::new(),
            all => format!("{}/{all}", of(Kind::Toggle).filter(|n| *n > 0).count()),
        };
        let mark = match () {
            () if missing.iter().any(|p| p.line == line) => "!",
            () if waived.iter().any(|(p, _)| p.line == line) => "w",
            () => " ",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{mark} {runs:>10} {bits:>9} {line:>4}  {code}");
    }
    for point in missing {
        let _ =
            writeln!(text, "missing: line {}, {} {}", point.line, point.kind.name(), point.name);
    }
    for (point, reason) in waived {
        let Point { line, kind, name, .. } = point;
        let _ = writeln!(text, "waived: line {line}, {} {name}: {reason}", kind.name());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(kind: Kind, name: &str) -> Point {
        Point { file: "a.v".into(), line: 1, kind, name: name.into() }
    }

    #[test]
    fn what_is_missing_waived_and_stale_is_told() {
        let counts = Counts::from([
            (point(Kind::Line, "if"), 3),
            (point(Kind::Toggle, "x[0]"), 0),
            (point(Kind::Toggle, "x[1]"), 1),
            (point(Kind::Toggle, "y"), 0),
        ]);
        let waivers = "a.v toggle x[0]: why\na.v toggle x[1]: it is covered\na.v line z: gone\n";
        let report = Report::new(&counts, &Waiver::parse(waivers).unwrap());
        assert_eq!(report.missing, [point(Kind::Toggle, "y")]);
        assert_eq!(report.waived, [(point(Kind::Toggle, "x[0]"), "why".to_owned())]);
        let stale: Vec<&str> = report.stale.iter().map(|w| w.name.as_str()).collect();
        assert_eq!(stale, ["x[1]", "z"]);
        let file = &report.files["a.v"];
        assert_eq!((file.lines.missing(), file.toggles.missing()), (0, 1));
        assert_eq!(file.toggles.percent(), 50.0);
        let text = annotated("a.v", "wire x;\n", &counts, &report);
        assert!(text.starts_with("!          3       1/3    1  wire x;\nmissing: "), "{text}");
        assert!(json(&report, None, "c").contains("\"reason\": \"why\""));
    }
}
