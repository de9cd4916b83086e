//! The edges of a polygon that cross a scan line, in one view or in several at once: Adelson et al. 1991,
//! "Rendering Polygons".
//!
//! A row's crossings follow from its centre line, and pixel i belongs to the polygon between two
//! of them where ceil(left − 1/2) <= i < ceil(right − 1/2): the top-left rule, exactly, for the
//! position is stepped from row to row as quotient and remainder. Polygons may be concave; the
//! inside is what an odd number of edges encloses.
//!
//! The views share the rows, so they share the table of edges, its order, the list of active
//! edges, and the values interpolated along them, which depend on y alone. Each has its own x.

use super::walk::{first_centre, Divisor, Walk};
use crate::work::Meter;
use std::ops::Range;

/// Fraction bits of an interpolated value.
pub(super) const VALUE_BITS: u32 = 16;

/// A corner in `VIEWS` views with `VALUES` values to interpolate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner<const VIEWS: usize, const VALUES: usize> {
    /// x in each view, in subpixels, within ±2^28.
    pub x: [i32; VIEWS],
    /// y in all of them, in subpixels, within ±2^28; downward.
    pub y: i32,
    /// The values, of up to 24 bits; common to the views.
    pub values: [i32; VALUES],
}

impl<const VALUES: usize> Corner<2, VALUES> {
    /// The corner as one of two views sees it.
    pub fn view(&self, view: usize) -> Corner<1, VALUES> {
        Corner { x: [self.x[view]], y: self.y, values: self.values }
    }
}

/// An edge that crosses the centre lines of rows.
#[derive(Clone, Copy, Debug)]
struct Edge<const VIEWS: usize, const VALUES: usize> {
    /// The row after the last one.
    end: i32,
    walks: [Walk; VIEWS],
    values: [i64; VALUES],
    slopes: [i64; VALUES],
}

impl<const VIEWS: usize, const VALUES: usize> Edge<VIEWS, VALUES> {
    /// An edge as it crosses row `first`.
    fn new([upper, lower]: [&Corner<VIEWS, VALUES>; 2], [first, end]: [i32; 2], bits: u32) -> Self {
        let rise = Divisor::new(i64::from(lower.y) - i64::from(upper.y));
        let below = (i64::from(first) << bits) + (1 << (bits - 1)) - i64::from(upper.y);
        let walks = core::array::from_fn(|view| {
            let run = i64::from(lower.x[view]) - i64::from(upper.x[view]);
            Walk::new(upper.x[view], run, &rise, below, bits)
        });
        let change = |k: usize| i64::from(lower.values[k]) - i64::from(upper.values[k]);
        let slopes: [[i64; 2]; VALUES] =
            core::array::from_fn(|k| rise.divide(change(k) << (VALUE_BITS + bits)));
        let values = core::array::from_fn(|k| {
            let start = (i64::from(upper.values[k]) << VALUE_BITS) + (1 << (VALUE_BITS - 1));
            let [slope, rest] = slopes[k];
            start + ((slope * below + rise.divide(rest * below)[0]) >> bits)
        });
        Edge { end, walks, values, slopes: slopes.map(|[slope, _]| slope) }
    }
}

/// Inside of a row of a view: from the first column to before the second, with the values of the edges there, 16
/// fraction bits, half a unit added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span<'a, const VALUES: usize> {
    pub view: usize,
    pub y: usize,
    pub columns: [i32; 2],
    pub values: [&'a [i64; VALUES]; 2],
}

/// The tables of scan conversion, kept from polygon to polygon.
#[derive(Clone, Debug)]
pub struct Edges<const VIEWS: usize, const VALUES: usize> {
    /// Width and height of each view in pixels.
    size: [i32; 2],
    bits: u32,
    edges: Vec<Edge<VIEWS, VALUES>>,
    /// First row of each edge and its place in `edges`, sorted.
    order: Vec<(i32, usize)>,
    active: Vec<Edge<VIEWS, VALUES>>,
    /// Values of the active edges, row by row of a run.
    values: Vec<[i64; VALUES]>,
    /// Column and place in `active` of the crossings of a row, sorted by column.
    crossings: Vec<(i32, usize)>,
}

impl<const VIEWS: usize, const VALUES: usize> Edges<VIEWS, VALUES> {
    /// Tables for views of this size in pixels, up to 2^13, and corners with this many subpixel
    /// bits, 1 to 8.
    pub fn new(size: [u32; 2], subpixel_bits: u32) -> Self {
        Edges {
            size: size.map(|n| n as i32),
            bits: subpixel_bits,
            edges: Vec::new(),
            order: Vec::new(),
            active: Vec::new(),
            values: Vec::new(),
            crossings: Vec::new(),
        }
    }

