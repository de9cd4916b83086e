//! Adelson et al. 1991, hidden surfaces and the simple renderer: BSP tree and one z-buffer,
//! scan line, and the village.

use wheatstone_golden::scene::vector::{add, outward, rotate, unit, Vec3};
use wheatstone_golden::scene::{Lighting, Material, Mesh, Scene};

/// Turned boxes, 12 triangles each, before and behind the screen; some pass through others.
pub fn boxes(count: usize, width: u32, height: u32) -> Scene {
    let mut mesh = Mesh::default();
    let part = |n: usize, step: f64| (n as f64 * step).fract();
    for n in 0..count {
        // The fractions of multiples of irrational numbers cover the room evenly.
        let [s, t, u] = [0.754_877_666, 0.569_840_291, 0.381_966_011].map(|step| part(n + 1, step));
        let centre = [28.0 * s - 14.0, 20.0 * t - 10.0, 24.0 * u - 8.0];
        let half = [1.1 + 1.2 * t, 1.1 + 1.2 * u, 1.1 + 1.2 * s];
        solid(&mut mesh, centre, half, [360.0 * s, 360.0 * t]);
    }
    Scene {
        width,
        height,
        rig: wheatstone_golden::scene::Rig {
            pixels_per_unit: (f64::from(width) / 32.0).min(f64::from(height) / 24.0),
            ..Default::default()
        },
        background: [24, 26, 32],
        lighting: Some(Lighting::default()),
        materials: vec![Material::default()],
        meshes: vec![mesh],
        ..Scene::default()
    }
}

/// Adds a box of half this size, turned about two axes.
fn solid(mesh: &mut Mesh, centre: Vec3, half: Vec3, turn: [f64; 2]) {
    let place = |corner: Vec3| add(rotate(rotate(corner, 0, turn[0]), 1, turn[1]), centre);
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let corner = |u: f64, v: f64| {
                let mut corner = [0.0; 3];
                corner[axis] = sign * half[axis];
                corner[(axis + 1) % 3] = u * half[(axis + 1) % 3];
                corner[(axis + 2) % 3] = sign * v * half[(axis + 2) % 3];
                place(corner)
            };
            let corners =
                [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
            let normal = unit(outward(corners[0], corners[1], corners[2]));
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners);
            mesh.normals.extend([normal; 4]);
            mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|n| n + first)));
        }
    }
}
