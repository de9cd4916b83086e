//! A scene as polygons in space of one colour each: what a pipeline with constant shading takes.

use crate::scene::vector::{cross, dot, outward, sub, Vec3};
use crate::scene::{Colours, Mesh, Scene};
use crate::setup::MAX_VERTICES;

/// Polygons in space, in the order of their ids.
#[derive(Clone, Debug, Default)]
pub struct Model {
    corners: Vec<Vec3>,
    pieces: Vec<Piece>,
    /// The first piece of each id, and one more.
    first: Vec<u32>,
}

/// A planar convex polygon, or a part of one that is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Id of the polygon in its scene.
    pub id: u32,
    /// Its one colour.
    pub colour: [u8; 3],
    first: u32,
    count: u32,
}

impl Model {
    /// The polygons of a scene in their base colours, unlit. Triangles of one id that make a fan are
    /// put together where the whole is planar and convex.
    pub fn new(scene: &Scene) -> Model {
        let mut model = Model::default();
        let mut first_id = 0;
        for mesh in &scene.meshes {
            let material = scene.materials.get(mesh.material as usize).cloned().unwrap_or_default();
            model.mesh(mesh, first_id, material.diffuse.map(|n| (n * 255.0) as u8));
            first_id += mesh.id_count() as u32;
        }
        model.pieces.sort_by_key(|piece| piece.id);
        let starts = |id| model.pieces.partition_point(|piece| piece.id < id) as u32;
        model.first = (0..=first_id).map(starts).collect();
        model
    }

    /// Number of ids.
    pub fn len(&self) -> usize {
        self.first.len() - 1
    }

    /// True if there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// All pieces, by id.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The pieces of one polygon.
    pub fn polygon(&self, id: u32) -> &[Piece] {
        let [from, to] = [0, 1].map(|n| self.first[id as usize + n] as usize);
        &self.pieces[from..to]
    }

    /// The corners of a piece.
    #[inline]
    pub fn corners(&self, piece: &Piece) -> &[Vec3] {
        &self.corners[piece.first as usize..][..piece.count as usize]
    }

    fn mesh(&mut self, mesh: &Mesh, first_id: u32, diffuse: [u8; 3]) {
        let colour = |polygon: usize, vertex: u32| match &mesh.colours {
            Colours::Material => diffuse,
            Colours::Vertex(colours) => colours[vertex as usize],
            Colours::Face(colours) => colours[polygon],
        };
        let place = |n: u32| mesh.positions[n as usize];
        let mut polygon: Vec<u32> = Vec::new();
        for (n, triangle) in mesh.triangles.iter().enumerate() {
            let id = first_id + mesh.triangle_ids.get(n).map_or(n as u32, |&id| id);
            let colour = colour(n, triangle[0]);
            let [a, b, c] = *triangle;
            let fan = polygon.len() < MAX_VERTICES
                && [polygon.first(), polygon.last()] == [Some(&a), Some(&b)];
            let last = self.pieces.last_mut().filter(|p| fan && (p.id, p.colour) == (id, colour));
            if let Some(last) = last {
                polygon.push(c);
                let corners: Vec<Vec3> = polygon.iter().map(|&n| place(n)).collect();
                if is_flat_and_convex(&corners) {
                    self.corners.push(place(c));
                    last.count += 1;
                    continue;
                }
            }
            polygon = triangle.to_vec();
            self.piece(id, colour, triangle.iter().map(|&n| place(n)));
        }
        let first_face = first_id + mesh.triangle_id_count() as u32;
        for (n, face) in mesh.faces.iter().enumerate() {
            let colour = colour(mesh.triangles.len() + n, face[0]);
            self.piece(first_face + n as u32, colour, face.iter().map(|&n| place(n)));
        }
    }

    fn piece(&mut self, id: u32, colour: [u8; 3], corners: impl Iterator<Item = Vec3>) {
        let first = self.corners.len() as u32;
        self.corners.extend(corners);
        let count = self.corners.len() as u32 - first;
        self.pieces.push(Piece { id, colour, first, count });
    }
}

/// True if a polygon turns the same way at every corner and is planar but for rounding.
fn is_flat_and_convex(corners: &[Vec3]) -> bool {
    let count = corners.len();
    let at = |k: usize| corners[k % count];
    let normal = outward(at(0), at(1), at(2));
    let flat = corners.iter().all(|&p| {
        let off = dot(normal, sub(p, at(0)));
        off * off <= 1e-18 * dot(normal, normal) * dot(sub(p, at(0)), sub(p, at(0)))
    });
    let turns = |k: usize| dot(normal, cross(sub(at(k + 2), at(k + 1)), sub(at(k + 1), at(k))));
    flat && (0..count).all(|k| turns(k) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;

    #[test]
    fn quadrilaterals_are_whole_again() {
        let scene = builtin::scene("office-2", 300, 300).expect("there is one");
        let model = Model::new(&scene);
        assert_eq!((model.len(), model.pieces().len()), (2 * 3652, 2 * 3652));
        let mesh = &scene.meshes[0];
        for (n, piece) in model.pieces().iter().enumerate() {
            assert_eq!(model.corners(piece), &mesh.positions[4 * n..][..4]);
            assert_eq!(model.polygon(n as u32), &[*piece]);
        }
    }

    #[test]
    fn bent_and_hollow_ones_stay_in_pieces() {
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let with = |fourth: Vec3| {
            let mut corners = square;
            corners[3] = fourth;
            let mesh = Mesh {
                positions: corners.to_vec(),
                triangles: vec![[0, 1, 2], [0, 2, 3]],
                triangle_ids: vec![0, 0],
                ..Mesh::default()
            };
            let materials = vec![crate::scene::Material::default()];
            Model::new(&Scene { meshes: vec![mesh], materials, ..Scene::default() })
        };
        assert_eq!(with([0.0, 1.0, 0.0]).pieces().len(), 1);
        let bent = with([0.0, 1.0, 0.1]);
        assert_eq!((bent.len(), bent.pieces().len()), (1, 2));
        assert_eq!(with([0.9, 0.95, 0.0]).pieces().len(), 1);
        assert_eq!(with([0.5, 0.1, 0.0]).pieces().len(), 2);
    }
}