    /// Width of each view in pixels.
    pub(super) fn width(&self) -> i32 {
        self.size[0]
    }

    /// Calls `span` for the inside of every row of every view, rows from the top.
    #[inline]
    pub(super) fn scan<M: Meter>(
        &mut self,
        corners: &[Corner<VIEWS, VALUES>],
        meter: &mut M,
        mut span: impl FnMut(&mut M, Span<VALUES>),
    ) {
        self.build(corners);
        meter.note(|work| {
            work.polygons += VIEWS as u64;
            work.edge_updates += self.order.len() as u64;
        });
        let mut waiting = 0;
        let mut y = 0;
        while waiting < self.order.len() || !self.active.is_empty() {
            if self.active.is_empty() {
                y = self.order[waiting].0;
            }
            while let Some(&(_, edge)) = self.order.get(waiting).filter(|edge| edge.0 == y) {
                self.active.push(self.edges[edge]);
                waiting += 1;
            }
            // The same edges are active until one of them ends or the next one begins.
            let begins = self.order.get(waiting).map_or(i32::MAX, |edge| edge.0);
            let until = self.active.iter().fold(begins, |until, edge| until.min(edge.end));
            meter.note(|work| {
                let crossings = self.active.len() as u64 * (until - y) as u64;
                work.edge_updates += crossings;
                work.interpolations += crossings * (VIEWS + VALUES) as u64;
            });
            self.interpolate(y..until);
            for view in 0..VIEWS {
                self.run(view, y..until, |s| span(meter, s));
            }
            y = until;
            self.active.retain(|edge| edge.end > y);
        }
    }

    /// The values along the active edges.
    #[inline]
    fn interpolate(&mut self, rows: Range<i32>) {
        self.values.clear();
        for _ in rows {
            for edge in &mut self.active {
                self.values.push(edge.values);
                for (value, slope) in edge.values.iter_mut().zip(edge.slopes) {
                    *value += slope;
                }
            }
        }
    }

    /// The spans of one view between the active edges.
    #[inline]
    fn run(&mut self, view: usize, rows: Range<i32>, mut span: impl FnMut(Span<VALUES>)) {
        let bits = self.bits;
        if let [a, b] = &mut self.active[..] {
            let (a, b) = (&mut a.walks[view], &mut b.walks[view]);
            for (y, values) in rows.zip(self.values.chunks_exact(2)) {
                let columns = [a.column(bits), b.column(bits)];
                let order = if columns[0] <= columns[1] { [0, 1] } else { [1, 0] };
                span(Span {
                    view,
                    y: y as usize,
                    columns: order.map(|k: usize| columns[k]),
                    values: order.map(|k| &values[k]),
                });
                a.next();
                b.next();
            }
            return;
        }
        for (y, values) in rows.zip(self.values.chunks_exact(self.active.len())) {
            self.crossings.clear();
            for (index, edge) in self.active.iter_mut().enumerate() {
                let column = edge.walks[view].column(bits);
                edge.walks[view].next();
                self.crossings.push((column, index));
                // There are few, nearly sorted.
                let mut k = index;
                while k > 0 && self.crossings[k - 1].0 > column {
                    self.crossings.swap(k - 1, k);
                    k -= 1;
                }
            }
            for pair in self.crossings.chunks_exact(2) {
                span(Span {
                    view,
                    y: y as usize,
                    columns: [pair[0].0, pair[1].0],
                    values: [&values[pair[0].1], &values[pair[1].1]],
                });
            }
        }
    }

    /// Makes the edges that cross centre lines within the window.
    fn build(&mut self, corners: &[Corner<VIEWS, VALUES>]) {
        self.edges.clear();
        self.order.clear();
        let Some(mut previous) = corners.last() else { return };
        for corner in corners {
            let ends = if previous.y <= corner.y { [previous, corner] } else { [corner, previous] };
            let [first, end] = ends.map(|corner| first_centre(corner.y, self.bits));
            let rows = [first.max(0), end.min(self.size[1])];
            if rows[0] < rows[1] {
                self.order.push((rows[0], self.edges.len()));
                self.edges.push(Edge::new(ends, rows, self.bits));
            }
            previous = corner;
        }
        self.order.sort_unstable();
    }
}
