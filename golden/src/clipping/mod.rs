//! Clipping for both eyes at once: lines and polygons by Liang and Barsky's parametric method.
//!
//! Adelson et al. 1991, "Line and Polygon Clipping". The views share y, so the top and the bottom
//! of a window are clipped against once: 6 boundaries instead of twice 4. The near plane is common
//! to both eyes altogether.
//!
//! Lines and polygons are given as [`Point`]s of one or of two views; there is one algorithm for
//! both, and what it makes of a view does not depend on the other.

pub mod half_space;
pub mod lines;
pub mod near;
pub mod polygons;

pub use crate::simultaneous::Point;

/// A window; its border belongs to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window<T> {
    /// Smallest and largest x.
    pub x: [T; 2],
    /// Smallest and largest y.
    pub y: [T; 2],
}
