//! Which pixels of a scan line are visited.

use super::edge::{Edge, Outline, Reach};
use super::polygon::MAX_VERTICES;
use crate::formats::Formats;
use alloc::vec::Vec;

/// The visited pixels of one scan line, `first..=last`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Scan line.
    pub y: i32,
    /// Leftmost visited pixel.
    pub first: i32,
    /// Rightmost visited pixel, not left of `first`.
    pub last: i32,
}

impl Row {
    fn new(y: i64, first: i64, last: i64) -> Option<Row> {
        (first <= last).then_some(Row { y: y as i32, first: first as i32, last: last as i32 })
    }

    /// Number of visited pixels.
    pub fn len(&self) -> u64 {
        (self.last - self.first + 1) as u64
    }

    /// Never true: a row without pixels is not made.
    pub fn is_empty(&self) -> bool {
        false
    }
}

/// A polygon in one view, with what traversal needs to know of it.
#[derive(Clone, Copy, Debug)]
pub struct View {
    edges: [Edge; MAX_VERTICES],
    count: usize,
    bounds: [[i64; 2]; 2],
    formats: Formats,
}

impl View {
    /// The view of an outline that has an area.
    pub fn new(outline: &Outline, formats: &Formats) -> View {
        let mut edges = [Edge::default(); MAX_VERTICES];
        let mut count = 0;
        for edge in outline.edges(formats) {
            edges[count] = edge;
            count += 1;
        }
        View { edges, count, bounds: outline.bounds(), formats: *formats }
    }

    /// The edge functions.
    pub fn edges(&self) -> &[Edge] {
        &self.edges[..self.count]
    }

    /// True if no corner lies outside columns 0 to width - 1.
    pub fn is_within(&self, width: u32) -> bool {
        let right = i64::from(width) << self.formats.subpixel_bits;
        self.bounds[0][0] >= 0 && self.bounds[1][0] <= right
    }

    /// True if no corner lies outside rows 0 to height - 1.
    pub fn has_rows_within(&self, height: u32) -> bool {
        let bottom = i64::from(height) << self.formats.subpixel_bits;
        self.bounds[0][1] >= 0 && self.bounds[1][1] <= bottom
    }

    /// Scan lines whose centre line meets the polygon, or with anti-aliasing any line of samples.
    fn lines(&self, height: u32) -> core::ops::Range<i64> {
        let pixel = self.formats.one_pixel();
        let [[_, top], [_, bottom]] = self.bounds;
        let reach = pixel / 2 + self.formats.sample_reach();
        let first = (top - reach + pixel - 1).div_euclid(pixel);
        let end = (bottom - (pixel - reach) + pixel - 1).div_euclid(pixel);
        // A line that only touches the lowest corner covers nothing.
        first.max(0)..end.min(height.into())
    }

    /// Spans of a polygon drawn for one eye: the covered pixels inside the window, with
    /// anti-aliasing those that may be touched.
    pub fn monocular_spans(&self, width: u32) -> Spans {
        let window = [0, i64::from(width) - 1];
        if self.formats.mask_bits > 1 {
            return Spans { creep: false, ..self.extended_spans(0, 0, window) };
        }
        Spans { reach: Reach::Covered, limits: window, creep: false }
    }

    /// Spans of a polygon drawn for one eye that the secondary pipeline lends edges to.
    pub fn lent_spans(&self, width: u32) -> Spans {
        Spans { creep: true, ..self.monocular_spans(width) }
    }

    /// Extended spans, cut to a window, for a polygon that the secondary pipeline follows; see
    /// [`Reach::Extended`].
    pub fn extended_spans(&self, widening: i64, spared: i64, window: [i64; 2]) -> Spans {
        let pixel = self.formats.one_pixel();
        let [[left, _], [right, _]] = self.bounds;
        let first = (left - pixel / 2).div_euclid(pixel) - widening;
        let last = -((pixel / 2 - right).div_euclid(pixel)) + widening;
        let limits = [first.max(window[0]), last.min(window[1])];
        Spans { reach: Reach::Extended { widening, spared }, limits, creep: true }
    }

