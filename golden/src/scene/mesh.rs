//! Triangles and polygons, their attributes, and normals where there are none.

use super::error::{SceneError, COORDINATE_LIMIT};
use super::vector::{add, dot, outward, unit, Vec3};
use crate::progress::Stage;
use crate::setup::MAX_VERTICES;
use crate::text::Grouped;
use std::collections::HashMap;

/// Largest texture coordinate, in repeats of the texture.
pub const REPEAT_LIMIT: f64 = 1024.0;

/// Most triangles round a vertex of which each pair is compared.
const CROWD: usize = 64;

/// Base colours of a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// The material's diffuse colour everywhere.
    #[default]
    Material,
    /// One a vertex.
    Vertex(Vec<[u8; 3]>),
    /// One a triangle, then one a face; the whole of it has that colour.
    Face(Vec<[u8; 3]>),
}

/// Triangles and polygons of one material.
///
/// Front faces are counter-clockwise as seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Places of the vertices.
    pub positions: Vec<Vec3>,
    /// Unit normals on the outside, one a vertex. Lit triangles need them.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one a vertex, in repeats of the texture: u to the right, v downward
    /// from its top row. Empty where there is no texture.
    pub texture_coordinates: Vec<[f64; 2]>,
    /// Base colours.
    pub colours: Colours,
    /// Vertices of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Which of the mesh's polygons each triangle is a part of, from 0; empty where each is one
    /// of its own. Decides the ids.
    pub triangle_ids: Vec<u32>,
    /// Vertices of planar polygons of 3 to 6 corners, flat shaded, without texture. Those that are not
    /// convex are drawn in triangles.
    pub faces: Vec<Vec<u32>>,
    /// Index of the material in the scene.
    pub material: u32,
    /// The triangles are lines, as [`super::wires::mesh`] makes them: they show their colours as they
    /// are, without light, and are their own wire frame.
    pub lines: bool,
}

impl Mesh {
    /// Number of ids that the triangles take; those of the faces follow.
    pub fn triangle_id_count(&self) -> usize {
        match self.triangle_ids.iter().max() {
            Some(&largest) => largest as usize + 1,
            None => self.triangles.len(),
        }
    }

    /// Number of ids that the mesh takes.
    pub fn id_count(&self) -> usize {
        self.triangle_id_count() + self.faces.len()
    }

    /// Refuses a mesh that could not be drawn; `index` is its own in the scene.
    pub fn check(&self, index: usize, lit: bool) -> Result<(), SceneError> {
        let wrong = |field, problem: String| Err(SceneError::Mesh { mesh: index, field, problem });
        let vertices = self.positions.len();
        let legal = |p: &Vec3| p.iter().all(|n| n.abs() <= COORDINATE_LIMIT);
        if let Some(at) = self.positions.iter().position(|p| !legal(p)) {
            return wrong("positions", format!("vertex {at} is not finite or too far away"));
        }
        let lit_triangles = lit && !self.lines && !self.triangles.is_empty();
        if self.normals.len() != vertices && (lit_triangles || !self.normals.is_empty()) {
            return wrong("normals", format!("{} for {vertices} vertices", self.normals.len()));
        }
        if !self.normals.iter().flatten().all(|n| n.abs() <= 2.0) {
            return wrong("normals", "not of unit length".into());
        }
        let texture = &self.texture_coordinates;
        if !texture.is_empty() && texture.len() != vertices {
            return wrong("texture_coordinates", format!("{} for {vertices}", texture.len()));
        }
        if !texture.iter().flatten().all(|n| n.abs() <= REPEAT_LIMIT) {
            return wrong("texture_coordinates", format!("beyond {REPEAT_LIMIT} repeats"));
        }
        let polygons = self.triangles.len() + self.faces.len();
        let (colours, needed) = match &self.colours {
            Colours::Material => (0, 0),
            Colours::Vertex(colours) => (colours.len(), vertices),
            Colours::Face(colours) => (colours.len(), polygons),
        };
        if colours != needed {
            return wrong("colours", format!("{colours} for {needed}"));
        }
        if !self.triangle_ids.is_empty() && self.triangle_ids.len() != self.triangles.len() {
            return wrong("triangle_ids", format!("{} of them", self.triangle_ids.len()));
        }
        let mut indices = self.triangles.iter().flatten().chain(self.faces.iter().flatten());
        if let Some(far) = indices.find(|&&n| n as usize >= vertices) {
            return wrong("triangles", format!("vertex {far} of {vertices}"));
        }
        if self.faces.iter().any(|face| !(3..=MAX_VERTICES).contains(&face.len())) {
            return wrong("faces", format!("not of 3 to {MAX_VERTICES} corners"));
        }
        Ok(())
    }

