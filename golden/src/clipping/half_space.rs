//! Convex polygons cut by a half space, whatever their corners carry. The guard band's and the near plane's
//! clipping: Sutherland and Hodgman's, "Reentrant Polygon Clipping", 1974, against one plane; the corner on
//! it is p + t (q − p), t = d(p)/(d(p) − d(q)). None of the five publications describes it.

use crate::work::Real;

/// The part of a convex polygon at which `distance` is not negative; empty if there is none.
///
/// `towards(a, b, t)` is the corner t of the way from a to b. The corner on a cut edge is computed
/// from the inner end, whichever way the edge is followed: polygons that share an edge share the
/// new corner too.
pub fn cut<C: Copy, T: Real>(
    polygon: &[C],
    distance: impl Fn(&C) -> T,
    towards: impl Fn(&C, &C, T) -> C,
) -> Vec<C> {
    let zero = T::of(0.0);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    let Some(mut previous) = polygon.last() else {
        return kept;
    };
    let mut before = distance(previous);
    for corner in polygon {
        let here = distance(corner);
        if before >= zero && here < zero {
            kept.push(towards(previous, corner, before / (before - here)));
        } else if before < zero && here >= zero {
            kept.push(towards(corner, previous, here / (here - before)));
        }
        if here >= zero {
            kept.push(*corner);
        }
        (previous, before) = (corner, here);
    }
    if kept.len() < 3 {
        kept.clear();
    }
    kept
}