    /// The visited pixels of a row between some of the polygon's edges.
    fn between<'a>(
        &self,
        y: i64,
        spans: &Spans,
        edges: impl IntoIterator<Item = &'a Edge>,
    ) -> [i64; 2] {
        let [mut first, mut last] = [i64::from(i32::MIN), i64::from(i32::MAX)];
        for edge in edges {
            let (at_zero, bound) = (edge.value().at(0, y), spans.bound(edge, &self.formats));
            match edge.a.signum() {
                1 => first = first.max((bound - 1 - at_zero).div_euclid(edge.a)),
                -1 => last = last.min((at_zero - bound).div_euclid(-edge.a) + 1),
                _ if spans.reach == Reach::Covered && at_zero < 0 => return [0, -1],
                _ => {}
            }
        }
        // An extended row has a pixel at least: of two neighbours either does for both.
        if spans.reach != Reach::Covered {
            first = first.min(last);
        }
        [first.max(spans.limits[0]), last.min(spans.limits[1])]
    }

    /// The rows that are visited.
    pub fn rows<'a>(&'a self, spans: &'a Spans, height: u32) -> impl Iterator<Item = Row> + 'a {
        self.lines(height).filter_map(move |y| {
            let [first, last] = self.between(y, spans, self.edges());
            Row::new(y, first, last)
        })
    }

    /// First and last of the scan lines that may be visited; none where there are none.
    pub fn first_and_last_line(&self, height: u32) -> Option<[i64; 2]> {
        let lines = self.lines(height);
        (!lines.is_empty()).then_some([lines.start, lines.end - 1])
    }

    /// Cuts rows into runs in which three of the edges have all ends of the spans: those that the
    /// primary pipeline tests. Of a triangle these are always its three.
    pub fn runs<'a>(&'a self, rows: &'a [Row], spans: &'a Spans) -> impl Iterator<Item = Run<'a>> {
        let mut rest = rows;
        core::iter::from_fn(move || {
            let first = rest.first()?;
            let has_ends = |row: &Row, own: &[usize; 3]| {
                let edges = own.iter().map(|&n| &self.edges[n]);
                self.between(row.y.into(), spans, edges) == [row.first, row.last].map(i64::from)
            };
            if self.count == 3 {
                return Some(Run { rows: core::mem::take(&mut rest), own: [0, 1, 2] });
            }
            let mut candidates: Vec<[usize; 3]> =
                self.triples().filter(|own| has_ends(first, own)).collect();
            let mut length = 1;
            while let Some(row) = rest.get(length) {
                let left: Vec<_> =
                    candidates.iter().copied().filter(|own| has_ends(row, own)).collect();
                if left.is_empty() {
                    break;
                }
                candidates = left;
                length += 1;
            }
            let (rows, after) = rest.split_at(length);
            rest = after;
            Some(Run { rows, own: *candidates.first()? })
        })
    }

    /// Every choice of three edges.
    fn triples(&self) -> impl Iterator<Item = [usize; 3]> {
        let count = self.count;
        let pairs = (0..count).flat_map(move |i| (i + 1..count).map(move |j| [i, j]));
        pairs.flat_map(move |[i, j]| (j + 1..count).map(move |k| [i, j, k]))
    }
}

/// Which pixels of its rows a polygon visits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spans {
    /// Extent of the rows.
    pub reach: Reach,
    /// Columns that no row passes: first and last.
    pub limits: [i64; 2],
    /// The row start creeps to where it has to be, with beats that the secondary pipeline follows.
    pub creep: bool,
}

impl Spans {
    /// Exclusive upper bound of an edge function E' on the pixels at the end of a span and beyond.
    pub fn bound(&self, edge: &Edge, formats: &Formats) -> i64 {
        edge.span_bound(self.reach, formats)
    }
}

/// Rows whose ends three edges have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run<'a> {
    /// The rows.
    pub rows: &'a [Row],
    /// Numbers of the edges.
    pub own: [usize; 3],
}

/// A run of rows on which the row start moves by `movement` or one pixel more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part<'a> {
    /// The rows, without a gap.
    pub rows: &'a [Row],
    /// Movement of the row start that a `ROW` beat makes; the rest is crept.
    pub movement: i64,
}

/// Cuts rows into as few parts as a greedy choice gives; `allowed` says whether a movement fits
/// the row registers.
pub fn parts<'a>(
    rows: &'a [Row],
    allowed: impl Fn(i64) -> bool + 'a,
) -> impl Iterator<Item = Part<'a>> + 'a {
    let mut rest = rows;
    core::iter::from_fn(move || {
        rest.first()?;
        let mut range: Option<[i64; 2]> = None;
        let mut length = 1;
        for pair in rest.windows(2) {
            let movement = i64::from(pair[1].first - pair[0].first);
            let [low, high] =
                range.map_or([movement; 2], |[l, h]| [l.min(movement), h.max(movement)]);
            let changed = range.is_none_or(|[l, _]| l != low);
            if pair[1].y != pair[0].y + 1 || high - low > 1 || (changed && !allowed(low)) {
                break;
            }
            range = Some([low, high]);
            length += 1;
        }
        let (rows, after) = rest.split_at(length);
        rest = after;
        Some(Part { rows, movement: range.map_or(0, |[low, _]| low) })
    })
}

/// Beats of rows that a secondary pipeline follows: their pixels and the creeping of row starts.
pub fn beats(rows: &[Row], allowed: impl Fn(i64) -> bool) -> u64 {
    let creeping = |part: Part| -> u64 {
        let moved = part.rows.windows(2).map(|pair| i64::from(pair[1].first - pair[0].first));
        moved.map(|movement| (movement - part.movement) as u64).sum()
    };
    let visited: u64 = rows.iter().map(Row::len).sum();
    visited + parts(rows, allowed).map(creeping).sum::<u64>()
}
