//! The committed record of area and timing: written, compared with what is measured, and made into the
//! tables of the documentation.

use super::tech::{Figure, Figures, Tech};
use crate::numbers::thousands;
use crate::record::{read_record, RecordError};
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::files::{self, WriteError};
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::Grouped;

/// Path of the record in the workspace.
pub const FILE: &str = "synth/record.json";

/// Most that an area may grow: 2 %. One that shrinks by more leaves the record out of date.
const GROWTH: f64 = 1.02;
/// Most that a clock may fall: by 10 %, about what placements of the same netlist differ by.
const SLOWING: f64 = 0.90;

/// Least clocks that are asked for, whatever was recorded, in MHz.
pub const FLOORS: [(Target, &str, Tech, f64); 2] = [
    (Target::Hybrid, "default", Tech::Ecp5, 125.0),
    (Target::Minimal, "default", Tech::Ice40, 80.0),
];

/// The cost of a target in a configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The target's name.
    pub target: String,
    /// Name of the configuration, with the parameters that were changed.
    pub config: String,
    /// The technology that it was synthesised for.
    pub tech: Tech,
    /// The measured figures.
    pub figures: Figures,
}

impl Entry {
    fn is_same(&self, other: &Entry) -> bool {
        (&self.target, &self.config, self.tech) == (&other.target, &other.config, other.tech)
    }

    /// Name in messages.
    fn name(&self) -> String {
        format!("{} {} {}", self.target, self.config, self.tech.name())
    }

    /// The fault of an entry whose clock is lower than asked for.
    fn below_floor(&self) -> Option<String> {
        let is_it = |(target, config, tech, _): &&(Target, &str, Tech, f64)| {
            (target.name(), *config, *tech) == (&self.target, &self.config, self.tech)
        };
        let (.., floor) = FLOORS.iter().find(is_it)?;
        let is_below = self.figures.get(&Figure::Fmax).is_none_or(|clock| clock < floor);
        let clock = self.figures.get(&Figure::Fmax);
        let shown = clock.map_or("does not fit".into(), |clock| format!("{clock:.1}"));
        is_below.then(|| format!("{}: MHz {shown}, at least {floor} are asked for", self.name()))
    }

    /// A figure as a table shows it.
    pub fn shown(&self, figure: Figure) -> String {
        match self.figures.get(&figure) {
            Some(value) if figure == Figure::Fmax => format!("{value:.0}"),
            Some(value) => thousands(*value),
            None if figure == Figure::Fmax => "does not fit".into(),
            None => "–".into(),
        }
    }
}

/// All figures, ordered by target, configuration and technology.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record(Vec<Entry>);

impl Record {
    /// The record of a workspace.
    pub fn read(workspace: &Path) -> Result<Record, RecordError> {
        let remedy = "write it with: wheatstone synth --tech gates,ice40,ecp5 --record";
        read_record(workspace, FILE, remedy)
    }

