//! Back faces for both eyes at once, and G1 from the same two numbers.
//!
//! Adelson et al. 1991, "Stereoscopic Back-Face Removal", in its corrected form (`docs/errata.md`).
//! The normal (A, B, C) of a plane points out of its front; an eye sees the front where
//! A·x + B·y + C·z + D > 0 at the eye. With S the value at the right eye and the left eye e to the
//! left of it, the value at the left eye is L = S − A·e: 10 operations instead of twice 7. Integers
//! below 2^53 are exact; else rounding may misjudge a plane that is edge-on to its last bits.
//!
//! L and S also tell the width of the polygon in one view from that in the other. A triangle's
//! area on the screen is its distance-weighted volume with the eye: proportional to the plane's
//! value there, by a factor that depends on the corners' distances from the eyes' plane and is
//! thus the same for both eyes. Rows are common to the views, so areas are as widths: G1, the
//! secondary width of a primary pixel (McCann & Lister), is the smaller of L and S over the larger.

use crate::formats::Eye;
use crate::setup::Eyes;
use crate::work::Real;

/// The plane A·x + B·y + C·z + D = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<T>(pub [T; 4]);

impl<T: Real> Plane<T> {
    /// A·x + B·y + C·z + D: positive before the front of the plane (Adelson et al. 1991, "Stereoscopic
    /// Back-Face Removal").
    #[inline]
    pub fn at(&self, [x, y, z]: [T; 3]) -> T {
        let Plane([a, b, c, d]) = *self;
        a * x + b * y + c * z + d
    }

    /// True if an eye there sees the front.
    #[inline]
    pub fn faces(&self, eye: [T; 3]) -> bool {
        self.at(eye) > T::of(0.0)
    }
}

/// Level eyes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewer<T> {
    /// Place of the right eye.
    pub right: [T; 3],
    /// Distance e by which the left eye lies to the left of it.
    pub separation: T,
}

impl<T: Real> Viewer<T> {
    /// Eyes at (∓e/2, 0, −d).
    pub fn new(separation: f64, distance: f64) -> Viewer<T> {
        let right = [separation / 2.0, 0.0, -distance].map(T::of);
        Viewer { right, separation: T::of(separation) }
    }

    /// The plane's values at the eyes: S at the right one, L = S − A·e at the left one (the same section; errata: left
    /// data).
    #[inline]
    pub fn facing(&self, plane: &Plane<T>) -> Facing<T> {
        let right = plane.at(self.right);
        Facing { values: [right - plane.0[0] * self.separation, right] }
    }

    /// True for each eye, left and right, that sees the front, by the publication's decisions as they should read
    /// (errata: back faces): two or three comparisons. [`Facing::front`] takes two and branches nowhere.
    pub fn decide(&self, plane: &Plane<T>) -> [bool; 2] {
        let zero = T::of(0.0);
        let right = plane.at(self.right);
        let change = plane.0[0] * self.separation;
        let left = right - change;
        if change > zero {
            if right <= zero {
                [false, false]
            } else {
                [left > zero, true]
            }
        } else if left <= zero {
            [false, false]
        } else {
            [true, right > zero]
        }
    }
}

/// A plane as both eyes see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing<T> {
    /// The plane's values at the left and the right eye.
    pub values: [T; 2],
}

impl<T: Real> Facing<T> {
    /// True for each eye, left and right, that sees the front.
    #[inline]
    pub fn front(&self) -> [bool; 2] {
        self.values.map(|value| value > T::of(0.0))
    }

    /// The eyes that see the front; none if neither does.
    pub fn eyes(&self) -> Option<Eyes> {
        match self.front() {
            [true, true] => Some(Eyes::Both),
            [true, false] => Some(Eyes::One(Eye::Left)),
            [false, true] => Some(Eyes::One(Eye::Right)),
            [false, false] => None,
        }
    }

    /// The primary eye, which sees the polygon wider, and G1 (McCann & Lister, equation 5), from 0 to 1; none if the eyes see
    /// different sides, or one of them sees the edge.
    pub fn scale(&self) -> Option<(Eye, T)> {
        let zero = T::of(0.0);
        let [left, right] =
            if self.values[0] > zero { self.values } else { self.values.map(|v| -v) };
        if !(left > zero && right > zero) {
            return None;
        }
        Some(if left >= right { (Eye::Left, right / left) } else { (Eye::Right, left / right) })
    }
}
