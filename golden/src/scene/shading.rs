//! Colours of the corners of a mesh, lit once a vertex and side.

use super::light::{Lighting, Material, Point};
use super::mesh::{face_normal, outside, Colours, Mesh};
use super::vector::{add, dot, scale, sub, Vec3};
use super::Scene;

/// Red, green, blue, alpha for each eye, 0 to 255.
type Colour = [[f64; 4]; 2];

/// Colours of the corners of a mesh.
pub(super) struct Shading<'a> {
    scene: &'a Scene,
    mesh: &'a Mesh,
    material: &'a Material,
    eyes: [Vec3; 2],
    middle: Vec3,
    /// Colours of each vertex that has been lit, seen from outside and from inside.
    known: Vec<[Option<Colour>; 2]>,
}

impl<'a> Shading<'a> {
    /// The mesh as these eyes see it. Nothing is lit before it is asked for.
    pub fn new(scene: &'a Scene, mesh: &'a Mesh, eyes: [Vec3; 2]) -> Shading<'a> {
        Shading {
            scene,
            mesh,
            material: &scene.materials[mesh.material as usize],
            eyes,
            middle: scene.rig.middle(),
            known: vec![[None; 2]; mesh.positions.len()],
        }
    }

    /// Colours of the corners of triangle `n` for each eye.
    pub fn triangle(&mut self, n: usize) -> [Colour; 3] {
        let mesh = self.mesh;
        let triangle = mesh.triangles[n];
        let inside = self.light().is_some() && {
            let corners = triangle.map(|k| mesh.positions[k as usize]);
            let normal = outside(corners, triangle.map(|k| mesh.normals[k as usize]));
            dot(normal, sub(self.middle, corners[0])) < 0.0
        };
        triangle.map(|k| {
            let k = k as usize;
            let base = self.base(k, n);
            if matches!(mesh.colours, Colours::Face(_)) {
                return self.corner(k, base, inside);
            }
            if let Some(colour) = self.known[k][usize::from(inside)] {
                return colour;
            }
            let colour = self.corner(k, base, inside);
            self.known[k][usize::from(inside)] = Some(colour);
            colour
        })
    }

    /// The one colour of face `n` for each eye.
    pub fn face(&self, n: usize) -> Colour {
        let face = &self.mesh.faces[n];
        let corners: Vec<Vec3> = face.iter().map(|&k| self.mesh.positions[k as usize]).collect();
        let base = self.base(face[0] as usize, self.mesh.triangles.len() + n);
        let position = scale(corners.iter().copied().fold([0.0; 3], add), 1.0 / face.len() as f64);
        let normal = face_normal(&corners);
        let inside = dot(normal, sub(self.middle, position)) < 0.0;
        let normal = if inside { normal.map(|n| -n) } else { normal };
        self.lit(Point { position, normal, base })
    }

    /// The lights on the mesh; none on lines.
    fn light(&self) -> Option<&'a Lighting> {
        self.scene.lighting.as_ref().filter(|_| !self.mesh.lines)
    }

    /// Base colour of a corner, 0 to 1.
    fn base(&self, vertex: usize, polygon: usize) -> Vec3 {
        match &self.mesh.colours {
            Colours::Material => self.material.diffuse,
            Colours::Vertex(colours) => colours[vertex].map(|n| f64::from(n) / 255.0),
            Colours::Face(colours) => colours[polygon].map(|n| f64::from(n) / 255.0),
        }
    }

    fn corner(&self, vertex: usize, base: Vec3, inside: bool) -> Colour {
        let normal = self.mesh.normals.get(vertex).copied().unwrap_or_default();
        let normal = if inside { normal.map(|n| -n) } else { normal };
        self.lit(Point { position: self.mesh.positions[vertex], normal, base })
    }

    fn lit(&self, point: Point) -> Colour {
        let colours = match self.light() {
            Some(light) => light.shade(&point, self.material, &self.scene.environment, self.eyes),
            None => [point.base.map(|n| n * 255.0); 2],
        };
        let alpha = self.material.alpha * 255.0;
        colours.map(|[r, g, b]| [r, g, b, alpha].map(|n| n.clamp(0.0, 255.0)))
    }
}
