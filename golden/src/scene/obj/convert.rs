//! Meshes of the faces of an OBJ file: cut into triangles, with normals at all corners.

use super::super::cut::{cut, Cut};
use super::super::mesh::{face_normal, Colours, Mesh, REPEAT_LIMIT};
use super::super::vector::Vec3;
use super::super::warning::Warnings;
use super::material::{Look, Pattern};
use super::parse::{Element, Parsed, NONE};
use crate::progress::over;
use std::collections::HashMap;
use std::path::Path;

/// Cosine of the largest angle at which triangles are shaded as one smooth surface.
const CREASE: f64 = 0.5;
/// Colour of vertices without one where others have one.
const WHITE: [u8; 3] = [255; 3];

/// A triangle of a face. There are millions: indices have 32 bits.
struct Piece {
    /// Index of the face.
    face: u32,
    /// Indices of its corners among those of the file.
    corners: [u32; 3],
    /// Indices of its normals.
    normals: [u32; 3],
}

/// Properties that the faces of a mesh have in common.
#[derive(Clone, Copy, PartialEq)]
struct Layout {
    material: u32,
    coloured: bool,
    pattern: Option<Pattern>,
}

/// The faces as meshes in the order of the file, which is that of ids. `looks` are those of the
/// materials that the file names, then that of faces without.
pub fn meshes(
    file: &Path,
    parsed: &mut Parsed,
    looks: &[Look],
    warnings: &mut Warnings,
) -> Vec<Mesh> {
    let (pieces, normals) = pieces(parsed);
    let parsed = &*parsed;
    let mut meshes: Vec<Mesh> = Vec::new();
    let mut builder: Option<Builder> = None;
    let faces = pieces.chunk_by(|a, b| a.face == b.face);
    for of_face in over("making meshes", "faces", faces) {
        let face = of_face[0].face;
        let element = &parsed.faces[face as usize];
        let look = &looks[(element.material as usize).min(looks.len() - 1)];
        let mut layout = layout(parsed, element, look);
        if layout.pattern.is_some_and(|pattern| !repeats_are_few(parsed, element, pattern)) {
            let problem = "more than 1024 repeats of a texture; drawn without texture";
            warnings.add(file, element.line, "f", problem, "");
            layout.pattern = None;
        }
        if builder.as_ref().is_none_or(|builder| builder.layout != layout) {
            meshes.extend(builder.take().map(|builder| builder.mesh));
            builder = Some(Builder::new(layout, face));
        }
        if let Some(builder) = &mut builder {
            of_face.iter().for_each(|piece| builder.add(parsed, &normals, piece));
        }
    }
    meshes.extend(builder.map(|builder| builder.mesh));
    meshes
}

/// Triangles of all faces, and the normals of their corners: those of the file; where it has none,
/// smooth ones; where one is no direction, the face's own. Where a face crosses itself the file gets
/// corners more.
fn pieces(parsed: &mut Parsed) -> (Vec<Piece>, Vec<Vec3>) {
    let mut pieces = Vec::new();
    over("cutting faces into triangles", "faces", 0..parsed.faces.len())
        .for_each(|face| cut_face(parsed, face, &mut pieces));
    let mut normals: Vec<Vec3> = parsed.normals.iter().map(|n| n.unwrap_or_default()).collect();
    // Pieces without normals, and their vertices as a mesh.
    let mut bare = Vec::new();
    let mut smooth = Mesh::default();
    for (first, of_face) in chunks(&mut pieces) {
        let mut own = None;
        let face = of_face[0].face as usize;
        let mut normal = |index: u32| match parsed.normals.get(index as usize) {
            Some(None) => *own.get_or_insert_with(|| {
                let corners = parsed.corners(&parsed.faces[face]).iter();
                let places: Vec<Vec3> =
                    corners.map(|c| parsed.positions[c.vertex as usize]).collect();
                normals.push(face_normal(&places));
                normals.len() as u32 - 1
            }),
            _ => index,
        };
        for (n, piece) in of_face.iter_mut().enumerate() {
            let corners = piece.corners.map(|k| parsed.corners[k as usize]);
            if corners[0].attributes[1] == NONE {
                bare.push(first + n);
                smooth.triangles.push(corners.map(|c| c.vertex));
            }
            piece.normals = corners.map(|c| normal(c.attributes[1]));
        }
    }
    if !bare.is_empty() {
        smooth.positions = parsed.positions.clone();
        smooth.crease_normals(CREASE);
        for (&piece, triangle) in bare.iter().zip(&smooth.triangles) {
            pieces[piece].normals = triangle.map(|n| n + normals.len() as u32);
        }
        normals.append(&mut smooth.normals);
    }
    (pieces, normals)
}

