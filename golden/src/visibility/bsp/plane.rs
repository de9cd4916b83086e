//! Depth planes of polygons as each eye sees them, and on which side of one another lies.
//!
//! All in integers: a corner is a point (x, y, depth) of a view's screen space, where projection
//! keeps planes plane. Products of three coordinates stay below 2^110.

use crate::formats::Eye;
use crate::setup::{Attributes, Outline, Polygon, Vertex};
use std::cmp::Ordering;

/// The plane det·z = a·x + b·y + c in the screen space of a view, in subpixels and units of depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    slopes: [i128; 2],
    offset: i128,
    det: i128,
}

impl Plane {
    /// The plane of a polygon; none if its corners lie on a line, or are not those of this view.
    pub fn new(polygon: &Polygon, eye: Eye) -> Option<Plane> {
        if polygon.guard_band && !polygon.eyes.contains(eye) {
            return None;
        }
        if Outline::new(polygon, eye).doubled_area() != 0 {
            return Plane::through(Attributes::corners(polygon, eye), eye);
        }
        // Seen edge-on: any three corners that are not on a line do.
        let fan = (1..polygon.vertices.len() - 1).map(|k| [0, k, k + 1]);
        fan.map(|fan| fan.map(|k| polygon.vertices[k])).find_map(|fan| Plane::through(fan, eye))
    }

    fn through(corners: [Vertex; 3], eye: Eye) -> Option<Plane> {
        let [x, y, z] = [
            corners.map(|v| i128::from(v.x[eye as usize])),
            corners.map(|v| i128::from(v.y[eye as usize])),
            corners.map(|v| i128::from(v.depth)),
        ];
        let cross = |u: [i128; 3], v: [i128; 3]| {
            (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0])
        };
        let (slopes, det) = ([cross(z, y), cross(x, z)], cross(x, y));
        let offset = det * z[0] - slopes[0] * x[0] - slopes[1] * y[0];
        (slopes != [0, 0] || det != 0).then_some(Plane { slopes, offset, det })
    }

    /// Which side is farther for the eye: `Greater` for the positive side, `Equal` if the eye is
    /// in the plane.
    pub fn far_side(&self) -> Ordering {
        self.det.cmp(&0)
    }

    /// On which side of this plane a polygon is whose plane is `other`, wherever the eye sees it.
    pub fn side_of(&self, other: &Plane) -> Side {
        let sign = other.det.signum();
        let mix = |own: i128, others: i128| sign * (self.det * others - own * other.det);
        Side {
            slopes: [0, 1].map(|k| mix(self.slopes[k], other.slopes[k])),
            offset: mix(self.offset, other.offset),
        }
    }
}

/// A linear function of the place in a view, in subpixels: its sign tells the side of a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    slopes: [i128; 2],
    offset: i128,
}

impl Side {
    /// Negative in front of a row (`[0, 1]`) or a column (`[1, 0]`) of the view.
    pub fn of_place(slopes: [i128; 2], at: i32, subpixel_bits: u32) -> Side {
        Side { slopes, offset: -(i128::from(at) << subpixel_bits) }
    }

    pub fn at(&self, x: i128, y: i128) -> i128 {
        self.slopes[0] * x + self.slopes[1] * y + self.offset
    }

    /// The pixels of a row that are on the negative and on the other side, first and one past the
    /// last; unlimited ends are those of `i32`.
    pub fn columns(&self, row: i32, subpixel_bits: u32) -> [[i32; 2]; 2] {
        let half = 1i128 << (subpixel_bits - 1);
        let slope = self.slopes[0] << subpixel_bits;
        let first = self.at(half, (i128::from(row) << subpixel_bits) + half);
        let (all, none) = ([i32::MIN, i32::MAX], [0, 0]);
        let clamp = |n: i128| n.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
        match slope.cmp(&0) {
            Ordering::Greater => {
                let cell = clamp(-first.div_euclid(slope));
                [[i32::MIN, cell], [cell, i32::MAX]]
            }
            Ordering::Less => {
                let cell = clamp(first.div_euclid(-slope) + 1);
                [[cell, i32::MAX], [i32::MIN, cell]]
            }
            Ordering::Equal if first < 0 => [all, none],
            Ordering::Equal => [none, all],
        }
    }
}
