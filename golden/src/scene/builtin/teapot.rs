//! The Utah teapot: Martin Newell's test model of 1975, 32 bicubic Bézier patches with bottom.
//!
//! The control points are his (z upward, spout along x, y in depth), kept here by their
//! symmetries. Rim, body, lid and bottom are quarters of nearly round bowls, given by a profile;
//! handle and spout are half tubes, given by an inner and an outer line.

use super::empty::desk;
use super::shapes::{append, surface, Sample};
use crate::scene::vector::{add, cross, dot, rotate, scale, unit, Vec3};
use crate::scene::{Environment, Light, Lighting, Material, Mesh, Scene, Source};

/// Quarter arcs of rim and body from the top: radius, the coordinate of the two middle control
/// points that makes the arc nearly round, and height.
const BODY: [[f64; 3]; 10] = [
    [1.4, 0.784, 2.4],
    [1.3375, 0.749, 2.53125],
    [1.4375, 0.805, 2.53125],
    [1.5, 0.84, 2.4],
    [1.75, 0.98, 1.875],
    [2.0, 1.12, 1.35],
    [2.0, 1.12, 0.9],
    [2.0, 1.12, 0.45],
    [1.5, 0.84, 0.225],
    [1.5, 0.84, 0.15],
];
/// The lid, from its knob.
const LID: [[f64; 3]; 7] = [
    [0.0, 0.0, 3.15],
    [0.8, 0.45, 3.15],
    [0.0, 0.0, 2.85],
    [0.2, 0.112, 2.7],
    [0.4, 0.224, 2.55],
    [1.3, 0.728, 2.55],
    [1.3, 0.728, 2.4],
];
/// The bottom, from the body inward.
const BOTTOM: [[f64; 3]; 4] =
    [[1.5, 0.84, 0.15], [1.5, 0.84, 0.075], [1.425, 0.798, 0.0], [0.0, 0.0, 0.0]];
/// Sections of the handle from its upper end: x and z of the inner and of the outer line, and
/// half the width.
const HANDLE: [[f64; 5]; 7] = [
    [-1.6, 2.025, -1.5, 2.25, 0.3],
    [-2.3, 2.025, -2.5, 2.25, 0.3],
    [-2.7, 2.025, -3.0, 2.25, 0.3],
    [-2.7, 1.8, -3.0, 1.8, 0.3],
    [-2.7, 1.575, -3.0, 1.35, 0.3],
    [-2.5, 1.125, -2.65, 0.9375, 0.3],
    [-2.0, 0.9, -1.9, 0.6, 0.3],
];
/// Sections of the spout from the body: upper and lower line.
const SPOUT: [[f64; 5]; 7] = [
    [1.7, 1.425, 1.7, 0.6, 0.66],
    [2.6, 1.425, 3.1, 0.825, 0.66],
    [2.3, 2.1, 2.4, 2.025, 0.25],
    [2.7, 2.4, 3.3, 2.4, 0.25],
    [2.8, 2.475, 3.525, 2.49375, 0.25],
    [2.9, 2.475, 3.45, 2.5125, 0.15],
    [2.8, 2.4, 3.2, 2.4, 0.15],
];

/// Cells a side of each patch in the built-in scenes: 6,320 triangles.
pub const DEFAULT_LEVEL: u32 = 10;

/// Control points in Newell's coordinates: down the profile or along the tube, then across it.
struct Patch {
    points: [[Vec3; 4]; 4],
    /// 1 where the two derivatives turn so that their product points outward, else -1; every
    /// mirroring changes it.
    side: f64,
}

