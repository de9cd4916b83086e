//! Depths of the nearest polygons, compared span by span: the depth test of the scan line (Adelson et al.
//! 1991, "Scan-line algorithms"). That depth is stepped in integers is no publication's.

use super::scan_line::Line;
use crate::work::Real;

/// Fraction bits of a kept depth.
const FRACTION: u32 = 7;

/// Pixels after which a depth is computed anew: until then the rounding of its slope adds up to a
/// quarter of a unit at most.
const STRETCH: usize = 64;

/// Puts a polygon into the items of a span where it is nearer than what is there. Not inlined, so that
/// one view and both have the same code for pixels.
#[inline(never)]
pub(super) fn keep_nearer<T: Real>(
    items: &mut [u32],
    depths: &mut [i32],
    depth: Line<T>,
    polygon: u32,
) {
    const UNIT: f64 = (1 << FRACTION) as f64;
    let (mut first, slope) = (depth.first.value() * UNIT, depth.slope.value() * UNIT);
    for (items, depths) in items.chunks_mut(STRETCH).zip(depths.chunks_mut(STRETCH)) {
        compare(items, depths, first as i32, slope as i32, polygon);
        first += slope * STRETCH as f64;
    }
}

/// Without a condition, so that compilers make vector instructions of it.
#[inline]
fn compare(items: &mut [u32], depths: &mut [i32], first: i32, slope: i32, polygon: u32) {
    let mut depth = first;
    for (item, least) in items.iter_mut().zip(depths) {
        // All ones where the polygon is nearer.
        let nearer = u32::from(depth < *least).wrapping_neg();
        *item ^= (*item ^ polygon) & nearer;
        *least = depth.min(*least);
        // Steep depths wrap beyond the end of a short span, where nobody looks.
        depth = depth.wrapping_add(slope);
    }
}
