//! Wire frames: lines one pixel thick, as quadrilaterals that are drawn like any polygon.
//!
//! A line is cut at the near and far planes, or those of each partition of a piecewise projection,
//! and what is left becomes two triangles of the line's id. If it is rather
//! upright on the screen, it is one pixel wide across, else one pixel high: it has one pixel in
//! every row or column that it passes, for both eyes. Where it is upright for one eye and flat
//! for the other, it is made thick enough to have no gaps in either view, up to [`THICKEST`].

use super::error::{SceneError, LINE_LIMIT};
use super::mesh::{Colours, Mesh};
use super::shading::Shading;
use super::vector::{extent, mix, Vec3};
use super::{Camera, Lens, Material, Scene};
use crate::config::Config;
use crate::formats::{Eye, Formats};
use crate::progress::over;
use std::collections::HashMap;

/// Greatest thickness of a line, in pixels.
pub const THICKEST: f64 = 2.0;

/// Thickness added to lines that must be thicker than a pixel, in pixels.
const SLACK: f64 = 1.0 / 16.0;

/// A straight line between two points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Line {
    /// Its ends.
    pub ends: [Vec3; 2],
    /// Colours there.
    pub colours: [[u8; 3]; 2],
}

/// The lines as polygons for a camera, of which the id is the index of the line.
pub fn mesh(lines: &[Line], camera: &Camera) -> Mesh {
    let mut mesh = Mesh::default();
    let mut colours = Vec::new();
    for (id, line) in over("placing lines", "lines", lines).enumerate() {
        for lens in camera.lenses() {
            let Some(line) = line.within(lens) else { continue };
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners(line.ends, lens));
            colours.extend([0, 0, 1, 1].map(|end: usize| line.colours[end]));
            mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|n| first + n)));
            mesh.triangle_ids.extend([id as u32; 2]);
        }
    }
    mesh.colours = Colours::Vertex(colours);
    mesh.lines = true;
    mesh
}

impl Line {
    /// The part of the line that is a lens's.
    fn within(&self, lens: &Lens) -> Option<Line> {
        if !lens.reaches(extent(self.ends.iter().map(|p| p[2]))) {
            return None;
        }
        let mut inside = [0.0, 1.0];
        for plane in lens.depth_planes() {
            let [from, to] = self.ends.map(|p| plane.at(p));
            let crossing = from / (from - to);
            match (from >= 0.0, to >= 0.0) {
                (false, true) => inside[0] = f64::max(inside[0], crossing),
                (true, false) => inside[1] = f64::min(inside[1], crossing),
                _ => {}
            }
        }
        let [near, far] = lens.depth_range();
        Some(Line {
            ends: inside.map(|t| {
                let [x, y, z] = mix(self.ends[0], self.ends[1], t);
                [x, y, z.clamp(near, far)]
            }),
            colours: inside.map(|t| {
                let [from, to] = self.colours.map(|colour| colour.map(f64::from));
                mix(from, to, t).map(|n| n.round() as u8)
            }),
        })
    }
}

/// Corners of a line's quadrilateral: two at its first end, then two at its second.
fn corners(ends: [Vec3; 2], lens: &Lens) -> [Vec3; 4] {
    let run = Eye::BOTH.map(|eye| {
        let [from, to] = ends.map(|p| lens.pixel(p, eye));
        [to[0] - from[0], to[1] - from[1]]
    });
    // How thick it must be across, or upward, to have a pixel in every column, or row. A quotient
    // that is not defined, as for an end-on line, leaves the largest as it is.
    let least =
        |axis: usize| run.iter().map(|run| (run[axis] / run[1 - axis]).abs()).fold(1.0, f64::max);
    let [across, upward] = [least(0), least(1)];
    let axis = usize::from(across > upward);
    let thickness = across.min(upward);
    // One pixel stays one when corners are snapped to subpixels; what is slanted needs some more.
    let half = (if thickness > 1.0 { thickness + SLACK } else { 1.0 }).min(THICKEST) / 2.0;
    let side = |p: Vec3, pixels: f64| {
        let mut moved = p;
        moved[axis] += 1.0;
        // Linear in x and y, so that one unit tells how many pixels a unit is.
        let unit = lens.pixel(moved, Eye::Left)[axis] - lens.pixel(p, Eye::Left)[axis];
        moved[axis] = p[axis] + pixels / unit;
        moved
    };
    let [from, to] = ends;
    [side(from, -half), side(from, half), side(to, half), side(to, -half)]
}

