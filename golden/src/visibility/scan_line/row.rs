//! The pixels of one row: which polygon is nearest at each.

use super::table::{Line, Table};
use crate::visibility::NO_ITEM;
use crate::work::{Meter, Real};
use std::ops::Range;

/// Fraction bits of a depth in a row.
const FRACTION: u32 = 7;

/// Pixels after which a depth is computed anew: until then the rounding of its slope adds up to a
/// quarter of a unit at most.
const STRETCH: i32 = 64;

/// The depths of the nearest polygons of a row.
pub(super) struct Depths(Vec<i32>);

impl Depths {
    pub fn new(width: u32) -> Depths {
        Depths(vec![i32::MAX; width as usize])
    }

    /// Finds what a view shows of the active polygons.
    pub fn resolve<T: Real, const EYES: usize, const VALUES: usize>(
        &mut self,
        table: &Table<T, EYES, VALUES>,
        view: usize,
        items: &mut [u32],
        meter: &mut impl Meter,
    ) {
        items.fill(NO_ITEM);
        self.0.fill(i32::MAX);
        for (polygon, span) in table.spans(view) {
            let columns = span.columns.start.max(0)..span.columns.end.min(items.len() as i32);
            if columns.is_empty() {
                continue;
            }
            meter.note(|work| {
                work.interpolations += columns.len() as u64;
                work.depth_tests += columns.len() as u64;
            });
            let depth = span.line(0, span.offset(columns.start));
            self.span(items, columns, depth, polygon);
        }
    }

    /// Compares the depths of a span.
    #[inline]
    fn span<T: Real>(
        &mut self,
        items: &mut [u32],
        columns: Range<i32>,
        depth: Line<T>,
        polygon: u32,
    ) {
        const UNIT: f64 = (1 << FRACTION) as f64;
        let (first, slope) = (depth.first.value() * UNIT, depth.slope.value() * UNIT);
        let mut start = columns.start;
        while start < columns.end {
            let end = columns.end.min(start + STRETCH);
            let from = (first + slope * f64::from(start - columns.start)) as i32;
            let stretch = start as usize..end as usize;
            let depths = &mut self.0[stretch.clone()];
            compare(&mut items[stretch], depths, from, slope as i32, polygon);
            start = end;
        }
    }
}

/// Keeps the nearer of what is there and a polygon. Both are stored, one of them anew, which
/// compilers make vector instructions of.
#[inline]
fn compare(items: &mut [u32], depths: &mut [i32], first: i32, slope: i32, polygon: u32) {
    let mut depth = first;
    for (item, least) in items.iter_mut().zip(depths) {
        let nearer = depth < *least;
        *item = if nearer { polygon } else { *item };
        *least = if nearer { depth } else { *least };
        // Steep depths wrap beyond the end of a short span, where nobody looks.
        depth = depth.wrapping_add(slope);
    }
}

/// What a view shows on a row.
pub struct Seen<'a, T, const EYES: usize, const VALUES: usize> {
    /// The view, counted from 0.
    pub view: usize,
    /// The row.
    pub row: i32,
    /// The polygon at each pixel, or [`NO_ITEM`].
    pub items: &'a [u32],
    pub(super) table: &'a Table<T, EYES, VALUES>,
}

impl<T: Real, const EYES: usize, const VALUES: usize> Seen<'_, T, EYES, VALUES> {
    /// Calls `paint` for each run of pixels that show one polygon, with the values beside depth.
    pub fn runs<const MORE: usize>(
        &self,
        mut paint: impl FnMut(Range<usize>, u32, [Line<T>; MORE]),
    ) {
        let mut start = 0;
        for run in self.items.chunk_by(|a, b| a == b) {
            let columns = start..start + run.len();
            start = columns.end;
            if run[0] != NO_ITEM {
                let span = self.table.span(run[0], self.view);
                let offset = span.offset(columns.start as i32);
                paint(columns, run[0], std::array::from_fn(|k| span.line(k + 1, offset)));
            }
        }
    }
}
