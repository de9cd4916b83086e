//! Polygons cut by a window: Liang & Barsky 1983, "An Analysis and Algorithm for Polygon Clipping".
//!
//! The line through an edge enters the strip between the left and the right border and the one
//! between the top and the bottom border, and leaves them. The order decides what the edge adds to
//! the outline: its part within the window if it is in both strips at once, and a *turning vertex*,
//! a corner of the window, where it goes from one region beside the window to the next.
//!
//! The strip in y is common to the views: 6 intersections instead of twice 4. Their order is not,
//! since it depends on x (Adelson et al. 1991, "Line and Polygon Clipping").

use super::{Point, Window};
use crate::work::{Meter, Real};

/// One coordinate of an edge, and the borders it meets first and last.
#[derive(Clone, Copy, Debug)]
struct Axis<T> {
    from: T,
    delta: T,
    first: T,
    last: T,
    /// True if the coordinate changes along the edge.
    moves: bool,
    /// Parameter at which the edge meets the first border; minus infinity if it does not move.
    enter: T,
}

impl<T: Real> Axis<T> {
    #[inline]
    fn new(from: T, to: T, [low, high]: [T; 2], meter: &mut impl Meter) -> Axis<T> {
        meter.note(|work| work.boundary_clips += 1);
        let delta = to - from;
        let zero = T::of(0.0);
        let moves = delta != zero;
        // An edge that does not move lies beyond the border it is said to meet last.
        let forward = if moves { delta > zero } else { from > high };
        let [first, last] = if forward { [low, high] } else { [high, low] };
        let enter = if moves { (first - from) / delta } else { T::of(f64::NEG_INFINITY) };
        Axis { from, delta, first, last, moves, enter }
    }

    /// Parameter at which the edge meets the last border. If it does not move: plus infinity
    /// within the strip, minus infinity outside.
    #[inline]
    fn leave(&self, [low, high]: [T; 2], meter: &mut impl Meter) -> T {
        meter.note(|work| work.boundary_clips += 1);
        if self.moves {
            (self.last - self.from) / self.delta
        } else if low <= self.from && self.from <= high {
            T::of(f64::INFINITY)
        } else {
            T::of(f64::NEG_INFINITY)
        }
    }

    #[inline]
    fn at(&self, t: T) -> T {
        self.from + t * self.delta
    }
}

/// Adds to `clipped`, one outline for each view, what of a polygon lies within the window.
///
/// The polygon may be concave: round every point inside the window the result winds as often as
/// the polygon does. Parts that are apart stay connected along the border, and what lies outside
/// may leave corners without area on it.
#[inline]
pub fn clip<T: Real, const VIEWS: usize>(
    polygon: &[Point<T, VIEWS>],
    window: &Window<T>,
    meter: &mut impl Meter,
    clipped: &mut [Vec<[T; 2]>; VIEWS],
) {
    let Some(mut from) = polygon.last() else { return };
    for to in polygon {
        let y = Axis::new(from.y, to.y, window.y, meter);
        let mut leave_y = None;
        for (view, outline) in clipped.iter_mut().enumerate() {
            let x = Axis::new(from.x[view], to.x[view], window.x, meter);
            let end = [to.x[view], to.y];
            edge([&x, &y], end, window, &mut leave_y, meter, outline);
        }
        from = to;
    }
}

/// Adds what one edge contributes to the outline in one view.
#[inline]
fn edge<T: Real>(
    [x, y]: [&Axis<T>; 2],
    end: [T; 2],
    window: &Window<T>,
    leave_y: &mut Option<T>,
    meter: &mut impl Meter,
    outline: &mut Vec<[T; 2]>,
) {
    let (zero, one) = (T::of(0.0), T::of(1.0));
    let x_is_later = x.enter > y.enter;
    let [earlier, later] = if x_is_later { [y.enter, x.enter] } else { [x.enter, y.enter] };
    if earlier > one {
        return;
    }
    if earlier > zero {
        outline.push([x.first, y.first]);
    }
    if later > one {
        return;
    }
    let leave_x = x.leave(window.x, meter);
    let leave_y = *leave_y.get_or_insert_with(|| y.leave(window.y, meter));
    let x_is_left = leave_x < leave_y;
    let leave = if x_is_left { leave_x } else { leave_y };
    if !(later > zero || leave > zero) {
        return;
    }
    if later > leave {
        // Never in both strips at once.
        outline.push(if x_is_later { [x.first, y.last] } else { [x.last, y.first] });
        return;
    }
    if later > zero {
        outline.push(if x_is_later { [x.first, y.at(later)] } else { [x.at(later), y.first] });
    }
    outline.push(if leave < one {
        if x_is_left {
            [x.last, y.at(leave)]
        } else {
            [x.at(leave), y.last]
        }
    } else {
        end
    });
}
