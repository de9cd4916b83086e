//! Functional coverage: what the stimulus of the hybrid has crossed with what.
//!
//! A bin is a mode, a division of the filter, a pair of stall patterns and, where a secondary is derived,
//! a class of the mapping ratio and the signs of the three edges' slopes. Counted are the records of
//! `setup` and `edges` that a run of the regression offers.

use crate::cases::Case;
use crate::stalls::{Pattern, Stalls};
use std::collections::BTreeMap;
use std::fmt;
use wheatstone_golden::config::{Config, Division};
use wheatstone_golden::formats::SCALE_ONE;
use wheatstone_golden::interface::{Direction, Interface};
use wheatstone_golden::pipeline::Mode;
use wheatstone_golden::targets::Target;

/// Classes of the mapping ratio, primary pixels to a secondary pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ratio {
    /// 1: every step moves.
    One,
    /// Up to 2.
    Two,
    /// Up to 8.
    Eight,
    /// Up to 29, where the filter ends.
    Most,
}

impl Ratio {
    /// All of them.
    pub const ALL: [Ratio; 4] = [Ratio::One, Ratio::Two, Ratio::Eight, Ratio::Most];

    /// The class of G1, raw.
    fn of(step: i64) -> Ratio {
        match step {
            SCALE_ONE.. => Ratio::One,
            _ if 2 * step >= SCALE_ONE => Ratio::Two,
            _ if 8 * step >= SCALE_ONE => Ratio::Eight,
            _ => Ratio::Most,
        }
    }

    /// Text in tables.
    pub fn name(self) -> &'static str {
        match self {
            Ratio::One => "1",
            Ratio::Two => "1–2",
            Ratio::Eight => "2–8",
            Ratio::Most => "8–29",
        }
    }
}

/// The signs of `a` of the three edges. They add up to 0 in a triangle, so that of the 27 triples
/// these are left.
pub const SIGNS: [[i64; 3]; 12] = [
    [1, 1, -1],
    [1, -1, 1],
    [-1, 1, 1],
    [-1, -1, 1],
    [-1, 1, -1],
    [1, -1, -1],
    [0, 1, -1],
    [0, -1, 1],
    [1, 0, -1],
    [-1, 0, 1],
    [1, -1, 0],
    [-1, 1, 0],
];

/// A combination that the regression is to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Bin {
    /// Code of the mode, 0 to 3.
    mode: u8,
    /// Terms of the division: 0, 2 or 3.
    terms: u32,
    /// Idle and back-pressure pattern, as [`places`].
    stalls: [usize; 2],
    /// Ratio and place of the signs in [`SIGNS`], where a secondary is derived.
    secondary: Option<(Ratio, usize)>,
}

impl fmt::Display for Bin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [idle, pressure] = self.stalls.map(|n| Pattern::BACK_PRESSURE[n].name());
        write!(f, "{}, {}", Mode::NAMES[usize::from(self.mode)], division_name(self.terms))?;
        write!(f, ", idle {idle}, back-pressure {pressure}")?;
        if let Some((ratio, signs)) = self.secondary {
            let signs = SIGNS[signs].map(|sign| ["-", "0", "+"][(sign + 1) as usize]);
            write!(f, ", ratio {}, edges {}", ratio.name(), signs.concat())?;
        }
        Ok(())
    }
}

/// Divisions in the order of tables: the Verilog parameter.
pub const TERMS: [u32; 3] = [0, 2, 3];

/// Text in tables.
pub fn division_name(terms: u32) -> &'static str {
    match terms {
        2 => "two-term",
        3 => "three-term",
        _ => "exact",
    }
}

/// The parameter of a configuration.
fn terms(config: &Config) -> u32 {
    match config.division {
        Division::Exact => 0,
        Division::TwoTerm => 2,
        Division::ThreeTerm => 3,
    }
}

/// Every bin, with its number of hits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bins(BTreeMap<Bin, u64>);

impl Default for Bins {
    fn default() -> Bins {
        let stalls = Stalls::crossed(0).map(places);
        let of_stalls = |stalls: [usize; 2]| {
            let of_mode = move |mode: u8| {
                let derived = Ratio::ALL.into_iter();
                let derived = derived.flat_map(|r| (0..SIGNS.len()).map(move |s| Some((r, s))));
                let secondary = match Mode(mode).is_binocular() {
                    true => derived.collect(),
                    false => vec![None],
                };
                secondary.into_iter().map(move |secondary| (mode, secondary))
            };
            (0..4).flat_map(of_mode).flat_map(move |(mode, secondary)| {
                TERMS.map(|terms| Bin { mode, terms, stalls, secondary })
            })
        };
        Bins(stalls.flat_map(of_stalls).map(|bin| (bin, 0)).collect())
    }
}

