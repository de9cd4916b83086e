//! Work done for both views at once: projection and scan conversion with shared rows and edges.
//!
//! Adelson et al. 1991, "Differences and Similarities Between The Views", "Rendering Polygons".
//!
//! The eyes are level, so a point has one y and an x for each view. Every algorithm here is
//! written once for any number of views: with one it is the usual algorithm, with two the
//! simultaneous one. What does not depend on x is done outside the loop over views, so both forms
//! do the same arithmetic and agree bit for bit.

mod edges;
pub mod flat;
pub mod gouraud;
pub mod projection;
mod walk;

pub use edges::{Corner, Edges};

/// A point as `VIEWS` views see it: an x for each, and the y they have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point<T, const VIEWS: usize> {
    /// x in each view.
    pub x: [T; VIEWS],
    /// y in all of them.
    pub y: T,
}

impl<T: Copy> Point<T, 2> {
    /// The point as one of two views sees it.
    pub fn view(&self, view: usize) -> Point<T, 1> {
        Point { x: [self.x[view]], y: self.y }
    }
}
