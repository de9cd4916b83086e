//! Gouraud shading of a polygon in one view, or in both at once.
//!
//! Adelson et al. 1991, "Rendering Polygons". Along an edge x and the values are interpolated, the
//! values once for all views: they depend on y alone. The first and the last pixel of a span, its
//! edge pixels, take the values of the edges; those between are interpolated for each view. With E
//! edge pixels and I interior ones in each view, and three values, this makes 2(4E + 3I)
//! interpolations separately and 5E + 6I together.

use super::edges::{Corner, Edges, Span, VALUE_BITS};
use crate::work::Meter;
use std::ops::Range;

/// Calls `ramp(view, y, ramp)` for the rows of a polygon, from the top. 4E + 3I interpolations for one
/// view, 5E + 6I for two (Adelson et al. 1991, "Rendering Polygons").
pub fn shade<const VIEWS: usize, const VALUES: usize>(
    edges: &mut Edges<VIEWS, VALUES>,
    polygon: &[Corner<VIEWS, VALUES>],
    meter: &mut impl Meter,
    mut ramp: impl FnMut(usize, usize, Ramp<VALUES>),
) {
    let width = edges.width();
    edges.scan(polygon, meter, |meter, span| {
        let [left, right] = span.columns;
        let [start, end] = [left.max(0), right.min(width)];
        if start >= end {
            return;
        }
        meter.note(|work| {
            let interior = (end.min(right - 1) - start.max(left + 1)).max(0);
            work.interpolations += interior as u64 * VALUES as u64;
            work.pixels_written += (end - start) as u64;
        });
        ramp(span.view, span.y, Ramp::new(&span, start..end));
    });
}

/// The pixels of a polygon in one row of a view.
#[derive(Clone, Debug)]
pub struct Ramp<const VALUES: usize> {
    /// Columns whose values are interpolated from the first one.
    interpolated: Range<i32>,
    /// Values of the first one and their change for one pixel.
    values: [i64; VALUES],
    slopes: [i64; VALUES],
    /// Values of the column that follows, at the right edge, unless it lies outside the window.
    last: Option<[i64; VALUES]>,
}

impl<const VALUES: usize> Ramp<VALUES> {
    #[inline]
    fn new(span: &Span<VALUES>, window: Range<i32>) -> Ramp<VALUES> {
        let [left, right] = span.columns;
        let [mut values, mut last] = span.values.map(|values| *values);
        let steps = i64::from((right - left - 1).max(1));
        let changes: [i64; VALUES] = core::array::from_fn(|k| last[k] - values[k]);
        if window.start > left {
            let skipped = i64::from(window.start - left);
            for (value, change) in values.iter_mut().zip(changes) {
                *value += (change * skipped).div_euclid(steps);
            }
        }
        if right - left == 1 {
            // The only pixel is the left edge's.
            last = values;
        }
        Ramp {
            interpolated: window.start..window.end.min(right - 1),
            values,
            slopes: changes.map(|change| change.div_euclid(steps)),
            last: (window.end == right).then_some(last),
        }
    }

    /// Calls `pixel(x, values)` for the pixels from left to right.
    #[inline]
    pub fn for_each(mut self, mut pixel: impl FnMut(usize, [i32; VALUES])) {
        let whole = |value: i64| (value >> VALUE_BITS) as i32;
        let last = self.interpolated.end;
        for x in self.interpolated {
            pixel(x as usize, self.values.map(whole));
            for (value, slope) in self.values.iter_mut().zip(self.slopes) {
                *value += slope;
            }
        }
        if let Some(values) = self.last {
            pixel(last as usize, values.map(whole));
        }
    }
}