/// The pieces face by face, with the index of the first.
fn chunks(pieces: &mut [Piece]) -> impl Iterator<Item = (usize, &mut [Piece])> {
    let mut next = 0;
    pieces.chunk_by_mut(|a, b| a.face == b.face).map(move |of_face| {
        let first = next;
        next += of_face.len();
        (first, of_face)
    })
}

/// Adds the triangles of a face, still without normals. What is at points where the face crosses itself is
/// added to the corners.
fn cut_face(parsed: &mut Parsed, face: usize, pieces: &mut Vec<Piece>) {
    let element = parsed.faces[face];
    let corners = parsed.corners(&element).iter();
    let places: Vec<Vec3> = corners.map(|c| parsed.positions[c.vertex as usize]).collect();
    let Cut { triangles, crossings } = cut(&places);
    let first = element.first as u32;
    let mut corners: Vec<u32> = (first..first + element.count as u32).collect();
    for crossing in crossings {
        let ends = crossing.edge.map(|k| parsed.corners[element.first + k]);
        corners.push(parsed.corners.len() as u32);
        parsed.cross(&crossing, ends);
    }
    let piece = |triangle: &[usize; 3]| Piece {
        face: face as u32,
        corners: triangle.map(|k| corners[k]),
        normals: [NONE; 3],
    };
    pieces.extend(triangles.iter().map(piece));
}

fn layout(parsed: &Parsed, face: &Element, look: &Look) -> Layout {
    let corners = parsed.corners(face);
    let coloured = |vertex: u32| parsed.colours.get(vertex as usize).is_some_and(Option::is_some);
    let textured = corners.iter().all(|c| {
        let point = parsed.texture.get(c.attributes[0] as usize);
        point.is_some_and(Option::is_some)
    });
    Layout {
        material: look.material,
        // Among coloured faces one that has no material either is white.
        coloured: !parsed.colours.is_empty()
            && (look.is_default || corners.iter().any(|c| coloured(c.vertex))),
        pattern: look.pattern.filter(|_| textured),
    }
}

/// True if no texture point of a face, in repeats, exceeds the limit.
fn repeats_are_few(parsed: &Parsed, face: &Element, pattern: Pattern) -> bool {
    let points = parsed.corners(face).iter().map(|c| parsed.texture[c.attributes[0] as usize]);
    points.flatten().flat_map(|point| pattern.at(point)).all(|n| n.abs() <= REPEAT_LIMIT)
}

/// A mesh that is made.
struct Builder {
    layout: Layout,
    /// Index of its first face.
    first: u32,
    mesh: Mesh,
    /// Its vertices by their vertex, texture point and normal.
    known: HashMap<[u32; 3], u32>,
}

impl Builder {
    fn new(layout: Layout, first: u32) -> Builder {
        let mut mesh = Mesh { material: layout.material, ..Mesh::default() };
        if layout.coloured {
            mesh.colours = Colours::Vertex(Vec::new());
        }
        Builder { layout, first, mesh, known: HashMap::new() }
    }

    fn add(&mut self, parsed: &Parsed, normals: &[Vec3], piece: &Piece) {
        let triangle = [0, 1, 2].map(|k| {
            let corner = parsed.corners[piece.corners[k] as usize];
            let texture = self.layout.pattern.map_or(NONE, |_| corner.attributes[0]);
            let next = self.mesh.positions.len() as u32;
            let key = [corner.vertex, texture, piece.normals[k]];
            let vertex = *self.known.entry(key).or_insert(next);
            if vertex == next {
                self.vertex(parsed, corner.vertex as usize, texture, normals[key[2] as usize]);
            }
            vertex
        });
        self.mesh.triangles.push(triangle);
        self.mesh.triangle_ids.push(piece.face - self.first);
    }

    fn vertex(&mut self, parsed: &Parsed, vertex: usize, texture: u32, normal: Vec3) {
        self.mesh.positions.push(parsed.positions[vertex]);
        self.mesh.normals.push(normal);
        if let Colours::Vertex(colours) = &mut self.mesh.colours {
            colours.push(parsed.colours[vertex].unwrap_or(WHITE));
        }
        let point = parsed.texture.get(texture as usize).copied().flatten();
        if let Some((pattern, point)) = self.layout.pattern.zip(point) {
            self.mesh.texture_coordinates.push(pattern.at(point));
        }
    }
}
