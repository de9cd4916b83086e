//! Which pixels of a scan line are visited.

use super::edge::{Edge, Outline};
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

    /// Whether no corner lies outside columns 0 to width - 1.
    pub fn is_within(&self, width: u32) -> bool {
        let right = i64::from(width) << self.formats.subpixel_bits;
        self.bounds[0][0] >= 0 && self.bounds[1][0] <= right
    }

    /// Whether no corner lies outside rows 0 to height - 1.
    pub fn has_rows_within(&self, height: u32) -> bool {
        let bottom = i64::from(height) << self.formats.subpixel_bits;
        self.bounds[0][1] >= 0 && self.bounds[1][1] <= bottom
    }

    /// Scan lines whose centre line meets the polygon, or with anti-aliasing any line of samples.
    fn lines(&self, height: u32) -> core::ops::Range<i64> {
        let pixel = self.formats.one_pixel();
        let [[_, top], [_, bottom]] = self.bounds;
        let reach = if self.formats.mask_bits > 1 { 7 * pixel / 8 } else { pixel / 2 };
        let first = (top - reach + pixel - 1).div_euclid(pixel);
        let end = (bottom - (pixel - reach) + pixel - 1).div_euclid(pixel);
        // A line that only touches the lowest corner covers nothing.
        first.max(0)..end.min(height.into())
    }

    /// From floor(xl - 1/2) to ceil(xr - 1/2), with [xl, xr] the span on the centre line; with
    /// anti-aliasing the span of the band of samples.
    fn extended(&self, y: i64) -> [i64; 2] {
        let pixel = self.formats.one_pixel();
        let reach = if self.formats.mask_bits > 1 { 3 * pixel / 8 } else { 0 };
        let centre = y * pixel + pixel / 2;
        let [[left, _], [right, _]] = self.bounds;
        let mut first = (left - pixel / 2).div_euclid(pixel);
        let mut last = -((pixel / 2 - right).div_euclid(pixel));
        for edge in self.edges() {
            let line = centre + if edge.b > 0 { reach } else { -reach };
            match edge.a.signum() {
                1 => first = first.max(edge.floor_left(line, &self.formats)),
                -1 => last = last.min(edge.ceil_right(line, &self.formats)),
                _ => {}
            }
        }
        [first, last]
    }

    /// Pixels whose centre is covered on row y, as first and last.
    fn covered(&self, y: i64) -> [i64; 2] {
        let mut span = [i64::from(i32::MIN), i64::from(i32::MAX)];
        for edge in self.edges() {
            let at_zero = edge.value().at(0, y);
            match edge.a.signum() {
                1 => span[0] = span[0].max(-at_zero.div_euclid(edge.a)),
                -1 => span[1] = span[1].min(at_zero.div_euclid(-edge.a)),
                _ if at_zero < 0 => return [0, -1],
                _ => {}
            }
        }
        span
    }

    /// Rows of a polygon drawn for one eye: the covered pixels inside the window, with
    /// anti-aliasing those that may be touched.
    pub fn monocular_rows(&self, width: u32, height: u32) -> impl Iterator<Item = Row> + '_ {
        let antialias = self.formats.mask_bits > 1;
        self.lines(height).filter_map(move |y| {
            let [first, last] = if antialias { self.extended(y) } else { self.covered(y) };
            Row::new(y, first.max(0), last.min(i64::from(width) - 1))
        })
    }

    /// Rows of the extended span, widened on both sides and cut to `window(y)`.
    pub fn extended_rows(
        &self,
        height: u32,
        widening: i64,
        window: impl Fn(i64) -> [i64; 2],
    ) -> Vec<Row> {
        let row = |y| {
            let [first, last] = self.extended(y);
            let [left, right] = window(y);
            Row::new(y, (first - widening).max(left), (last + widening).min(right))
        };
        self.lines(height).filter_map(row).collect()
    }
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