    /// Writes it, an entry a line, so that a change shows as such.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let lines = self.0.iter().map(|entry| serde_json::to_string(entry).unwrap_or_default());
        let text = format!("[\n{}\n]\n", lines.collect::<Vec<_>>().join(",\n"));
        files::write(&workspace.join(FILE), text.as_bytes())
    }

    /// Puts entries in the place of older ones.
    pub fn update(&mut self, entries: &[Entry]) {
        self.0.retain(|old| !entries.iter().any(|new| new.is_same(old)));
        self.0.extend_from_slice(entries);
        let place = |entry: &Entry| {
            let target = Target::named(&entry.target);
            let config = Config::NAMES.iter().position(|name| *name == entry.config);
            (entry.tech, target.and_then(|t| Target::ALL.iter().position(|a| *a == t)), config)
        };
        self.0.sort_by_key(place);
    }

    /// Figures that have become worse than the entry here, a line each; also those that are not here or have
    /// become so much better that the entry is out of date, and clocks below [`FLOORS`].
    pub fn faults(&self, entries: &[Entry]) -> Vec<String> {
        entries.iter().flat_map(|e| self.faults_of(e).into_iter().chain(e.below_floor())).collect()
    }

    fn faults_of(&self, entry: &Entry) -> Vec<String> {
        let what = entry.name();
        let Some(recorded) = self.0.iter().find(|old| old.is_same(entry)) else {
            return vec![format!("{what}: not in {FILE}")];
        };
        let differs = |figure: &&Figure| {
            let [old, new] = [recorded, entry].map(|e| e.figures.get(figure));
            match (old, new) {
                (Some(old), Some(new)) if **figure == Figure::Fmax => *new < old * SLOWING,
                (Some(old), Some(new)) => *new > old * GROWTH || *new < old * (2.0 - GROWTH),
                (old, new) => old != new,
            }
        };
        let tell = |figure: &Figure| {
            let [old, new] = [recorded, entry].map(|e| e.shown(*figure));
            format!("{what}: {} {new}, recorded {old}", figure.heading())
        };
        entry.tech.figures().iter().filter(differs).map(tell).collect()
    }

    /// A figure, if it is there.
    pub fn figure(&self, target: Target, config: &str, tech: Tech, figure: Figure) -> Option<f64> {
        self.find(target, config, tech)?.figures.get(&figure).copied()
    }

    fn find(&self, target: Target, config: &str, tech: Tech) -> Option<&Entry> {
        let is_it = |e: &&Entry| e.target == target.name() && e.config == config && e.tech == tech;
        self.0.iter().find(is_it)
    }

    /// The table of a target's page: a row a configuration.
    pub fn page_table(&self, target: Target) -> String {
        let columns = Tech::ALL.into_iter().flat_map(|t| t.figures().iter().map(move |f| (t, *f)));
        let columns: Vec<(Tech, Figure)> = columns.filter(|c| self.is_used(target, *c)).collect();
        let heading = |(tech, figure): &(Tech, Figure)| match tech {
            Tech::Gates => format!("gates, {}", figure.heading()),
            Tech::Ice40 => format!("iCE40 {}", figure.heading()),
            Tech::Ecp5 => format!("ECP5 {}", figure.heading()),
        };
        let mut text = String::from("\n");
        row(&mut text, "configuration", columns.iter().map(heading));
        row(&mut text, "---", columns.iter().map(|_| "---".to_owned()));
        for config in Config::NAMES {
            let cell = |(tech, figure): &(Tech, Figure)| {
                let entry = self.find(target, config, *tech);
                entry.map_or("–".into(), |entry| entry.shown(*figure))
            };
            row(&mut text, &format!("`{config}`"), columns.iter().map(cell));
        }
        if let Some(gates) = published(target) {
            let place = match target {
                Target::Minimal => "section 5.1",
                Target::Primary => "the primary pipeline that it assumes",
                Target::Hybrid => "sum of Table 1 with three edge interpolators",
                _ => "Table 1",
            };
            // Writing to a string cannot fail.
            let _ = writeln!(text, "\nPaper, {place}: {} gates.", Grouped(gates.into()));
        }
        text
    }

    /// True if a column has something to say: chips without multipliers or memories need none.
    fn is_used(&self, target: Target, (tech, figure): (Tech, Figure)) -> bool {
        let entries = Config::NAMES.iter().filter_map(|config| self.find(target, config, tech));
        let optional = matches!(figure, Figure::Dsps | Figure::Memories);
        let mut values = entries.map(|entry| entry.figures.get(&figure).copied());
        values.any(|value| !optional || value.is_some_and(|value| value > 0.0))
    }

    /// The table of `docs/cost.md`: gates in the paper's configuration, chips in the default one.
    pub fn overview(&self) -> String {
        let mut text = String::from("\n");
        let gates = Tech::Gates.figures().iter().map(|figure| figure.heading().to_owned());
        let chips = ["iCE40 LUT4, MHz", "ECP5 LUT4, MHz"].map(String::from);
        let headings = ["paper's gates".to_owned()].into_iter().chain(gates).chain(chips);
        let headings: Vec<String> = headings.collect();
        row(&mut text, "", headings.iter().cloned());
        row(&mut text, "---", headings.iter().map(|_| "---".to_owned()));
        for target in Target::ALL {
            let paper =
                published(target).map_or("–".into(), |gates| Grouped(gates.into()).to_string());
            let gates = Tech::Gates.figures().iter().map(|figure| {
                let entry = self.find(target, "paper", Tech::Gates);
                entry.map_or("–".into(), |entry| entry.shown(*figure))
            });
            let chips = [Tech::Ice40, Tech::Ecp5].map(|tech| {
                self.find(target, "default", tech).map_or("–".into(), |entry| {
                    format!("{}, {}", entry.shown(Figure::Luts), entry.shown(Figure::Fmax))
                })
            });
            let page = format!("[{0}]({0}.md)", target.name());
            row(&mut text, &page, [paper].into_iter().chain(gates).chain(chips));
        }
        text
    }
}

