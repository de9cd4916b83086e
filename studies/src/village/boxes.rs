//! Scenes for the BSP tree: from 144 to 960 polygons.

use wheatstone_golden::scene::vector::{add, outward, rotate, unit, Vec3};
use wheatstone_golden::scene::{builtin, Mesh, Scene, SceneError};

/// Triangles of a box.
pub const TRIANGLES: usize = 12;

/// Turned boxes before and behind the screen, lit; some pass through others.
pub fn boxes(count: usize, width: u32, height: u32) -> Result<Scene, SceneError> {
    let mut mesh = Mesh::default();
    for n in 1..=count {
        // The fractions of multiples of irrational numbers cover the room evenly.
        let part = |step: f64| (n as f64 * step).fract();
        let [s, t, u] = [0.754_877_666, 0.569_840_291, 0.381_966_011].map(part);
        let centre = [28.0 * s - 14.0, 20.0 * t - 10.0, 24.0 * u - 8.0];
        let half = [0.7 + 0.6 * t, 0.7 + 0.6 * u, 0.7 + 0.6 * s];
        solid(&mut mesh, centre, half, [360.0 * s, 360.0 * t]);
    }
    // Eyes, screen, light and material of the village.
    Ok(Scene { meshes: vec![mesh], ..builtin::scene("village", width, height)? })
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

#[cfg(test)]
mod tests {
    use super::*;
    use wheatstone_golden::scene::vector::{dot, sub};

    #[test]
    fn boxes_face_outward() {
        let scene = boxes(5, 320, 240).expect("a size that is known");
        let mesh = &scene.meshes[0];
        assert_eq!(mesh.triangles.len(), 5 * TRIANGLES);
        for (n, triangle) in mesh.triangles.iter().enumerate() {
            let corners = &mesh.positions[n / TRIANGLES * 24..][..24];
            let middle = corners.iter().copied().fold([0.0; 3], add).map(|n| n / 24.0);
            let [a, b, c] = triangle.map(|n| mesh.positions[n as usize]);
            let normal = outward(a, b, c);
            assert!(dot(normal, sub(a, middle)) > 0.0);
            assert!(dot(normal, mesh.normals[triangle[0] as usize]) > 0.0);
        }
    }
}
