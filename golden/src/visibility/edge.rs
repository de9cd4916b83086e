//! Edges followed from scan line to scan line, for one view or for two that share their rows.
//!
//! Coverage is that of the half-open rule of [`crate::direct`], although x is stepped in fixed
//! point. In pixels, x at the centre line of a row is a fraction whose denominator, the edge's
//! height in subpixels times the subpixels of a pixel, is at most 2^28. So it either is at a
//! pixel's centre or at least 2^-28 away from it. With 42 fraction bits the errors of start and
//! slope add up to less than 2^-30 over 2048 rows, and half-way between there is the decision.

use crate::formats::{Eye, Formats};
use crate::setup::Vertex;
use crate::work::Real;

/// Fraction bits of x.
const FRACTION: u32 = 42;
/// One pixel.
const ONE: i64 = 1 << FRACTION;
/// Half the least distance of an edge from a centre that it does not pass through.
const MARGIN: i64 = 1 << (FRACTION - 29);

/// An edge between two corners on the rows whose centre lines it crosses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge<const EYES: usize> {
    /// The first row.
    pub first: i32,
    /// The row after the last one.
    pub end: i32,
    /// In each view, x on the current row, counted from the centre of pixel 0, less [`MARGIN`].
    x: [i64; EYES],
    slope: [i64; EYES],
}

/// Position of an edge on its first row, for values interpolated along it.
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

impl<const EYES: usize> Edge<EYES> {
    /// The edge from an upper to a lower corner, on its first row from row `top` on; none if it
    /// crosses no row there. What the views share is computed once: rows are those of the first one.
    #[inline]
    pub fn new<T: Real>(
        upper: &Vertex,
        lower: &Vertex,
        eyes: [Eye; EYES],
        top: i32,
        formats: &Formats,
    ) -> Option<(Edge<EYES>, Along<T>)> {
        let [upper_y, lower_y] = [upper, lower].map(|v| v.y[eyes[0] as usize]);
        let first = row_below(upper_y, formats).max(top);
        let end = row_below(lower_y, formats);
        if first >= end {
            return None;
        }
        let bits = formats.subpixel_bits;
        let half = 1 << (bits - 1);
        let rise = lower_y - upper_y;
        let down = (first << bits) + half - upper_y;
        let inverse = T::of(1.0) / T::of(f64::from(rise));
        // The part of the way is exact, or off by less than 2^-52.
        let row_scale = inverse.value() * ONE as f64;
        let scale = row_scale / f64::from(1 << bits);
        let (mut x, mut slope) = ([0; EYES], [0; EYES]);
        for (view, eye) in eyes.into_iter().enumerate() {
            let (from, to) = (upper.x[eye as usize], lower.x[eye as usize]);
            let run = i64::from(to - from);
            let travel = i64::from(from - half) * i64::from(rise) + run * i64::from(down);
            x[view] = (travel as f64 * scale) as i64 - MARGIN;
            slope[view] = (run as f64 * row_scale) as i64;
        }
        let along = Along {
            start: T::of(f64::from(down)) * inverse,
            row: T::of(f64::from(1 << bits) * inverse.value()),
        };
        Some((Edge { first, end, x, slope }, along))
    }

    /// Goes to the next row.
    #[inline]
    pub fn step(&mut self) {
        for (x, slope) in self.x.iter_mut().zip(self.slope) {
            *x += slope;
        }
    }

    /// The first pixel in a view whose centre is not left of the edge.
    #[inline]
    pub fn cell(&self, view: usize) -> i32 {
        (self.x[view] >> FRACTION) as i32 + 1
    }

