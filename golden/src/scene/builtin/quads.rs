//! Quadrilaterals of one colour each, and boxes made of them.

use crate::scene::mesh::{Colours, Mesh};
use crate::scene::vector::{outward, unit, Vec3};

/// Collects quadrilaterals. Each has one id and is drawn as two triangles, which setup can derive.
#[derive(Default)]
pub struct Quads {
    mesh: Mesh,
    colours: Vec<[u8; 3]>,
    count: u32,
}

impl Quads {
    /// A planar convex quadrilateral, its front counter-clockwise as seen. Its colour is dimmed by
    /// the direction that it faces: brightest from above, darkest from below.
    pub fn quad(&mut self, corners: [Vec3; 4], colour: [u8; 3]) {
        let [x, y, z] = unit(outward(corners[0], corners[1], corners[2]));
        let light = 0.76 + 0.18 * y - 0.06 * z - 0.1 * x;
        let colour = colour.map(|n| (f64::from(n) * light).round_ties_even() as u8);
        let first = self.mesh.positions.len() as u32;
        self.mesh.positions.extend(corners);
        for n in 1..3 {
            self.mesh.triangles.push([first, first + n, first + n + 1]);
            self.mesh.triangle_ids.push(self.count);
            self.colours.push(colour);
        }
        self.count += 1;
    }

    /// All six sides of a box between two opposite corners.
    pub fn cuboid(&mut self, least: Vec3, most: Vec3, colour: [u8; 3]) {
        Side::ALL.iter().for_each(|&side| self.side(side, least, most, colour));
    }

    /// The sides of a box that stands on something: all but the bottom.
    pub fn standing(&mut self, least: Vec3, most: Vec3, colour: [u8; 3]) {
        let seen = Side::ALL.iter().filter(|&&side| side != Side::Bottom);
        seen.for_each(|&side| self.side(side, least, most, colour));
    }

    /// One side of a box, facing outward.
    pub fn side(&mut self, side: Side, least: Vec3, most: Vec3, colour: [u8; 3]) {
        let ([l, b, n], [r, t, f]) = (least, most);
        let corners = match side {
            Side::Left => [[l, b, f], [l, b, n], [l, t, n], [l, t, f]],
            Side::Right => [[r, b, n], [r, b, f], [r, t, f], [r, t, n]],
            Side::Bottom => [[l, b, f], [r, b, f], [r, b, n], [l, b, n]],
            Side::Top => [[l, t, n], [r, t, n], [r, t, f], [l, t, f]],
            Side::Front => [[l, b, n], [r, b, n], [r, t, n], [l, t, n]],
            Side::Back => [[r, b, f], [l, b, f], [l, t, f], [r, t, f]],
        };
        self.quad(corners, colour);
    }

    /// A rectangle that fills `cells` of a grid, its colours from the cell's column and row:
    /// from `corner` along `across` and `up`, which is to the left of `across` as seen.
    pub fn grid(
        &mut self,
        corner: Vec3,
        [across, up]: [Vec3; 2],
        cells: [u32; 2],
        colour: impl Fn(u32, u32) -> [u8; 3],
    ) {
        let place = |column: u32, row: u32| -> Vec3 {
            let [s, t] =
                [[column, cells[0]], [row, cells[1]]].map(|[n, of]| f64::from(n) / f64::from(of));
            core::array::from_fn(|k| corner[k] + across[k] * s + up[k] * t)
        };
        for row in 0..cells[1] {
            for column in 0..cells[0] {
                let corners =
                    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[i, j]| place(column + i, row + j));
                self.quad(corners, colour(column, row));
            }
        }
    }

    /// The mesh, of material 0.
    pub fn finish(mut self) -> Mesh {
        self.mesh.colours = Colours::Face(self.colours);
        self.mesh
    }
}

/// A side of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Towards −x.
    Left,
    /// Towards +x.
    Right,
    /// Towards −y.
    Bottom,
    /// Towards +y.
    Top,
    /// Towards the viewer, −z.
    Front,
    /// Away from the viewer.
    Back,
}

impl Side {
    /// All six.
    pub const ALL: [Side; 6] =
        [Side::Left, Side::Right, Side::Bottom, Side::Top, Side::Front, Side::Back];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::vector::{dot, sub};

    #[test]
    fn boxes_face_outward() {
        let mut quads = Quads::default();
        quads.cuboid([1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [200; 3]);
        let mesh = quads.finish();
        assert_eq!((mesh.triangles.len(), mesh.id_count()), (12, 6));
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|n| mesh.positions[n as usize]);
            assert!(dot(outward(a, b, c), sub(a, [1.5, 3.0, 4.5])) > 0.0, "{a:?}");
        }
        assert!(mesh.check(0, false).is_ok());
    }

    #[test]
    fn a_grid_faces_the_side_it_is_seen_from() {
        let mut quads = Quads::default();
        let floor = [[2.0, 0.0, 0.0], [0.0, 0.0, 3.0]];
        quads.grid([0.0; 3], floor, [2, 3], |_, _| [100; 3]);
        let mesh = quads.finish();
        assert_eq!(mesh.id_count(), 6);
        let [a, b, c] = mesh.triangles[0].map(|n| mesh.positions[n as usize]);
        assert!(outward(a, b, c)[1] > 0.0);
    }
}