/// The 32 patches.
fn patches() -> Vec<Patch> {
    let mut patches = Vec::with_capacity(32);
    for profile in [&BODY[..], &LID, &BOTTOM] {
        for rows in profile.windows(4).step_by(3) {
            for [sx, sy] in [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]] {
                let points = [0, 1, 2, 3].map(|k| {
                    let [r, q, z] = rows[k];
                    [[r, 0.0], [r, q], [q, r], [0.0, r]].map(|[x, y]| [sx * x, sy * y, z])
                });
                patches.push(Patch { points, side: sx * sy });
            }
        }
    }
    for tube in [&HANDLE, &SPOUT] {
        for rows in tube.windows(4).step_by(3) {
            for sy in [-1.0, 1.0] {
                let points = [0, 1, 2, 3].map(|k| {
                    let [x0, z0, x1, z1, y] = rows[k];
                    [[x0, 0.0, z0], [x0, sy * y, z0], [x1, sy * y, z1], [x1, 0.0, z1]]
                });
                patches.push(Patch { points, side: sy });
            }
        }
    }
    patches
}

/// Weights of the control points at `t`, and their derivatives.
fn bernstein(t: f64) -> [[f64; 4]; 2] {
    let s = 1.0 - t;
    [
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
        [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t],
    ]
}

/// Place and normal on a patch; the normal is zero where the patch is one point.
fn evaluate(patch: &Patch, along: f64, across: f64) -> (Vec3, Vec3) {
    let ([b, db], [c, dc]) = (bernstein(along), bernstein(across));
    let points = patch.points.map(|row| blend(row, c));
    let slopes = patch.points.map(|row| combine(row, dc));
    (combine(points, b), cross(combine(points, db), combine(slopes, b)))
}

fn combine(points: [Vec3; 4], weights: [f64; 4]) -> Vec3 {
    points.into_iter().zip(weights).fold([0.0; 3], |sum, (p, w)| add(sum, scale(p, w)))
}

/// A mean with weights that add up to 1, without rounding where the points are one.
fn blend(points: [Vec3; 4], weights: [f64; 4]) -> Vec3 {
    if points == [points[0]; 4] {
        return points[0];
    }
    combine(points, weights)
}

/// The teapot with `level` × `level` cells a patch: 64 level² − 8 level triangles.
///
/// In Newell's units and left-handed coordinates: it stands on y = 0, is 3.15 high, and its
/// spout points to the right. It has no texture coordinates.
pub fn teapot(level: u32) -> Mesh {
    let level = level.clamp(1, 256);
    let mut mesh = Mesh::default();
    for patch in patches() {
        let part = surface(level, level, |across, along| {
            let (position, normal) = evaluate(&patch, along, across);
            let normal = if dot(normal, normal) < 1e-20 {
                // At the poles of lid and bottom.
                [0.0, 0.0, if position[2] > 1.0 { 1.0 } else { -1.0 }]
            } else {
                unit(scale(normal, patch.side))
            };
            let swap = |[x, y, z]: Vec3| [x, z, y];
            Sample { position: swap(position), normal: swap(normal), texture: [0.0; 2] }
        });
        append(&mut mesh, &part);
    }
    mesh.texture_coordinates.clear();
    mesh
}

/// The teapot on its own, glazed, seen a little from above.
pub fn scene(width: u32, height: u32) -> Scene {
    let mut mesh = teapot(DEFAULT_LEVEL);
    let turned = |p: Vec3| rotate(rotate(p, 1, -20.0), 0, -22.0);
    // Centred between handle and spout, half-way up; 3.75 cm to one of Newell's units.
    mesh.transform(|p| scale(turned(add(p, [-0.2, -1.5, 0.0])), 3.75), turned);
    let key = Light { source: Source::Direction([-2.2, 3.0, -4.0]), colour: [0.78, 0.76, 0.72] };
    let fill = Light { source: Source::Direction([5.0, 0.5, -1.0]), colour: [0.2, 0.24, 0.32] };
    Scene {
        background: [36, 42, 54],
        lighting: Some(Lighting { ambient: [0.26, 0.26, 0.29], lights: vec![key, fill] }),
        environment: Environment::default(),
        materials: vec![Material {
            diffuse: [0.84, 0.58, 0.38],
            specular: [0.6; 3],
            exponent: 48,
            ..Material::default()
        }],
        meshes: vec![mesh],
        ..desk(width, height)
    }
}
