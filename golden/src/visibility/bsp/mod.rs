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
mod piece;
mod plane;
mod scan;

use super::Surfaces;
use crate::setup::Linear;
use build::Builder;
use piece::Region;
use std::cmp::Ordering;
use std::ops::Range;

pub use paint::{both, draw, one, ZBuffer};

/// No node, or no polygon.
const NONE: u32 = u32::MAX;

/// A tree of the opaque polygons of [`Surfaces`].
#[derive(Clone, Debug)]
pub struct Tree {
    /// The root comes first.
    nodes: Vec<Node>,
}

#[derive(Clone, Debug)]
struct Node {
    /// The polygon whose plane divides the rest, and what each eye sees of this piece of it.
    /// Without a polygon, `sides` are what the left and what the right eye sees, or what lies on
    /// either side of a row or a column.
    polygon: u32,
    views: [Option<Region>; 2],
    /// If the eyes are on different sides of the plane, and the left one sees things here that may
    /// hide each other: the part of its view that they lie in.
    contested: Option<Part>,
    /// Depth of the polygon for the left eye, if this node is contested or one above it.
    depth: Option<Linear>,
    /// The far side for each eye: `Greater` for the positive one. `Equal` if there is none, or if
    /// the eye sees nothing below this node.
    far: [Ordering; 2],
    /// Nodes on the negative and the positive side.
    sides: [u32; 2],
}

impl Node {
    /// A node with nothing below it.
    fn new(polygon: u32, views: [Option<Region>; 2], far: [Ordering; 2]) -> Node {
        Node { polygon, views, contested: None, depth: None, far, sides: [NONE; 2] }
    }
}

/// A rectangle of pixels.
#[derive(Clone, Debug)]
struct Part {
    columns: Range<i32>,
    rows: Range<i32>,
}

impl Part {
    /// Whether they have pixels in common.
    fn meets(&self, other: &Part) -> bool {
        let meet = |a: &Range<i32>, b: &Range<i32>| a.start < b.end && b.start < a.end;
        meet(&self.columns, &other.columns) && meet(&self.rows, &other.rows)
    }

    /// The smallest part that has both.
    fn with(&self, other: &Part) -> Part {
        Part { columns: hull(&self.columns, &other.columns), rows: hull(&self.rows, &other.rows) }
    }
}

/// The smallest range that has both.
fn hull(a: &Range<i32>, b: &Range<i32>) -> Range<i32> {
    a.start.min(b.start)..a.end.max(b.end)
}

impl Tree {
    /// Builds the tree.
    ///
    /// The root of each cell is, of up to 16 evenly spaced polygons, the one that cuts fewest of a
    /// sample of 48 others and divides them most evenly; planes that pass between the eyes come
    /// last. Large cells that none of them divides well are divided by a row or a column of the views.
    pub fn new(surfaces: &Surfaces) -> Tree {
        Builder::new(surfaces).build()
    }

    /// Pieces that the polygons were cut into.
    pub fn pieces(&self) -> usize {
        self.nodes.iter().filter(|node| node.polygon != NONE).count()
    }

    /// Nodes from the root down to the lowest, both counted.
    pub fn height(&self) -> usize {
        let mut heights = vec![1; self.nodes.len()];
        for (n, node) in self.nodes.iter().enumerate() {
            for side in node.sides.into_iter().filter(|&side| side != NONE) {
                heights[side as usize] = heights[n] + 1;
            }
        }
        heights.into_iter().max().unwrap_or(0)
    }

    /// Planes between the eyes below which the order for the left eye may be another.
    pub fn contested(&self) -> usize {
        self.nodes.iter().filter(|node| node.contested.is_some()).count()
    }
}
