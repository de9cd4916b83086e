//! The lines of an OBJ file, which are drawn as wire frames are.

use super::super::mesh::Mesh;
use super::super::place::{place, Placement};
use super::super::vector::Vec3;
use super::super::wires::{self, Line};
use super::super::{Camera, Material, Scene};
use super::material::Look;
use super::parse::{Element, Parsed};
use crate::config::Config;
use crate::formats::Formats;

/// Lines between neighbouring points of a file's `l` statements, in the colours of their vertices, or
/// else in that of their material.
pub fn lines(parsed: &Parsed, looks: &[Look], materials: &[Material]) -> Vec<Line> {
    let of_element = |element: &Element| {
        let look = &looks[(element.material as usize).min(looks.len() - 1)];
        let byte = |n: f64| (n.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8;
        let plain = materials[look.material as usize].diffuse.map(byte);
        let colour = |k: usize| parsed.colours.get(k).copied().flatten().unwrap_or(plain);
        let line = |ends: [usize; 2]| Line {
            ends: ends.map(|k| parsed.positions[k]),
            colours: ends.map(colour),
        };
        let pairs = parsed.corners(element).windows(2);
        pairs.map(|pair| line([0, 1].map(|k| pair[k].vertex as usize))).collect::<Vec<_>>()
    };
    parsed.lines.iter().flat_map(of_element).collect()
}

/// Places the meshes of a scene and lines together, and adds the lines as a mesh.
pub fn place_with_lines(scene: &mut Scene, lines: Vec<Line>, placement: &Placement) {
    if lines.is_empty() {
        return place(scene, placement);
    }
    let positions = lines.iter().flat_map(|line| line.ends).collect();
    scene.meshes.push(Mesh { positions, ..Mesh::default() });
    place(scene, placement);
    let placed: Vec<Vec3> = scene.meshes.pop().map(|mesh| mesh.positions).unwrap_or_default();
    let ends = placed.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
    let lines: Vec<Line> =
        lines.iter().zip(ends).map(|(line, ends)| Line { ends, ..*line }).collect();
    // The snapping of this camera is not used.
    let formats = Formats::new(&Config::DEFAULT);
    let camera = Camera::new(&scene.rig, scene.width, scene.height, &formats);
    let material = scene.materials.len() as u32;
    scene.materials.push(Material::default());
    scene.meshes.push(Mesh { material, ..wires::mesh(&lines, &camera) });
}
