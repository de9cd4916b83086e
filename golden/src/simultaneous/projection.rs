//! Perspective projection for one eye, and for both at once.
//!
//! Adelson et al. 1991, "Differences and Similarities Between The Views": eyes at (∓e/2, 0, −d),
//! screen z = 0,
//!
//! x = (x ∓ (z/d)·(e/2)) / (1 + z/d), − for the left eye,  y = y / (1 + z/d).
//!
//! z/d, its products with e/2, 1 + z/d and y are the same for both eyes: 8 operations instead of
//! twice 6.

use super::Point;
use crate::formats::Eye;
use crate::work::Real;

/// Projects points on the screen, in the scene's own unit of length.
#[derive(Clone, Copy, Debug)]
pub struct Projector<T> {
    /// e/2.
    half_separation: T,
    /// 1/d.
    inverse_distance: T,
}

impl<T: Real> Projector<T> {
    /// A projector for eyes e apart and d from the screen; d must not be 0.
    pub fn new(separation: f64, distance: f64) -> Projector<T> {
        Projector {
            half_separation: T::of(separation / 2.0),
            inverse_distance: T::of(1.0 / distance),
        }
    }

    /// A point as an eye sees it; it must lie before the eyes, z > −d. Adelson et al. 1991, "Differences
    /// and Similarities Between The Views": x_sL or x_sR, and y_s.
    #[inline]
    pub fn one(&self, [x, y, z]: [T; 3], eye: Eye) -> Point<T, 1> {
        let to_eye = match eye {
            Eye::Left => -self.half_separation,
            Eye::Right => self.half_separation,
        };
        let depth = z * self.inverse_distance;
        let w = T::of(1.0) + depth;
        Point { x: [(x + depth * to_eye) / w], y: y / w }
    }

    /// A point as both eyes see it; it must lie before the eyes, z > −d. The same section: 8 operations.
    #[inline]
    pub fn both(&self, [x, y, z]: [T; 3]) -> Point<T, 2> {
        let depth = z * self.inverse_distance;
        let w = T::of(1.0) + depth;
        let shift = depth * self.half_separation;
        Point { x: [(x - shift) / w, (x + shift) / w], y: y / w }
    }
}
