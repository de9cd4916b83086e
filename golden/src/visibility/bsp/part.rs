//! Rectangles of pixels.

use std::ops::Range;

/// A rectangle of pixels.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub columns: Range<i32>,
    pub rows: Range<i32>,
}

impl Part {
    /// True if they have pixels in common.
    pub fn meets(&self, other: &Part) -> bool {
        let meet = |a: &Range<i32>, b: &Range<i32>| a.start < b.end && b.start < a.end;
        meet(&self.columns, &other.columns) && meet(&self.rows, &other.rows)
    }

    /// The smallest part that has both.
    pub fn with(&self, other: &Part) -> Part {
        Part { columns: hull(&self.columns, &other.columns), rows: hull(&self.rows, &other.rows) }
    }
}

/// The smallest range that has both.
pub(super) fn hull(a: &Range<i32>, b: &Range<i32>) -> Range<i32> {
    a.start.min(b.start)..a.end.max(b.end)
}
