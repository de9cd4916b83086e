//! The edges of a polygon that cross a scan line, in one view or in several at once.
//!
//! A row's crossings follow from its centre line, and pixel i belongs to the polygon between two
//! of them where ceil(left − 1/2) <= i < ceil(right − 1/2): the top-left rule, exactly, for the
//! position is stepped from row to row as quotient and remainder. Polygons may be concave; the
//! inside is what an odd number of edges encloses.
//!
//! The views share the rows, so they share the table of edges, its order, the list of active
//! edges, and the values interpolated along them, which depend on y alone. Each has its own x.

use crate::work::Meter;

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

/// Where an edge crosses the centre lines of rows: the first column whose centre is not left of
/// it, ceil(x − 1/2), and what was added to get there.
#[derive(Clone, Copy, Debug)]
struct Walk {
    column: i64,
    /// column − (x − 1/2), times `whole`: from 0 to `whole` − 1.
    excess: i64,
    whole: i64,
    /// Columns a row, rounded down, and what this leaves, times `whole`.
    step: i64,
    rest: i64,
}

impl Walk {
    /// An edge that rises by `rise` > 0 and runs by `run` subpixels from x, at `below` subpixels
    /// under its upper end.
    fn new(x: i64, run: i64, rise: i64, below: i64, bits: u32) -> Walk {
        let whole = rise << bits;
        let position = (x - (1 << (bits - 1))) * rise + run * below;
        let left = (-position).div_euclid(whole);
        Walk {
            column: -left,
            excess: -position - left * whole,
            whole,
            step: run.div_euclid(rise),
            rest: run.rem_euclid(rise) << bits,
        }
    }

    #[inline]
    fn next(&mut self) {
        self.column += self.step;
        self.excess -= self.rest;
        if self.excess < 0 {
            self.column += 1;
            self.excess += self.whole;
        }
    }
}

/// An edge, from the first to before the last row whose centre line it crosses.
#[derive(Clone, Copy, Debug)]
struct Edge<const VIEWS: usize, const VALUES: usize> {
    end: i64,
    walks: [Walk; VIEWS],
    values: [i64; VALUES],
    slopes: [i64; VALUES],
}

impl<const VIEWS: usize, const VALUES: usize> Edge<VIEWS, VALUES> {
    #[inline]
    fn next(&mut self) {
        self.walks.iter_mut().for_each(Walk::next);
        for (value, slope) in self.values.iter_mut().zip(self.slopes) {
            *value += slope;
        }
    }
}

/// Where a row of a view is inside: from column `left.0` to before `right.0`, with the values of
/// the edges there, 16 fraction bits, half a unit added.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span<'a, const VALUES: usize> {
    pub view: usize,
    pub y: i64,
    pub columns: [i64; 2],
    pub values: [&'a [i64; VALUES]; 2],
}

/// The tables of scan conversion, kept from polygon to polygon.
#[derive(Clone, Debug)]
pub struct Edges<const VIEWS: usize, const VALUES: usize> {
    /// Width and height of each view in pixels.
    size: [i64; 2],
    bits: u32,
    /// First row of each edge and its place in `edges`, sorted.
    order: Vec<(i64, usize)>,
    edges: Vec<Edge<VIEWS, VALUES>>,
    active: Vec<Edge<VIEWS, VALUES>>,
    /// Column and place in `active` of the crossings of a row, sorted by column.
    crossings: Vec<(i64, usize)>,
}

impl<const VIEWS: usize, const VALUES: usize> Edges<VIEWS, VALUES> {
    /// Tables for views of this size in pixels, and corners with this many subpixel bits (1 to 8).
    pub fn new(size: [u32; 2], subpixel_bits: u32) -> Self {
        Edges {
            size: size.map(i64::from),
            bits: subpixel_bits,
            order: Vec::new(),
            edges: Vec::new(),
            active: Vec::new(),
            crossings: Vec::new(),
        }
    }

    /// Width of each view in pixels.
    pub(super) fn width(&self) -> i64 {
        self.size[0]
    }

    /// Calls `span` for the inside of every row of every view, rows from the top.
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
        let mut next = 0;
        let mut y = 0;
        self.active.clear();
        while next < self.order.len() || !self.active.is_empty() {
            if self.active.is_empty() {
                y = self.order[next].0;
            }
            while let Some(&(_, edge)) = self.order.get(next).filter(|edge| edge.0 == y) {
                self.active.push(self.edges[edge]);
                next += 1;
            }
            meter.note(|work| {
                let active = self.active.len() as u64;
                work.edge_updates += active;
                work.interpolations += active * (VIEWS + VALUES) as u64;
            });
            for view in 0..VIEWS {
                self.row(view, y, |s| span(meter, s));
            }
            y += 1;
            self.active.retain(|edge| edge.end > y);
            self.active.iter_mut().for_each(Edge::next);
        }
    }

    /// The spans of one row of one view.
    #[inline]
    fn row(&mut self, view: usize, y: i64, mut span: impl FnMut(Span<VALUES>)) {
        self.crossings.clear();
        for (index, edge) in self.active.iter().enumerate() {
            let column = edge.walks[view].column;
            self.crossings.push((column, index));
            // There are few, nearly sorted.
            let mut k = index;
            while k > 0 && self.crossings[k - 1].0 > column {
                self.crossings.swap(k - 1, k);
                k -= 1;
            }
        }
        for pair in self.crossings.chunks_exact(2) {
            let values = [0, 1].map(|k: usize| &self.active[pair[k].1].values);
            span(Span { view, y, columns: [pair[0].0, pair[1].0], values });
        }
    }

    /// Makes the edges that cross centre lines within the window.
    fn build(&mut self, corners: &[Corner<VIEWS, VALUES>]) {
        self.order.clear();
        self.edges.clear();
        let Some(mut previous) = corners.last() else { return };
        let half = 1i64 << (self.bits - 1);
        // First row whose centre is not above y.
        let row = |y: i32| (i64::from(y) + half - 1) >> self.bits;
        for corner in corners {
            let ends = if previous.y <= corner.y { [previous, corner] } else { [corner, previous] };
            let [first, end] = ends.map(|corner| row(corner.y));
            let [first, end] = [first.max(0), end.min(self.size[1])];
            if first < end {
                self.order.push((first, self.edges.len()));
                self.edges.push(self.edge(ends, [first, end]));
            }
            previous = corner;
        }
        self.order.sort_unstable();
    }

    fn edge(
        &self,
        [upper, lower]: [&Corner<VIEWS, VALUES>; 2],
        [first, end]: [i64; 2],
    ) -> Edge<VIEWS, VALUES> {
        let rise = i64::from(lower.y) - i64::from(upper.y);
        let below = (first << self.bits) + (1 << (self.bits - 1)) - i64::from(upper.y);
        let walks = core::array::from_fn(|view| {
            let [from, to] = [upper, lower].map(|corner| i64::from(corner.x[view]));
            Walk::new(from, to - from, rise, below, self.bits)
        });
        let slopes = core::array::from_fn(|k| {
            let change = i64::from(lower.values[k]) - i64::from(upper.values[k]);
            (change << (VALUE_BITS + self.bits)).div_euclid(rise)
        });
        let values = core::array::from_fn(|k| {
            let start = (i64::from(upper.values[k]) << VALUE_BITS) + (1 << (VALUE_BITS - 1));
            start + ((slopes[k] * below) >> self.bits)
        });
        Edge { end, walks, values, slopes }
    }
}