fn row(text: &mut String, first: &str, cells: impl Iterator<Item = String>) {
    let cells: String = cells.map(|cell| format!(" {cell} |")).collect();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "| {first} |{cells}");
}

/// Gates that the paper gives for a target: Table 1, of the hybrid its sum with three edge
/// interpolators, of the minimal system section 5.1.
pub fn published(target: Target) -> Option<u32> {
    use wheatstone_studies::published::*;
    Some(match target {
        Target::XInterpolator => X_INTERPOLATOR,
        Target::YInterpolator => Y_INTERPOLATOR,
        Target::EdgeInterpolator => EDGE_INTERPOLATOR,
        Target::Filter => FILTER,
        Target::Coverage => COVERAGE,
        Target::Blend => BLEND,
        Target::Redirect => REDIRECT,
        Target::Minimal => MINIMAL,
        Target::Hybrid => HYBRID,
        Target::Primary => PRIMARY,
        Target::Display | Target::Sampler | Target::Traversal | Target::Mono | Target::Stereo => {
            return None
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(figures: &[(Figure, f64)]) -> Entry {
        let figures = figures.iter().copied().collect();
        Entry { target: "filter".into(), config: "paper".into(), tech: Tech::Ecp5, figures }
    }

    #[test]
    fn growth_slowing_and_gaps_are_told() {
        let mut record = Record::default();
        let old = entry(&[(Figure::Luts, 1000.0), (Figure::Fmax, 150.0)]);
        assert_eq!(
            record.faults(std::slice::from_ref(&old)),
            ["filter paper ecp5: not in synth/record.json"]
        );
        record.update(std::slice::from_ref(&old));
        let faults =
            |luts, fmax| record.faults(&[entry(&[(Figure::Luts, luts), (Figure::Fmax, fmax)])]);
        assert!(faults(1020.0, 135.0).is_empty() && faults(981.0, 300.0).is_empty());
        assert_eq!(faults(1021.0, 150.0), ["filter paper ecp5: LUT4 1,021, recorded 1,000"]);
        assert_eq!(faults(979.0, 150.0), ["filter paper ecp5: LUT4 979, recorded 1,000"]);
        assert_eq!(faults(1000.0, 134.9).len(), 1);
        // What no longer fits has no clock.
        assert_eq!(record.faults(&[entry(&[(Figure::Luts, 1000.0)])]).len(), 1);
        record.update(&[entry(&[(Figure::Luts, 900.0), (Figure::Fmax, 150.0)])]);
        assert_eq!((record.0.len(), record.faults(&[old]).len()), (1, 1));
    }

    #[test]
    fn what_is_not_recorded_is_told() {
        let mut record = Record::default();
        record.update(&[entry(&[])]);
        let faults = record.faults(&[entry(&[(Figure::Luts, 1000.0), (Figure::Fmax, 150.0)])]);
        let fits = "filter paper ecp5: MHz 150, recorded does not fit";
        assert_eq!(faults, ["filter paper ecp5: LUT4 1,000, recorded –", fits]);
    }

    #[test]
    fn a_clock_below_its_floor_is_told_whatever_is_recorded() {
        let mut record = Record::default();
        for (target, config, tech, floor) in FLOORS {
            let clocked = |clock: Option<f64>| Entry {
                target: target.name().into(),
                config: config.into(),
                tech,
                figures: clock.map(|clock| (Figure::Fmax, clock)).into_iter().collect(),
            };
            for (clock, faults) in [(Some(floor - 0.1), 1), (None, 1), (Some(floor), 0)] {
                record.update(&[clocked(clock)]);
                assert_eq!(record.faults(&[clocked(clock)]).len(), faults, "{clock:?}");
            }
        }
    }
}
