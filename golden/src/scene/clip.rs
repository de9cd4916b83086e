//! Convex polygons cut by half spaces, before anything is snapped.

use super::rig::HalfSpace;
use super::vector::{mix, Vec3};
use crate::clipping::half_space;

/// A corner with everything that is interpolated along an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Place in the scene.
    pub position: Vec3,
    /// Colour for the left and the right eye: red, green, blue, alpha from 0 to 255.
    pub colour: [[f64; 4]; 2],
    /// Texture coordinates in texels.
    pub texel: [f64; 2],
}

impl Corner {
    /// The corner `t` of the way to another.
    fn towards(&self, other: &Corner, t: f64) -> Corner {
        Corner {
            position: mix(self.position, other.position, t),
            colour: [0, 1].map(|eye| mix(self.colour[eye], other.colour[eye], t)),
            texel: mix(self.texel, other.texel, t),
        }
    }
}

/// The part of a convex polygon in a half space; empty if there is none.
pub fn clip(polygon: &[Corner], space: &HalfSpace) -> Vec<Corner> {
    half_space::cut(polygon, |corner| space.at(corner.position), Corner::towards)
}

/// The part of a convex polygon in all of the half spaces.
pub fn clip_all(mut polygon: Vec<Corner>, spaces: &[HalfSpace]) -> Vec<Corner> {
    for space in spaces {
        if polygon.iter().any(|c| space.at(c.position) < 0.0) {
            polygon = clip(&polygon, space);
        }
    }
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::vector::{dot, outward};

    fn area(polygon: &[Corner]) -> f64 {
        let p = |k: usize| polygon[k].position;
        let fan = (1..polygon.len().max(2) - 1).map(|k| outward(p(0), p(k), p(k + 1)));
        let sum = fan.fold([0.0; 3], crate::scene::vector::add);
        dot(sum, sum).sqrt() / 2.0
    }

    fn random_triangle(random: &mut fastrand::Rng) -> Vec<Corner> {
        let mut corner = || {
            let mut n = || random.f64() * 4.0 - 2.0;
            let position = [n(), n(), n()];
            Corner { position, texel: [position[0] * 8.0, position[1]], ..Corner::default() }
        };
        vec![corner(), corner(), corner()]
    }

    #[test]
    fn the_two_sides_of_a_cut_make_up_the_whole() {
        let mut random = fastrand::Rng::with_seed(5);
        let mut cut = 0;
        for _ in 0..2000 {
            let triangle = random_triangle(&mut random);
            let normal = [random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5];
            let space = HalfSpace { normal, offset: random.f64() - 0.5 };
            let other = HalfSpace { normal: normal.map(|n| -n), offset: -space.offset };
            let (inside, outside) = (clip(&triangle, &space), clip(&triangle, &other));
            cut += usize::from(!inside.is_empty() && !outside.is_empty());
            let sum = area(&inside) + area(&outside);
            assert!((sum - area(&triangle)).abs() < 1e-12, "{sum} {}", area(&triangle));
            for corner in &inside {
                assert!(space.at(corner.position) > -1e-15);
                // What is linear in space stays so.
                assert!((corner.texel[0] - corner.position[0] * 8.0).abs() < 1e-12);
            }
            assert!(inside.len() <= 4);
        }
        assert!(cut > 500);
    }

    #[test]
    fn polygons_that_share_an_edge_share_its_cut() {
        let mut random = fastrand::Rng::with_seed(6);
        for _ in 0..500 {
            let triangle = random_triangle(&mut random);
            let space = HalfSpace { normal: [0.3, -0.8, 0.5], offset: 0.1 };
            let mut reversed = triangle.clone();
            reversed.reverse();
            let corners = clip(&triangle, &space);
            for corner in clip(&reversed, &space) {
                assert!(corners.contains(&corner));
            }
        }
    }
}
