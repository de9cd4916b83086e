//! Input of setup: projected, snapped vertices.

use crate::formats::{Eye, Rgba};
use alloc::vec::Vec;

/// Most vertices of a polygon: three edges of the primary pipeline and three lent ones.
pub const MAX_VERTICES: usize = 6;

/// A vertex as both eyes see it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vertex {
    /// x for the left and the right eye, in subpixels.
    pub x: [i32; 2],
    /// y for the left and the right eye, in subpixels; the same unless the head is tilted.
    pub y: [i32; 2],
    /// Depth, 24 bits, 0 at the near plane; common to both eyes.
    pub depth: u32,
    /// Lit colour for the left and the right eye, alpha not applied.
    pub colour: [Rgba; 2],
    /// Texture coordinates in texels, 8 fraction bits.
    pub texel: [i32; 2],
    /// Inverse distance from the eye plane, 2^24 at the polygon's nearest vertex.
    pub inverse: u32,
}

/// A polygon to draw: a triangle, or a convex polygon of up to six vertices for monocular drawing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polygon {
    /// The vertices, in either winding.
    pub vertices: Vec<Vertex>,
    /// Index of the triangle or face in its scene; lower ones win ties of depth.
    pub id: u32,
    /// Eyes that the polygon is to be drawn for.
    pub eyes: Eyes,
    /// Index of the texture, if there is one.
    pub texture: Option<u32>,
    /// Highlights or reflections differ noticeably between the eyes.
    pub specular: bool,
    /// The polygon had to be clipped against the guard band, for each eye alone.
    pub guard_band: bool,
}

impl Polygon {
    /// The triangles of a convex polygon, each with the first vertex.
    pub fn fan(&self) -> impl Iterator<Item = Polygon> + '_ {
        (1..self.vertices.len() - 1).map(|k| {
            let vertices = [0, k, k + 1].map(|n| self.vertices[n]).to_vec();
            Polygon { vertices, ..self.clone() }
        })
    }
}

/// A set of eyes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Eyes {
    /// Both.
    #[default]
    Both,
    /// Only this one.
    One(Eye),
}

impl Eyes {
    /// True if the eye is in the set.
    pub fn contains(self, eye: Eye) -> bool {
        match self {
            Eyes::Both => true,
            Eyes::One(one) => one == eye,
        }
    }
}
