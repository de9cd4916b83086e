//! The committed record of coverage and replay, and its tables in `docs/verification.md`.

use crate::cover::{self, Bins, FileCoverage, Report, Share};
use crate::record::{read_record, RecordError};
use crate::replay::Way;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;
use wheatstone_golden::files::{self, WriteError};
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::Grouped;

/// Path of the record in the workspace.
pub const FILE: &str = "testbench/verification.json";

/// The last measurements.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Coverage of the Verilog's files.
    pub coverage: BTreeMap<String, FileCoverage>,
    /// Functional coverage: bins hit and bins.
    pub crossing: Vec<(String, Vec<(usize, usize)>)>,
    /// Replays that were equal in every bit.
    pub replays: BTreeSet<Replay>,
}

/// A pack that was equal in every bit.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Replay {
    /// The pack's name: that of its target, maybe with a hyphen and more.
    pub pack: String,
    /// Name of the configuration.
    pub config: String,
    /// Name of the way in which it was replayed.
    pub way: String,
    /// Beats of all streams.
    pub beats: u64,
}

impl Replay {
    /// The target's name.
    fn target(&self) -> &str {
        self.pack.split('-').next().unwrap_or_default()
    }

    /// True if both are of the same pack in the same way.
    fn is_same(&self, other: &Replay) -> bool {
        self.pack == other.pack && self.is_beside(other)
    }

    /// True if both are of the same target in the same way.
    fn is_beside(&self, other: &Replay) -> bool {
        let own = (self.target(), &self.config, &self.way);
        own == (other.target(), &other.config, &other.way)
    }
}

impl Record {
    /// The record of a workspace.
    pub fn read(workspace: &Path) -> Result<Record, RecordError> {
        let remedy = "write it with: wheatstone cover --record && wheatstone replay --record";
        read_record(workspace, FILE, remedy)
    }

