//! The tree and its nodes.

use super::part::Part;
use super::piece::Region;
use crate::setup::Linear;
use std::cmp::Ordering;

/// No node, or no polygon.
pub(super) const NONE: u32 = u32::MAX;

/// A tree of the opaque polygons of [`Surfaces`](crate::visibility::Surfaces).
#[derive(Clone, Debug)]
pub struct Tree {
    /// The root comes first.
    pub(super) nodes: Vec<Node>,
}

#[derive(Clone, Debug)]
pub(super) struct Node {
    /// The polygon whose plane divides the rest, and what each eye sees of this piece of it.
    /// Without a polygon, `sides` are what the left and what the right eye sees, or what lies on
    /// either side of a row or a column.
    pub polygon: u32,
    pub views: [Option<Region>; 2],
    /// If the eyes are on different sides of the plane, and the left one sees things here that may
    /// hide each other: the part of its view that they lie in.
    pub contested: Option<Part>,
    /// Depth of the polygon for the left eye, if this node is contested or one above it.
    pub depth: Option<Linear>,
    /// The far side for each eye: `Greater` for the positive one. `Equal` if there is none, or if
    /// the eye sees nothing below this node.
    pub far: [Ordering; 2],
    /// Nodes on the negative and the positive side.
    pub sides: [u32; 2],
}

impl Node {
    /// A node with nothing below it.
    pub fn new(polygon: u32, views: [Option<Region>; 2], far: [Ordering; 2]) -> Node {
        Node { polygon, views, contested: None, depth: None, far, sides: [NONE; 2] }
    }
}

impl Tree {
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
