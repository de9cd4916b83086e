//! Edges followed from scan line to scan line, for one view or for two that share their rows.
//!
//! Which pixels lie right of an edge is decided in integers, so that coverage is that of the
//! half-open rule of [`crate::direct`] whatever is interpolated along the edge.

use crate::formats::{Eye, Formats};
use crate::setup::Vertex;
use crate::work::Real;

/// Where an edge crosses the current row in one view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// The first pixel whose centre is not left of the edge.
    pub cell: i32,
    /// From the edge to that centre, in pixels times [`Edge::denominator`].
    rest: i32,
    step: i32,
    step_rest: i32,
}

/// An edge between two corners on the rows whose centre lines it crosses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge<T, const EYES: usize> {
    /// The first row.
    pub first: i32,
    /// The row after the last one.
    pub end: i32,
    /// Where it crosses the current row in each view.
    pub x: [Crossing; EYES],
    denominator: i32,
    inverse: T,
}

impl<const EYES: usize> Edge<f64, EYES> {
    /// An edge that crosses no row.
    pub const NONE: Self = {
        let x = [Crossing { cell: 0, rest: 0, step: 0, step_rest: 0 }; EYES];
        Edge { first: 0, end: 0, x, denominator: 1, inverse: 1.0 }
    };
}

/// Where an edge is on its first row, for what is interpolated along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along<T> {
    /// Part of the way from the upper to the lower corner.
    pub start: T,
    /// Part of the way that one row is.
    pub row: T,
}

/// First row whose centre line is not above `y`.
#[inline]
fn row_below(y: i32, formats: &Formats) -> i32 {
    (y + (1 << (formats.subpixel_bits - 1)) - 1) >> formats.subpixel_bits
}

impl<T: Real, const EYES: usize> Edge<T, EYES> {
    /// The edge from an upper to a lower corner, on its first row from row `top` on; none if it
    /// crosses no row there. What the views share is computed once.
    pub fn new(
        upper: &Vertex,
        lower: &Vertex,
        eyes: [Eye; EYES],
        top: i32,
        formats: &Formats,
    ) -> Option<(Edge<T, EYES>, Along<T>)> {
        let first = row_below(upper.y[0], formats).max(top);
        let end = row_below(lower.y[0], formats);
        if first >= end {
            return None;
        }
        let bits = formats.subpixel_bits;
        let rise = lower.y[0] - upper.y[0];
        let down = (first << bits) + (1 << (bits - 1)) - upper.y[0];
        let inverse_rise = T::of(1.0) / T::of(f64::from(rise));
        // A power of two less: exact.
        let inverse = T::of(inverse_rise.value() / f64::from(1 << bits));
        let denominator = rise << bits;
        let x = eyes.map(|eye| {
            let (from, to) = (upper.x[eye as usize], lower.x[eye as usize]);
            let run = i64::from(to - from);
            let divide = |n: i64| divide(n, denominator.into(), inverse.value());
            let half = 1 << (bits - 1);
            // ceil((x - 1/2)) is minus the floor of its negative.
            let (below, rest) =
                divide(i64::from(half - from) * i64::from(rise) - run * i64::from(down));
            let (step, step_rest) = divide(run << bits);
            Crossing {
                cell: -below as i32,
                rest: rest as i32,
                step: step as i32,
                step_rest: step_rest as i32,
            }
        });
        let along = Along {
            start: T::of(f64::from(down)) * inverse_rise,
            row: T::of(f64::from(1 << bits) * inverse_rise.value()),
        };
        Some((Edge { first, end, x, denominator, inverse }, along))
    }

    /// Goes to the next row.
    #[inline]
    pub fn step(&mut self) {
        for x in &mut self.x {
            x.cell += x.step;
            x.rest -= x.step_rest;
            // All ones if the next pixel's centre has been passed.
            let passed = x.rest >> 31;
            x.rest += self.denominator & passed;
            x.cell -= passed;
        }
    }

    /// Distance from the edge to the centre of [`Crossing::cell`] in a view, in pixels.
    #[inline]
    pub fn offset(&self, view: usize) -> T {
        T::of(f64::from(self.x[view].rest)) * self.inverse
    }
}

/// Floor and rest of n/d, with 1/d known to the precision of a double. Quotients are below 2^22
/// and d below 2^30, so that the product is on the right side of every whole number but the exact
/// quotient, which the correction covers.
#[inline]
fn divide(n: i64, d: i64, inverse: f64) -> (i64, i64) {
    let quotient = (n as f64 * inverse) as i64;
    let rest = n - quotient * d;
    match rest {
        _ if rest < 0 => (quotient - 1, rest + d),
        _ if rest >= d => (quotient + 1, rest - d),
        _ => (quotient, rest),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    #[test]
    fn quotients_are_exact() {
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..1_000_000 {
            let d = random.i64(1..1 << random.u32(1..30));
            let n = if random.bool() {
                random.i64(-1 << 20..1 << 20) * d
            } else {
                random.i64(-1 << 43..1 << 43)
            };
            if (n / d).abs() < 1 << 22 {
                let n = n + random.i64(-1..=1);
                assert_eq!(divide(n, d, 1.0 / d as f64), (n.div_euclid(d), n.rem_euclid(d)));
            }
        }
    }

    /// Against the definition: x on each centre line as a fraction.
    #[test]
    fn crossings_are_exact() {
        let formats = Formats::new(&Config::DEFAULT);
        let mut random = fastrand::Rng::with_seed(4);
        for _ in 0..20_000 {
            let mut vertex = |half: bool| {
                let mut n =
                    || if half { 128 * random.i32(-40..400) } else { random.i32(-5000..50_000) };
                let y = n();
                Vertex { x: [n(), n()], y: [y; 2], ..Vertex::default() }
            };
            let half = vertex(false).x[0] % 2 == 0;
            let (a, b) = (vertex(half), vertex(half));
            let (upper, lower) = if a.y[0] <= b.y[0] { (a, b) } else { (b, a) };
            let Some((mut edge, along)) =
                Edge::<f64, 2>::new(&upper, &lower, Eye::BOTH, 0, &formats)
            else {
                continue;
            };
            let rise = i64::from(lower.y[0] - upper.y[0]);
            for row in edge.first..edge.end {
                let line = i64::from(256 * row + 128);
                assert!(i64::from(upper.y[0]) <= line && line < i64::from(lower.y[0]));
                for eye in [0, 1] {
                    let run = i64::from(lower.x[eye] - upper.x[eye]);
                    // x·rise, and the centre of the cell.
                    let x = i64::from(upper.x[eye]) * rise + run * (line - i64::from(upper.y[0]));
                    let centre = i64::from(256 * edge.x[eye].cell + 128) * rise;
                    assert!(x <= centre && centre - 256 * rise < x);
                    let offset = (centre - x) as f64 / (256 * rise) as f64;
                    assert!((edge.offset(eye) - offset).abs() < 1e-12);
                }
                let part = (line - i64::from(upper.y[0])) as f64 / rise as f64;
                assert!(
                    (along.start + along.row * f64::from(row - edge.first) - part).abs() < 1e-12
                );
                edge.step();
            }
        }
    }
}