/// The edges of a scene's polygons as lines in a scene of its own, without light: they have the
/// colours that the polygons have at their ends, lit, for both eyes alike, without texture.
///
/// Edges between triangles of one polygon are left out, and edges of several polygons are drawn
/// once, in the colour of the first. Lines stay as they are, and come last. More edges than [`LINE_LIMIT`] are an
/// error.
pub fn wire_frame(scene: &Scene) -> Result<Scene, SceneError> {
    scene.check()?;
    let mut edges = Edges::default();
    for mesh in scene.meshes.iter().filter(|mesh| !mesh.lines) {
        edges.add_mesh(scene, mesh)?;
    }
    // The snapping of this camera is not used.
    let formats = Formats::new(&Config::DEFAULT);
    let camera = Camera::new(&scene.rig, scene.width, scene.height, &formats);
    let lines = scene.meshes.iter().filter(|mesh| mesh.lines).cloned();
    let meshes = [mesh(&edges.lines(), &camera)].into_iter().chain(lines);
    Ok(Scene {
        lighting: None,
        materials: vec![Material::default()],
        textures: Vec::new(),
        meshes: meshes.map(|mesh| Mesh { material: 0, ..mesh }).collect(),
        ..scene.clone()
    })
}

/// Edges of polygons, each once.
#[derive(Default)]
struct Edges {
    /// Index of the edge between two places.
    known: HashMap<[[u64; 3]; 2], usize>,
    edges: Vec<Edge>,
    /// Polygons so far.
    polygons: u32,
}

struct Edge {
    line: Line,
    /// The polygon that it was found at first.
    polygon: u32,
    /// The polygon has it twice: it lies between two of its triangles.
    inner: bool,
    /// Another polygon has it too.
    shared: bool,
}

impl Edges {
    fn add_mesh(&mut self, scene: &Scene, mesh: &Mesh) -> Result<(), SceneError> {
        let mut shading = Shading::new(scene, mesh, Eye::BOTH.map(|eye| scene.rig.eye(eye)));
        let common = |eyes: [[f64; 4]; 2]| -> [u8; 3] {
            std::array::from_fn(|n| ((eyes[0][n] + eyes[1][n]) / 2.0).round() as u8)
        };
        let triangles = over("finding edges", "triangles", &mesh.triangles);
        for (n, triangle) in triangles.enumerate() {
            let colours = shading.triangle(n).map(common);
            let id = mesh.triangle_ids.get(n).copied().unwrap_or(n as u32);
            self.add_polygon(mesh, triangle, &colours, self.polygons + id)?;
        }
        self.polygons += mesh.triangle_id_count() as u32;
        for (n, face) in mesh.faces.iter().enumerate() {
            let colours = vec![common(shading.face(n)); face.len()];
            self.add_polygon(mesh, face, &colours, self.polygons + n as u32)?;
        }
        self.polygons += mesh.faces.len() as u32;
        Ok(())
    }

    fn add_polygon(
        &mut self,
        mesh: &Mesh,
        corners: &[u32],
        colours: &[[u8; 3]],
        polygon: u32,
    ) -> Result<(), SceneError> {
        for (k, &from) in corners.iter().enumerate() {
            let next = (k + 1) % corners.len();
            let ends = [from, corners[next]].map(|n| mesh.positions[n as usize]);
            let line = Line { ends, colours: [colours[k], colours[next]] };
            // + 0.0 makes one place of 0 and -0.
            let mut places = ends.map(|p| p.map(|n| (n + 0.0).to_bits()));
            places.sort_unstable();
            let at = *self.known.entry(places).or_insert(self.edges.len());
            match self.edges.get_mut(at) {
                Some(edge) if edge.polygon == polygon => edge.inner = true,
                Some(edge) => edge.shared = true,
                None if at == LINE_LIMIT => return Err(SceneError::Edges),
                None => self.edges.push(Edge { line, polygon, inner: false, shared: false }),
            }
        }
        Ok(())
    }

    fn lines(&self) -> Vec<Line> {
        let drawn = self.edges.iter().filter(|edge| edge.shared || !edge.inner);
        drawn.map(|edge| edge.line).collect()
    }
}
