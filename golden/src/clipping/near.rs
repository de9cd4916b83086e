//! Lines and polygons cut by the near plane z = `near`, before they are projected: a further boundary for
//! the parameter of Liang and Barsky 1984. Adelson et al. clip in two dimensions only.
//!
//! The plane is parallel to the screen and common to both eyes: one cut serves both views.

use super::half_space;
use super::lines::Part;
use crate::work::{Meter, Real};

/// A point: x right, y up, z away from the viewer.
type Vec3<T> = [T; 3];

/// The part of a line that is not before the near plane.
pub fn clip_line<T: Real>(
    [from, to]: [Vec3<T>; 2],
    near: T,
    meter: &mut impl Meter,
) -> Option<[Vec3<T>; 2]> {
    let mut part = Part::whole();
    if !part.cut(from[2] - to[2], from[2] - near, meter) {
        return None;
    }
    let at = |t: T| {
        let [x, y, _] = mix(&from, &to, t);
        [x, y, near]
    };
    let first = if part.enter > T::of(0.0) { at(part.enter) } else { from };
    let last = if part.leave < T::of(1.0) { at(part.leave) } else { to };
    Some([first, last])
}

/// The part of a convex polygon that is not before the near plane; empty if all of it is.
pub fn clip_polygon<T: Real>(polygon: &[Vec3<T>], near: T, meter: &mut impl Meter) -> Vec<Vec3<T>> {
    meter.note(|work| work.boundary_clips += polygon.len() as u64);
    half_space::cut(
        polygon,
        |point| point[2] - near,
        |from, to, t| {
            let [x, y, _] = mix(from, to, t);
            [x, y, near]
        },
    )
}

fn mix<T: Real>(from: &Vec3<T>, to: &Vec3<T>, t: T) -> Vec3<T> {
    core::array::from_fn(|k| from[k] + (to[k] - from[k]) * t)
}
