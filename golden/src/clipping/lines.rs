//! Lines cut by a window: Liang & Barsky 1984, "A New Concept and Method for Line Clipping".

use super::{Point, Window};
use crate::work::{Meter, Real};

/// A line in one view, from one point to another: `[x, y]` each.
pub type Line<T> = [[T; 2]; 2];

/// The part of a line from parameter `enter` to `leave`: 0 at its first point, 1 at its last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<T> {
    pub enter: T,
    pub leave: T,
}

impl<T: Real> Part<T> {
    /// The whole line.
    pub fn whole() -> Part<T> {
        Part { enter: T::of(0.0), leave: T::of(1.0) }
    }

    /// Leaves what is inside a boundary, where `outward`·t <= `inside`; false if nothing is.
    ///
    /// `outward`: how far the line runs towards the outside; `inside`: how far within the boundary
    /// it begins.
    #[inline]
    pub fn cut(&mut self, outward: T, inside: T, meter: &mut impl Meter) -> bool {
        meter.note(|work| work.boundary_clips += 1);
        let zero = T::of(0.0);
        if outward < zero {
            let t = inside / outward;
            if t > self.leave {
                return false;
            }
            if t > self.enter {
                self.enter = t;
            }
        } else if outward > zero {
            let t = inside / outward;
            if t < self.enter {
                return false;
            }
            if t < self.leave {
                self.leave = t;
            }
        } else {
            return inside >= zero;
        }
        true
    }

    /// Cuts at both ends of a range of one coordinate.
    #[inline]
    fn cut_range(&mut self, from: T, delta: T, range: [T; 2], meter: &mut impl Meter) -> bool {
        self.cut(-delta, from - range[0], meter) && self.cut(delta, range[1] - from, meter)
    }
}

/// The parts of a line within the window, one for each view; none where it lies outside.
///
/// Ends that are not cut keep their coordinates; others lie on the border but for rounding.
#[inline]
pub fn clip<T: Real, const VIEWS: usize>(
    line: &[Point<T, VIEWS>; 2],
    window: &Window<T>,
    meter: &mut impl Meter,
) -> [Option<Line<T>>; VIEWS] {
    let [from, to] = line;
    let dy = to.y - from.y;
    let mut common = Part::whole();
    if !common.cut_range(from.y, dy, window.y, meter) {
        return [None; VIEWS];
    }
    core::array::from_fn(|view| {
        let [from_x, to_x] = [from.x[view], to.x[view]];
        let dx = to_x - from_x;
        let mut part = common;
        if !part.cut_range(from_x, dx, window.x, meter) {
            return None;
        }
        let at = |t: T| [from_x + t * dx, from.y + t * dy];
        let first = if part.enter > T::of(0.0) { at(part.enter) } else { [from_x, from.y] };
        let last = if part.leave < T::of(1.0) { at(part.leave) } else { [to_x, to.y] };
        Some([first, last])
    })
}
