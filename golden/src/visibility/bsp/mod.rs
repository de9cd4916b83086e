//! Binary space partition: painting from back to front, for one view or for both at once.
//!
//! Adelson et al. 1991, "Combining Z-Buffers and BSP-trees". The plane of each node's polygon
//! divides the polygons below it. An eye paints what is on the far side of it, the polygon, and
//! what is on the near side. The order for the other eye differs only below planes that the eyes
//! are on different sides of. So one traversal, in the right eye's order, paints both views: the
//! right one by order alone, the left one by order too, but below such planes by a z-buffer.
//!
//! The tree is made of what is drawn: polygons in screen space, their corners snapped. There an eye
//! looks along the axis of depth, so that the far side of a plane is the one of greater depth. What
//! is said to be on one side of a plane is so in both views, each in its own integers; otherwise it
//! is cut, in one view or in both. No rounding decides what hides what.

mod build;
mod paint;
mod part;
mod piece;
mod plane;
mod scan;
mod tree;

pub use paint::{both, draw, one, ZBuffer};
pub use tree::Tree;