impl Bins {
    /// Counts the polygons of a run; those of other targets than the hybrid, and refused ones, are none.
    pub fn count(&mut self, case: &Case, stalls: Stalls) {
        if case.target != Target::Hybrid {
            return;
        }
        for bin in polygons(case, stalls) {
            if let Some(hits) = self.0.get_mut(&bin) {
                *hits += 1;
            }
        }
    }

    /// Bins and how many of them were hit, of a mode, a ratio and a division.
    pub fn share(&self, mode: u8, ratio: Option<Ratio>, terms: u32) -> (usize, usize) {
        let of = |bin: &Bin| bin.mode == mode && bin.terms == terms;
        let of = self.0.iter().filter(|(b, _)| of(b) && b.secondary.map(|(r, _)| r) == ratio);
        let hits: Vec<u64> = of.map(|(_, hits)| *hits).collect();
        (hits.iter().filter(|hits| **hits > 0).count(), hits.len())
    }

    /// All bins, with their hits.
    pub fn all(&self) -> impl Iterator<Item = (&Bin, u64)> {
        self.0.iter().map(|(bin, hits)| (bin, *hits))
    }

    /// The bins that were never hit.
    pub fn empty(&self) -> impl Iterator<Item = &Bin> {
        self.0.iter().filter(|(_, hits)| **hits == 0).map(|(bin, _)| bin)
    }
}

/// Places of the patterns in the list of those of back-pressure, which has all.
fn places(stalls: Stalls) -> [usize; 2] {
    let list = Pattern::BACK_PRESSURE;
    [stalls.idle, stalls.back_pressure].map(|p| list.iter().position(|q| *q == p).unwrap_or(0))
}

/// The bin of every polygon, or part of one, that a case offers.
fn polygons(case: &Case, stalls: Stalls) -> Vec<Bin> {
    let interface = case.interface();
    let records = Records::new(case, &interface);
    let stalls = places(stalls);
    let terms = terms(&case.config);
    let bin = |n: usize| {
        let mode = records.field("setup", "mode", n)?;
        let signs = ["e0_a", "e1_a", "e2_a"].map(|a| records.field("edges", a, n).map(i64::signum));
        let signs = SIGNS.iter().position(|s| s.map(Some) == signs);
        let ratio = Ratio::of(records.field("setup", "x_step", n)?);
        let derived = Mode(mode as u8).is_binocular();
        let secondary = if derived { Some((ratio, signs?)) } else { None };
        Some(Bin { mode: mode as u8, terms, stalls, secondary })
    };
    (0..records.len()).filter_map(bin).collect()
}

/// The records of a case, by name.
struct Records<'a> {
    case: &'a Case,
    interface: &'a Interface,
}

impl<'a> Records<'a> {
    fn new(case: &'a Case, interface: &'a Interface) -> Records<'a> {
        Records { case, interface }
    }

    /// Number of records.
    fn len(&self) -> usize {
        self.table("setup").map_or(0, |(n, _)| self.case.inputs[n].len())
    }

    /// Place of a stream among the inputs, and in the interface.
    fn table(&self, stream: &str) -> Option<(usize, usize)> {
        let streams = self.interface.streams.iter().enumerate();
        let inputs = streams.filter(|(_, s)| s.direction == Direction::Input);
        inputs.enumerate().find(|(_, (_, s))| s.name == stream).map(|(n, (at, _))| (n, at))
    }

    /// A field of a record as a number.
    fn field(&self, stream: &str, name: &str, record: usize) -> Option<i64> {
        let (table, at) = self.table(stream)?;
        let fields = &self.interface.streams[at].fields;
        let place = fields.iter().position(|field| field.name == name)?;
        let table = &self.case.inputs[table];
        (record < table.len()).then(|| fields[place].number(table.row(record)[place]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    #[test]
    fn one_run_of_the_directed_case_hits_every_bin_of_its_stalls() {
        let directed = cases::directed(Target::Hybrid, &Config::DEFAULT);
        let case = directed.iter().find(|case| case.all_stalls).unwrap();
        let mut bins = Bins::default();
        bins.count(case, Stalls::NONE);
        let missing: Vec<String> = bins
            .empty()
            .filter(|bin| bin.terms == 0 && bin.stalls == [0, 0])
            .map(ToString::to_string)
            .collect();
        assert!(missing.is_empty(), "{}", missing.join("\n"));
        assert_eq!(bins.all().filter(|(_, hits)| *hits > 0).count(), 2 * 4 * 12 + 2);
    }
}