    /// Gives every corner the mean outward normal of the triangles around it, weighted by area,
    /// that meet its own at an angle whose cosine is at least `crease`.
    ///
    /// Vertices at the same place count as one, so that seams of texture do not show; vertices at
    /// creases are doubled.
    pub fn crease_normals(&mut self, crease: f64) {
        let _stage =
            Stage::new(format!("smoothing {} triangles", Grouped(self.triangles.len() as u64)));
        let mut places = HashMap::new();
        let mut around: Vec<Vec<u32>> = Vec::new();
        let mut place_of = Vec::with_capacity(self.positions.len());
        for p in &self.positions {
            // + 0.0 makes one place of 0 and -0.
            let place = *places.entry(p.map(|n| (n + 0.0).to_bits())).or_insert(around.len());
            around.resize(around.len().max(place + 1), Vec::new());
            place_of.push(place);
        }
        for (n, triangle) in self.triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| around[place_of[v as usize]].push(n as u32));
        }
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.positions[v as usize]);
            outward(a, b, c)
        };
        let areas: Vec<Vec3> = self.triangles.iter().map(area).collect();
        let units: Vec<Vec3> = areas.iter().map(|&n| unit(n)).collect();
        let mean = |some: &mut dyn Iterator<Item = &u32>| {
            unit(some.fold([0.0; 3], |sum, &m| add(sum, areas[m as usize])))
        };
        // Where very many meet, at the pole of a sphere, all count: it would take too long.
        let common: Vec<Option<Vec3>> = around
            .iter()
            .map(|here| (here.len() > CROWD).then(|| mean(&mut here.iter())))
            .collect();
        let normal = |vertex: u32, n: usize| {
            let place = place_of[vertex as usize];
            let together =
                |&&m: &&u32| dot(units[n], units[m as usize]) >= crease || m as usize == n;
            common[place].unwrap_or_else(|| mean(&mut around[place].iter().filter(together)))
        };
        let corners: Vec<[Vec3; 3]> =
            self.triangles.iter().enumerate().map(|(n, t)| t.map(|v| normal(v, n))).collect();
        self.give_normals(&corners);
    }

    /// Gives the corners of triangles these normals, doubling vertices where they differ.
    fn give_normals(&mut self, corners: &[[Vec3; 3]]) {
        let unset = [f64::NAN; 3];
        self.normals = vec![unset; self.positions.len()];
        let mut doubles = HashMap::new();
        let mut triangles = std::mem::take(&mut self.triangles);
        for (vertex, &normal) in triangles.iter_mut().flatten().zip(corners.iter().flatten()) {
            let old = *vertex as usize;
            if self.normals[old][0].is_nan() {
                self.normals[old] = normal;
            } else if self.normals[old] != normal {
                let next = self.positions.len() as u32;
                *vertex = *doubles.entry((old, normal.map(f64::to_bits))).or_insert(next);
                if *vertex == next {
                    self.double(old, normal);
                }
            }
        }
        self.triangles = triangles;
        // Vertices of no triangle.
        let known = |n: &mut Vec3| *n = n.map(|n| if n.is_nan() { 0.0 } else { n });
        self.normals.iter_mut().for_each(known);
    }

    fn double(&mut self, vertex: usize, normal: Vec3) {
        self.positions.push(self.positions[vertex]);
        self.normals.push(normal);
        if let Some(&coordinates) = self.texture_coordinates.get(vertex) {
            self.texture_coordinates.push(coordinates);
        }
        if let Colours::Vertex(colours) = &mut self.colours {
            colours.push(colours[vertex]);
        }
    }

    /// Moves every vertex.
    pub fn transform(&mut self, place: impl Fn(Vec3) -> Vec3, direction: impl Fn(Vec3) -> Vec3) {
        self.positions.iter_mut().for_each(|p| *p = place(*p));
        self.normals.iter_mut().for_each(|n| *n = direction(*n));
    }
}

