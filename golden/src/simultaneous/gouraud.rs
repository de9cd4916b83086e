//! Gouraud shading of a polygon in one view, or in both at once.
//!
//! Adelson et al. 1991, "Rendering Polygons". Along an edge x and the values are interpolated, the
//! values once for all views: they depend on y alone. The first and the last pixel of a span, its
//! edge pixels, take the values of the edges; those between are interpolated for each view. With E
//! edge pixels and I interior ones in each view, and three values, this makes 2(4E + 3I)
//! interpolations separately and 5E + 6I together.

use super::edges::{Corner, Edges, Span, VALUE_BITS};
use crate::work::Meter;

/// Calls `pixel(view, x, y, values)` for the pixels of a polygon, rows from the top.
pub fn shade<const VIEWS: usize, const VALUES: usize>(
    edges: &mut Edges<VIEWS, VALUES>,
    polygon: &[Corner<VIEWS, VALUES>],
    meter: &mut impl Meter,
    mut pixel: impl FnMut(usize, usize, usize, [i32; VALUES]),
) {
    let width = edges.width();
    edges.scan(polygon, meter, |meter, row| {
        let [left, right] = row.columns;
        let [start, end] = [left.max(0), right.min(width)];
        if start >= end {
            return;
        }
        meter.note(|work| {
            let interior = (end.min(right - 1) - start.max(left + 1)).max(0);
            work.interpolations += interior as u64 * VALUES as u64;
            work.pixels_written += (end - start) as u64;
        });
        let slopes = slopes(&row);
        let mut values: [i64; VALUES] =
            core::array::from_fn(|k| row.values[0][k] + slopes[k] * i64::from(start - left));
        let (view, y) = (row.view, row.y);
        for x in start..end.min(right - 1) {
            pixel(view, x as usize, y, values.map(whole));
            for (value, slope) in values.iter_mut().zip(slopes) {
                *value += slope;
            }
        }
        if end == right {
            // The only pixel of a span is its first.
            let last = row.values[usize::from(right - left > 1)];
            pixel(view, (right - 1) as usize, y, last.map(whole));
        }
    });
}

/// Change of the values for one pixel, between the edge pixels of a span.
fn slopes<const VALUES: usize>(span: &Span<VALUES>) -> [i64; VALUES] {
    let steps = (span.columns[1] - span.columns[0] - 1).max(1);
    core::array::from_fn(|k| (span.values[1][k] - span.values[0][k]).div_euclid(steps.into()))
}

fn whole(value: i64) -> i32 {
    (value >> VALUE_BITS) as i32
}
