//! Operations of the fixed-point arithmetic that methods have in common, to be noted as work beside that of
//! [`Counted`](crate::work::Counted) numbers.
//!
//! Counted are additions, multiplications, divisions and comparisons of coordinates, depths, colours
//! and coefficients. Not counted are shifts, rounding, clamping to a window or to a range, negation,
//! copying, addressing and the counting of loops; multiplication by a power of two is a shift.

use crate::formats::Formats;
use crate::setup::{Attributes, Linear};
use crate::texture::Lookup;
use crate::work::Operations;

/// A linear function at a pixel: [`Linear::at`].
pub const LINEAR: Operations = Operations::new(2, 2, 0, 0);
/// One step of a value and its comparison, as of depth along a span.
pub const STEP_AND_COMPARE: Operations = Operations::new(1, 0, 0, 1);
/// Blending of a pixel that has passed the depth test: the factor, three channels and the question
/// whether anything of it is seen.
pub const BLEND: Operations = Operations::new(7, 4, 0, 1);

/// The cross product of two sides of a triangle.
const CROSS: Operations = Operations::new(5, 2, 0, 0);
/// The coefficients of a plane: two cross products, where its anchor is, three quotients.
const THROUGH: Operations = Operations::new(18, 8, 3, 0);
/// Test that an attribute is the same at three corners.
const SAME: Operations = Operations::comparisons(2);

/// Area of an outline of so many corners, and whether it has one.
pub fn area(corners: usize) -> Operations {
    (CROSS + Operations::new(1, 0, 0, 0)) * corners.saturating_sub(1) as u64
        + Operations::comparisons(1)
}

/// The planes of all attributes of a polygon of so many corners: its largest triangle, the
/// determinant, and coefficients where an attribute varies.
pub fn attributes(corners: usize, attributes: &Attributes) -> Operations {
    let Attributes { colour, depth, texture } = attributes;
    let all = colour.iter().chain([depth]).chain(texture.iter().flatten());
    (CROSS + Operations::comparisons(1)) * corners.saturating_sub(2) as u64
        + CROSS
        + all.map(attribute).fold(Operations::default(), |sum, one| sum + one)
}

/// One attribute of a plane that is known.
fn attribute(linear: &Linear) -> Operations {
    match (linear.a, linear.b) {
        (0, 0) => SAME,
        _ => SAME + THROUGH,
    }
}

/// The crossings of an outline with a scan line of direct rendering, which looks at all its edges
/// and computes x of those that cross: as a quotient, and the lesser and greater of them.
pub fn crossings(edges: usize, crossed: u64) -> Operations {
    Operations::comparisons(3) * edges as u64 + Operations::new(5, 3, 1, 2) * crossed
}

/// Samples of a pixel against the crossings of four scan lines, if it has more than one.
pub fn samples(formats: &Formats) -> Operations {
    match formats.mask_bits {
        1 => Operations::default(),
        samples => Operations::comparisons(2 * u64::from(samples)),
    }
}

/// The colour of a pixel: four channels; with a texture its coordinates, divided by the inverse
/// distance, the texels' weights if it is interpolated, and the product with the light.
pub fn colour(textured: bool, lookup: Lookup) -> Operations {
    let light = LINEAR * 4;
    if !textured {
        return light;
    }
    let texel = match lookup {
        Lookup::Nearest => Operations::default(),
        Lookup::Bilinear => Operations::new(4 + 12, 4 + 16, 0, 0),
    };
    light + LINEAR * 3 + Operations::new(0, 0, 2, 0) + texel + Operations::new(0, 4, 4, 0)
}

/// Setting up an edge that is stepped from row to row in so many views, but for the inverse of its
/// height: rows, which are shared, and for each view x on the first row and its slope.
pub fn edge(views: usize) -> Operations {
    Operations::new(3, 0, 0, 2) + Operations::new(4, 4, 0, 0) * views as u64
}
