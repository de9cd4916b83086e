//! The pixels of one row: which polygon is nearest at each.

use super::table::{Line, Table};
use crate::cost;
use crate::visibility::depths::keep_nearer;
use crate::visibility::NO_ITEM;
use crate::work::{Meter, Operations, Real};
use std::ops::Range;

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
            // Which of its edges is the left one.
            meter.note(|work| work.fixed_point += Operations::comparisons(1));
            let columns = span.columns.start.max(0)..span.columns.end.min(items.len() as i32);
            if columns.is_empty() {
                continue;
            }
            meter.note(|work| {
                work.interpolations += columns.len() as u64;
                work.pixels_tested += columns.len() as u64;
                work.depth_tests += columns.len() as u64;
                // Also the distance of the first pixel from the edge.
                work.fixed_point += Operations::new(1, 0, 0, 0);
                work.fixed_point += cost::STEP_AND_COMPARE * columns.len() as u64;
            });
            let depth = span.line(0, span.offset(columns.start));
            let columns = columns.start as usize..columns.end as usize;
            keep_nearer(&mut items[columns.clone()], &mut self.0[columns], depth, polygon);
        }
    }
}

/// A row of a view with its visible polygons.
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
    pub fn runs<const MORE: usize>(&self, mut paint: impl FnMut(Range<usize>, [Line<T>; MORE])) {
        let mut start = 0;
        for run in self.items.chunk_by(|a, b| a == b) {
            let columns = start..start + run.len();
            start = columns.end;
            if run[0] != NO_ITEM {
                let span = self.table.span(run[0], self.view);
                let offset = span.offset(columns.start as i32);
                paint(columns, std::array::from_fn(|k| span.line(k + 1, offset)));
            }
        }
    }
}