    /// Distance in a view from the edge to the centre of a pixel, in pixels, to 2^-29.
    #[inline]
    pub fn offset<T: Real>(&self, view: usize, column: i32) -> T {
        let distance = (i64::from(column) << FRACTION) - (self.x[view] + MARGIN);
        T::of(distance as f64 * (1.0 / ONE as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    /// Against the definition: x on each centre line as a fraction.
    #[test]
    fn crossings_are_exact() {
        let formats = Formats::new(&Config::DEFAULT);
        let mut random = fastrand::Rng::with_seed(4);
        let mut on_centres = 0;
        for n in 0..30_000 {
            // Halves of pixels, anywhere near, and as far as coordinates go.
            let mut coordinate = || match n % 3 {
                0 => 128 * random.i32(-40..400),
                1 => random.i32(-5_000..50_000),
                _ => random.i32(-(1 << 18)..3 << 18),
            };
            let mut vertex = || {
                let y = coordinate();
                Vertex { x: [coordinate(), coordinate()], y: [y; 2], ..Vertex::default() }
            };
            let (a, b) = (vertex(), vertex());
            let (upper, lower) = if a.y[0] <= b.y[0] { (a, b) } else { (b, a) };
            let made = Edge::<2>::new::<f64>(&upper, &lower, Eye::BOTH, 0, &formats);
            let Some((mut edge, along)) = made else { continue };
            let rise = i64::from(lower.y[0] - upper.y[0]);
            for row in edge.first..edge.end.min(2048) {
                let line = i64::from(256 * row + 128);
                assert!(i64::from(upper.y[0]) <= line && line < i64::from(lower.y[0]));
                for eye in [0, 1] {
                    let run = i64::from(lower.x[eye] - upper.x[eye]);
                    // x·rise, and the same of the centre of the cell.
                    let x = i64::from(upper.x[eye]) * rise + run * (line - i64::from(upper.y[0]));
                    let cell = edge.cell(eye);
                    let centre = (256 * i64::from(cell) + 128) * rise;
                    assert!(x <= centre && centre - 256 * rise < x, "{upper:?} {lower:?} {row}");
                    on_centres += i32::from(x == centre);
                    let offset = (centre - x) as f64 / (256 * rise) as f64;
                    assert!((edge.offset::<f64>(eye, cell) - offset).abs() < 1e-8);
                }
                let part = (line - i64::from(upper.y[0])) as f64 / rise as f64;
                let along = along.start + along.row * f64::from(row - edge.first);
                assert!((along - part).abs() < 1e-12);
                edge.step();
            }
        }
        assert!(on_centres > 1000, "only {on_centres} crossings at centres");
    }

    /// n with n·a = 1 modulo m, by Euclid's algorithm.
    fn inverse(a: i64, m: i64) -> Option<i64> {
        let (mut rest, mut factor) = ((m, a.rem_euclid(m)), (0, 1));
        while rest.1 != 0 {
            let quotient = rest.0 / rest.1;
            rest = (rest.1, rest.0 - quotient * rest.1);
            factor = (factor.1, factor.0 - quotient * factor.1);
        }
        (rest.0 == 1).then(|| factor.0.rem_euclid(m))
    }

    /// Crossings that miss a centre by the least possible, 1/(256·rise), on either side, and one
    /// that does not miss it.
    #[test]
    fn near_misses_are_told_apart() {
        let formats = Formats::new(&Config::DEFAULT);
        let mut checked = 0;
        for rise in [(1 << 20) - 1, (1 << 20) - 3, 786_431, 524_289] {
            for row in [0, 1, 2, 3, 500, 1000, 1500, 2046, 2047] {
                for miss in [-1, 0, 1] {
                    // start·rise + run·down = miss modulo 256·rise, where down is 128·(2·row + 1).
                    let start = -miss * inverse(-rise, 128).expect("rise is odd");
                    let Some(odd) = inverse(2 * row + 1, 2 * rise) else { continue };
                    let run = ((miss - start * rise) / 128 * odd).rem_euclid(2 * rise);
                    let run = if run > rise { run - 2 * rise } else { run };
                    let corner = |x: i64, y: i64| {
                        let (x, y) = (x as i32 + 128, y as i32);
                        Vertex { x: [x; 2], y: [y; 2], ..Vertex::default() }
                    };
                    let (upper, lower) = (corner(start, 0), corner(start + run, rise));
                    let made = Edge::<1>::new::<f64>(&upper, &lower, [Eye::Left], 0, &formats);
                    let (mut edge, _) = made.expect("it crosses rows");
                    (0..row).for_each(|_| edge.step());
                    let travel = start * rise + run * (256 * row + 128);
                    assert_eq!((travel - miss).rem_euclid(256 * rise), 0);
                    let cell = -((-travel).div_euclid(256 * rise));
                    assert_eq!(i64::from(edge.cell(0)), cell, "{rise} {row} {miss}");
                    checked += 1;
                }
            }
        }
        assert!(checked > 60, "{checked}");
    }
}