/// Outward normal of a triangle: of the winding, unless the vertices' normals say otherwise.
pub fn outside(corners: [Vec3; 3], normals: [Vec3; 3]) -> Vec3 {
    let [a, b, c] = corners;
    let by_winding = outward(a, b, c);
    let by_normals = add(add(normals[0], normals[1]), normals[2]);
    if dot(by_winding, by_normals) < 0.0 {
        by_winding.map(|n| -n)
    } else {
        by_winding
    }
}

/// Outward normal of a convex polygon, of unit length.
pub fn face_normal(corners: &[Vec3]) -> Vec3 {
    let fan = corners.windows(2).skip(1).map(|pair| outward(corners[0], pair[0], pair[1]));
    unit(fan.fold([0.0; 3], add))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Mesh {
        Mesh {
            positions: vec![
                [0.0; 3],
                [1.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
                [-0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
            ],
            triangles: vec![[0, 1, 2], [3, 2, 4]],
            ..Mesh::default()
        }
    }

    #[test]
    fn normals_of_a_square_face_the_viewer() {
        let mut mesh = square();
        mesh.crease_normals(0.5);
        assert!(mesh.normals.iter().all(|n| *n == [0.0, 0.0, -1.0]));
        assert_eq!(mesh.positions.len(), 5);
        assert!(mesh.check(0, true).is_ok());
    }

    #[test]
    fn creases_are_kept_and_curves_smoothed() {
        // Two squares that meet at the edge x = 1: at a right angle, and nearly flat.
        for (depth, vertices) in [([1.0, 1.0], 8), ([2.0, 0.1], 6)] {
            let [x, z] = depth;
            let mut mesh = Mesh {
                positions: vec![
                    [0.0; 3],
                    [1.0, 0.0, 0.0],
                    [1.0, 1.0, 0.0],
                    [0.0, 1.0, 0.0],
                    [x, 0.0, z],
                    [x, 1.0, z],
                ],
                triangles: vec![[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]],
                ..Mesh::default()
            };
            mesh.crease_normals(0.5);
            assert_eq!(mesh.positions.len(), vertices);
            assert_eq!(mesh.normals[0], [0.0, 0.0, -1.0]);
            let corner = mesh.triangles[2][0] as usize;
            assert_eq!(mesh.positions[corner], [1.0, 0.0, 0.0]);
            assert!(mesh.normals[corner][0].abs() > if vertices == 8 { 0.99 } else { 0.01 });
        }
    }

    #[test]
    fn where_very_many_meet_all_count() {
        // Each compared with each would be ten milliards.
        let count = 100_000;
        let rim = |k: u32| {
            let [x, y] = super::super::vector::turn(f64::from(k) / f64::from(count));
            [x, y, 1.0]
        };
        let mut mesh = Mesh {
            positions: (0..count).map(rim).chain([[0.0; 3]]).collect(),
            triangles: (0..count).map(|k| [count, k, (k + 1) % count]).collect(),
            ..Mesh::default()
        };
        mesh.crease_normals(0.5);
        // One normal at the tip, though its triangles lie at right angles.
        assert_eq!(mesh.positions.len(), count as usize + 1);
        assert!(dot(mesh.normals[count as usize], [0.0, 0.0, -1.0]) > 0.999);
    }

    #[test]
    fn contradictions_are_refused() {
        let refused = |change: fn(&mut Mesh), lit, text: &str| {
            let mut mesh = square();
            change(&mut mesh);
            let error = mesh.check(3, lit).unwrap_err().to_string();
            assert!(error.starts_with("mesh 3: ") && error.contains(text), "{error}");
        };
        refused(|_| (), true, "normals");
        refused(|m| m.positions[1][2] = f64::NAN, false, "vertex 1");
        refused(|m| m.positions[1][2] = 1e10, false, "vertex 1");
        refused(|m| m.triangles[1][2] = 5, false, "vertex 5 of 5");
        refused(|m| m.faces.push(vec![0; 7]), false, "3 to 6");
        refused(|m| m.colours = Colours::Face(vec![[0; 3]]), false, "1 for 2");
        refused(|m| m.texture_coordinates = vec![[2000.0, 0.0]; 5], false, "repeats");
    }
}
