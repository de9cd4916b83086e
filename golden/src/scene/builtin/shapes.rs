//! Curved and flat surfaces as meshes.

use crate::scene::mesh::{outside, Mesh};
use crate::scene::vector::{add, cross, scale, sub, turn, unit, Vec3};

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Its place.
    pub position: Vec3,
    /// Unit normal on the outside.
    pub normal: Vec3,
    /// Texture coordinates in repeats.
    pub texture: [f64; 2],
}

/// A surface over the unit square, cut into `columns` × `rows` pairs of triangles.
///
/// Triangles wind so that they are counter-clockwise seen from where the normals point; the ones
/// without area, at poles, are left out.
pub fn surface(columns: u32, rows: u32, sample: impl Fn(f64, f64) -> Sample) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let part = |n: u32, of: u32| f64::from(n) / f64::from(of);
            let Sample { position, normal, texture } =
                sample(part(column, columns), part(row, rows));
            mesh.positions.push(position);
            mesh.normals.push(normal);
            mesh.texture_coordinates.push(texture);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let at = row * (columns + 1) + column;
            let below = at + columns + 1;
            triangle(&mut mesh, [at, at + 1, below + 1]);
            triangle(&mut mesh, [at, below + 1, below]);
        }
    }
    mesh
}

fn triangle(mesh: &mut Mesh, corners: [u32; 3]) {
    let [a, b, c] = corners;
    let positions = corners.map(|n| mesh.positions[n as usize]);
    if positions[0] == positions[1] || positions[1] == positions[2] || positions[2] == positions[0]
    {
        return;
    }
    let normals = corners.map(|n| mesh.normals[n as usize]);
    let kept = outside(positions, normals) == outside(positions, [[0.0; 3]; 3]);
    mesh.triangles.push(if kept { corners } else { [a, c, b] });
}

/// Adds the triangles of `more` to a mesh of the same kind.
pub fn append(mesh: &mut Mesh, more: &Mesh) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(&more.positions);
    mesh.normals.extend(&more.normals);
    mesh.texture_coordinates.extend(&more.texture_coordinates);
    mesh.triangles.extend(more.triangles.iter().map(|t| t.map(|n| n + first)));
}

/// A sphere of `columns` meridians and half as many parallels.
pub fn sphere(centre: Vec3, radius: f64, columns: u32) -> Mesh {
    surface(columns, columns / 2, |s, t| {
        let ([x, z], [y, across]) = (turn(s), turn(t / 2.0));
        // The poles are one point however they are reached.
        let across = if t == 0.0 || t == 1.0 { 0.0 } else { across };
        let normal = [across * x, y, across * z];
        let position = add(centre, scale(normal, radius));
        Sample { position, normal, texture: [s * 2.0, t] }
    })
}

/// A torus round the z axis.
pub fn torus(centre: Vec3, radius: f64, thickness: f64, columns: u32) -> Mesh {
    surface(columns, columns / 2, |s, t| {
        let ([x, y], [out, depth]) = (turn(s), turn(t));
        let normal = [x * out, y * out, depth];
        let ring = scale([x, y, 0.0], radius);
        let position = add(centre, add(ring, scale(normal, thickness)));
        Sample { position, normal, texture: [s * 4.0, t] }
    })
}

/// A parallelogram at `corner`, between `right` and `down`, facing their outer product's way
/// that is the viewer's for right = x and down = −y. `repeats` of the texture cover it.
pub fn panel(corner: Vec3, right: Vec3, down: Vec3, repeats: [f64; 2], cells: [u32; 2]) -> Mesh {
    let normal = unit(cross(right, down));
    surface(cells[0], cells[1], |s, t| Sample {
        position: add(corner, add(scale(right, s), scale(down, t))),
        normal,
        texture: [s * repeats[0], t * repeats[1]],
    })
}

/// An upright box. Each side shows the texture once in every `repeat` units of length.
pub fn cuboid(centre: Vec3, size: Vec3, repeat: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let (right, down) = match axis {
                0 => ([0.0, 0.0, sign * size[2]], [0.0, -size[1], 0.0]),
                1 => ([size[0], 0.0, 0.0], [0.0, 0.0, -sign * size[2]]),
                _ => ([-sign * size[0], 0.0, 0.0], [0.0, -size[1], 0.0]),
            };
            let mut face = centre;
            face[axis] += sign * size[axis] / 2.0;
            let corner = sub(face, scale(add(right, down), 0.5));
            let length = |v: Vec3| v.iter().fold(0.0, |m: f64, n| m.max(n.abs())) / repeat;
            append(&mut mesh, &panel(corner, right, down, [length(right), length(down)], [2, 2]));
        }
    }
    mesh
}

/// The surface that a profile of (radius, height) pairs, from its top downward, sweeps out round
/// the y axis.
pub fn turned(centre: Vec3, profile: &[[f64; 2]], columns: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for piece in profile.windows(2) {
        let [[r0, y0], [r1, y1]] = [piece[0], piece[1]];
        let section = surface(columns, 1, |s, t| {
            let [x, z] = turn(s);
            let radius = r0 + (r1 - r0) * t;
            let normal = unit([x * (y0 - y1), r1 - r0, z * (y0 - y1)]);
            let position = add(centre, [x * radius, y0 + (y1 - y0) * t, z * radius]);
            Sample { position, normal, texture: [s, t] }
        });
        append(&mut mesh, &section);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::vector::{dot, outward};

    fn faces_away_from(mesh: &Mesh, centre: Vec3) {
        assert!(!mesh.triangles.is_empty());
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|n| mesh.positions[n as usize]);
            let normal = outward(a, b, c);
            assert!(dot(normal, sub(a, centre)) > 0.0, "{a:?} {normal:?}");
            for n in t {
                assert!(dot(mesh.normals[*n as usize], normal) > 0.0, "{a:?}");
            }
        }
    }

    #[test]
    fn closed_shapes_face_outward() {
        let centre = [1.0, 2.0, 3.0];
        let ball = sphere(centre, 2.0, 24);
        faces_away_from(&ball, centre);
        // Twelve parallels, less half of the triangles at either pole.
        assert_eq!(ball.triangles.len(), 2 * 24 * 12 - 2 * 24);
        faces_away_from(&cuboid(centre, [1.0, 2.0, 4.0], 1.0), centre);
        faces_away_from(&turned(centre, &[[0.0, 1.0], [2.0, 0.5], [0.0, -1.0]], 16), centre);
    }

    #[test]
    fn a_panel_of_x_and_down_faces_the_viewer() {
        let mesh = panel([0.0; 3], [2.0, 0.0, 0.0], [0.0, -1.0, 0.0], [1.0, 1.0], [1, 1]);
        assert!(mesh.normals.iter().all(|n| *n == [0.0, 0.0, -1.0]));
        faces_away_from(&mesh, [0.5, -0.5, 1.0]);
    }
}
