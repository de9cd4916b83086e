//! The beats of a derived polygon as the stream contract defines them, each with its pixel, and exact
//! fractions to compare with.
#![allow(dead_code, reason = "no test needs all of it")]

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::{Edges, Op, Setup};
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::*;

/// A beat and where it comes from.
#[derive(Clone, Copy, Debug)]
pub struct Beat {
    pub op: Op,
    pub save: bool,
    pub last: bool,
    /// Primary pixel.
    pub at: [i64; 2],
    /// Number of its part.
    pub part: usize,
    /// Row shears added since the `LOAD`.
    pub rows: i64,
    /// Steps made since the `LOAD`, creeping included.
    pub steps: i64,
}

/// All beats of a derived polygon, and the records of its parts.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    pub records: Vec<(Setup, Edges)>,
    pub beats: Vec<Beat>,
}

/// Visits the pixels of a derived polygon.
pub fn walk(planner: &Planner, polygon: &Polygon, derived: &Derived) -> Walk {
    let secondary = Attributes::new(polygon, derived.primary.other(), &planner.formats);
    let registers = Registers::derived(derived, &secondary);
    let mut walk = Walk::default();
    for part in parts(&derived.rows, |m| registers.allows(m, &planner.formats)) {
        let mut saved = 0;
        for (n, row) in part.rows.iter().enumerate() {
            // A `ROW` lands here; from here to the row's first pixel the row start creeps.
            let start = match n {
                0 => i64::from(row.first),
                _ => i64::from(part.rows[n - 1].first) + part.movement,
            };
            for x in start..=row.last.into() {
                walk.beats.push(Beat {
                    op: match (x == start, n) {
                        (true, 0) => Op::Load,
                        (true, _) => Op::Row,
                        _ => Op::Step,
                    },
                    save: x <= row.first.into(),
                    last: false,
                    at: [x, row.y.into()],
                    part: walk.records.len(),
                    rows: n as i64,
                    steps: saved + x - start,
                });
            }
            saved += i64::from(row.first) - start;
        }
        walk.records.push(registers.records(&part, planner));
    }
    walk.beats.last_mut().expect("a derived polygon has beats").last = true;
    walk
}

/// Calls `check` for random derived triangles: `count` of each class, views of this size.
pub fn each_derived(
    config: &Config,
    options: Options,
    [width, height]: [u32; 2],
    classes: &[Class],
    count: usize,
    mut check: impl FnMut(&Planner, &Polygon, &Derived),
) {
    let planner = Planner::new(*config, Options { cost_rule: false, ..options }, width, height);
    for &class in classes {
        let mut triangles = Triangles::new(class as u64 + 5, planner.formats, width, height);
        let mut derived = 0;
        for _ in 0..20 * count {
            let polygon = triangles.triangle(class);
            if let Plan::Derived(plan) = planner.plan(&polygon) {
                check(&planner, &polygon, &plan);
                derived += 1;
            }
            if derived == count {
                break;
            }
        }
        assert_eq!(derived, count, "{class:?}: too few triangles are derived");
    }
}

/// A number of pixels as a fraction.
#[derive(Clone, Copy, Debug)]
pub struct Fraction {
    pub numerator: i128,
    pub denominator: i128,
}

impl Fraction {
    /// True if `raw`, with 14 fraction bits, is within `halves` half units of the last place.
    pub fn is_near(&self, raw: i64, halves: i64) -> bool {
        let distance = 2 * (i128::from(raw) * self.denominator - (self.numerator << FRACTION_BITS));
        distance.abs() <= i128::from(halves) * self.denominator
    }

    /// The integer part.
    pub fn floor(&self) -> i64 {
        self.numerator.div_euclid(self.denominator) as i64
    }

    /// The number, nearly.
    pub fn value(&self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

/// Secondary position of the centre of a primary pixel by barycentric coordinates.
pub fn exact(polygon: &Polygon, primary: Eye, at: [i64; 2], formats: &Formats) -> [Fraction; 2] {
    let corners = |eye: Eye| {
        let outline = Outline::new(polygon, eye);
        let points = outline.points();
        [points[0], points[1], points[2]].map(|p| p.map(i128::from))
    };
    let [[a, b, c], secondary] = [corners(primary), corners(primary.other())];
    let one = i128::from(formats.one_pixel());
    let centre = at.map(|n| i128::from(n) * one + one / 2);
    let area = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    };
    let whole = area(a, b, c);
    let weights = [area(centre, b, c), area(a, centre, c), area(a, b, centre)];
    [0, 1].map(|axis: usize| {
        let sum: i128 = weights.iter().zip(secondary).map(|(w, s)| w * s[axis]).sum();
        let sign = whole.signum();
        Fraction { numerator: sum * sign, denominator: whole * one * sign }
    })
}