    /// Writes it.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        files::write(&workspace.join(FILE), format!("{text}\n").as_bytes())
    }

    /// Takes over what was covered.
    pub fn cover(&mut self, report: &Report, bins: &Bins) {
        self.coverage = report.files.clone();
        self.crossing = cover::crossing(bins);
    }

    /// Everything that is covered in parts, by name.
    fn shares(&self) -> BTreeMap<String, Share> {
        let of_file = |(name, file): (&String, &FileCoverage)| {
            [(format!("{name} lines"), file.lines), (format!("{name} toggles"), file.toggles)]
        };
        let of_row = |(label, shares): &(String, Vec<(usize, usize)>)| {
            let share = |(division, &(covered, points)): (&str, &(usize, usize))| {
                (format!("bins of {label}, {division}"), Share { points, covered, waived: 0 })
            };
            cover::divisions().into_iter().zip(shares).map(share).collect::<Vec<_>>()
        };
        let files = self.coverage.iter().flat_map(of_file);
        files.chain(self.crossing.iter().flat_map(of_row)).collect()
    }

    /// Files where less is covered now, or more waived, than here, a line each; also what is only in one of both.
    pub fn cover_faults(&self, now: &Record) -> Vec<String> {
        let [recorded, found] = [self, now].map(Record::shares);
        let names: BTreeSet<&String> = recorded.keys().chain(found.keys()).collect();
        let shown = |share: &Share| {
            format!("{} of {} covered, {} waived", share.covered, share.points, share.waived)
        };
        let tell = |name: &String| {
            let what = match (recorded.get(name), found.get(name)) {
                (Some(old), Some(new)) if !new.is_worse(old) => return None,
                (Some(old), Some(new)) => format!("{}, recorded {}", shown(new), shown(old)),
                (None, _) => format!("not in {FILE}"),
                (_, None) => format!("only in {FILE}"),
            };
            Some(format!("{name}: {what}"))
        };
        names.into_iter().filter_map(tell).collect()
    }

    /// Replays that are not equal, not here, or here with another number of beats, a line each; also packs of the
    /// same targets that are only here. What is compared says of each whether it was equal.
    pub fn replay_faults(&self, replays: &[(Replay, bool)]) -> Vec<String> {
        let told = |replay: &Replay, what: &str| {
            format!("{} {} {}: {what}", replay.pack, replay.config, replay.way)
        };
        let tell = |(new, passed): &(Replay, bool)| {
            let what = match self.replays.iter().find(|old| old.is_same(new)) {
                _ if !passed => "not equal".into(),
                None => format!("not in {FILE}"),
                Some(old) if old.beats == new.beats => return None,
                Some(old) => format!("{} beats, recorded {}", new.beats, old.beats),
            };
            Some(told(new, &what))
        };
        let is_gone = |old: &&Replay| {
            let mut beside = replays.iter().filter(|(new, _)| new.is_beside(old)).peekable();
            beside.peek().is_some() && !beside.any(|(new, _)| new.is_same(old))
        };
        let gone = self.replays.iter().filter(is_gone);
        let gone = gone.map(|old| told(old, &format!("only in {FILE}")));
        replays.iter().filter_map(tell).chain(gone).collect()
    }

    /// Takes over replays in the place of older ones of the same targets; of those that were not equal nothing
    /// stays.
    pub fn replay(&mut self, replays: &[(Replay, bool)]) {
        self.replays.retain(|old| !replays.iter().any(|(new, _)| new.is_beside(old)));
        let passed = replays.iter().filter(|(_, passed)| *passed);
        self.replays.extend(passed.map(|(replay, _)| replay.clone()));
    }

    /// Coverage of the Verilog, file by file.
    pub fn coverage_table(&self) -> String {
        let mut text = String::from(
            "\n| file | lines | toggles | waived | covered or waived |\n| --- | --- | --- | --- | --- |\n",
        );
        let total = FileCoverage::total(self.coverage.values());
        let link = |name: &String| format!("[{name}](../rtl/{name})");
        let rows = self.coverage.iter().map(|(name, file)| (link(name), file));
        for (name, file) in rows.chain([("all".to_owned(), &total)]) {
            let both = file.lines + file.toggles;
            let shown = |share: Share| format!("{} of {}", share.covered, share.points);
            let (lines, toggles) = (shown(file.lines), shown(file.toggles));
            let waived = both.waived;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "| {name} | {lines} | {toggles} | {waived} | {:.1} % |",
                both.percent()
            );
        }
        text
    }

    /// Functional coverage, by mode and ratio.
    pub fn crossing_table(&self) -> String {
        let divisions = cover::divisions().join(" | ");
        let mut text = format!("\n| mode, ratio | {divisions} |\n| --- | --- | --- | --- |\n");
        for (label, shares) in &self.crossing {
            let shares = shares.iter().map(|(hit, all)| format!(" {hit} of {all} |"));
            // Writing to a string cannot fail.
            let _ = writeln!(text, "| {label} |{}", shares.collect::<String>());
        }
        text
    }

    /// Packs replayed, a row a pack: beats, where all were equal.
    pub fn replay_table(&self) -> String {
        let ways = Way::ALL.map(Way::name).join(" | ");
        let mut text = format!("\n| pack | {ways} |\n| --- | --- | --- | --- | --- |\n");
        let configs: BTreeSet<&str> = self.replays.iter().map(|r| r.config.as_str()).collect();
        for target in Target::ALL.map(Target::name) {
            let of_target = self.replays.iter().filter(|r| r.target() == target);
            let packs: BTreeSet<&str> = of_target.map(|r| r.pack.as_str()).collect();
            for (pack, config) in
                packs.iter().flat_map(|pack| configs.iter().map(move |c| (pack, c)))
            {
                let cells = Way::ALL.map(|way| {
                    let name = (*pack, *config, way.name());
                    let of = |r: &&Replay| (&*r.pack, &*r.config, &*r.way) == name;
                    let replay = self.replays.iter().find(of);
                    replay.map_or("–".into(), |r| format!("{} beats", Grouped(r.beats)))
                });
                let cells = cells.join(" | ");
                // Writing to a string cannot fail.
                let _ = writeln!(text, "| [{pack}]({target}.md) `{config}` | {cells} |");
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replay(beats: u64) -> Replay {
        let [pack, config, way] = ["mono", "paper", "gates"].map(String::from);
        Replay { pack, config, way, beats }
    }

    fn right(beats: u64) -> Replay {
        Replay { pack: "mono-right".into(), ..replay(beats) }
    }

    #[test]
    fn a_replay_takes_the_place_of_an_older_one() {
        let mut record = Record::default();
        record.replay(&[(replay(7), true), (right(7), true)]);
        record.replay(&[(replay(1250), true), (right(1250), true)]);
        for name in ["mono", "mono-right"] {
            let row = format!("| [{name}](mono.md) `paper` | – | – | 1,250 beats | – |\n");
            assert!(record.replay_table().contains(&row), "{}", record.replay_table());
        }
        assert_eq!(record.replays.len(), 2);
        record.replay(&[(replay(8), false)]);
        assert!(record.replays.is_empty(), "of the target there is no other pack now");
    }

    #[test]
    fn what_no_longer_replays_as_recorded_is_told() {
        let mut record = Record::default();
        record.replay(&[(replay(7), true)]);
        let faults = |replay, passed| record.replay_faults(&[(replay, passed)]);
        assert_eq!(faults(replay(7), true), [""; 0]);
        assert_eq!(faults(replay(7), false), ["mono paper gates: not equal"]);
        assert_eq!(faults(replay(8), true), ["mono paper gates: 8 beats, recorded 7"]);
        let other = Replay { way: "icarus".into(), ..replay(7) };
        assert_eq!(faults(other, true), [format!("mono paper icarus: not in {FILE}")]);
        // A pack that is new, and one that the target has no longer.
        let [new, gone] = ["not", "only"].map(|what| format!("{what} in {FILE}"));
        let expected =
            [format!("mono-right paper gates: {new}"), format!("mono paper gates: {gone}")];
        assert_eq!(faults(right(7), true), expected);
    }

    #[test]
    fn what_is_covered_less_than_recorded_is_told() {
        let all = Share { points: 9, covered: 8, waived: 1 };
        let of = |toggles, hit| {
            let file = FileCoverage { lines: Share::default(), toggles };
            let crossing = vec![("MONO_LEFT".to_owned(), vec![(2, 2), (2, 2), (hit, 2)])];
            Record {
                coverage: BTreeMap::from([("a.v".to_owned(), file)]),
                crossing,
                ..Record::default()
            }
        };
        let record = of(all, 1);
        let more = Share { points: 20, covered: 19, waived: 1 };
        for (toggles, hit) in [(all, 1), (more, 2), (Share { covered: 9, waived: 0, ..all }, 1)] {
            assert_eq!(record.cover_faults(&of(toggles, hit)), [""; 0]);
        }
        let faults = |toggles, hit| record.cover_faults(&of(toggles, hit));
        let waived = Share { points: 10, waived: 2, ..all };
        let told = "a.v toggles: 8 of 10 covered, 2 waived, recorded 8 of 9 covered, 1 waived";
        assert_eq!(faults(waived, 1), [told]);
        assert_eq!(faults(Share { points: 10, ..all }, 1).len(), 1, "one is missing");
        assert_eq!(faults(Share { points: 8, covered: 7, ..all }, 1).len(), 1, "one is gone");
        let told = "bins of MONO_LEFT, three-term: 0 of 2 covered, 0 waived, recorded 1 of 2 covered, 0 waived";
        assert_eq!(faults(all, 0), [told]);
        let only = |what: &str| ["lines", "toggles"].map(|k| format!("a.v {k}: {what} in {FILE}"));
        let empty = Record { coverage: BTreeMap::new(), ..record.clone() };
        assert_eq!(empty.cover_faults(&record), only("not"));
        assert_eq!(record.cover_faults(&empty), only("only"));
    }
}
