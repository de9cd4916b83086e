//! Scan-line fill of a polygon in one view, or in both at once.
//!
//! Adelson et al. 1991, "Rendering Polygons": the upkeep of the active edges is shared, x and
//! spans are not.

use super::edges::{Corner, Edges};
use crate::work::Meter;
use std::ops::Range;

/// Calls `span(view, y, columns)` for the pixels of a polygon, rows from the top.
pub fn fill<const VIEWS: usize>(
    edges: &mut Edges<VIEWS, 0>,
    polygon: &[Corner<VIEWS, 0>],
    meter: &mut impl Meter,
    mut span: impl FnMut(usize, usize, Range<usize>),
) {
    let width = edges.width();
    edges.scan(polygon, meter, |meter, row| {
        let [left, right] = [row.columns[0].max(0), row.columns[1].min(width)];
        if left < right {
            meter.note(|work| work.pixels_written += (right - left) as u64);
            span(row.view, row.y, left as usize..right as usize);
        }
    });
}
