//! Charts of one property each: disparity, ratio of the views, width, number of corners.

use super::empty::chart;
use crate::scene::vector::{add, rotate, scale, turn, Vec3};
use crate::scene::{Colours, Mesh, Scene};

/// Adds single polygons, each of one colour or one a corner.
#[derive(Default)]
pub struct Painter {
    mesh: Mesh,
    vertex_colours: Vec<[u8; 3]>,
}

impl Painter {
    /// A convex polygon as a fan of triangles.
    pub fn polygon(&mut self, corners: &[Vec3], colours: &[[u8; 3]]) {
        let first = self.mesh.positions.len() as u32;
        let corner = |n: usize| first + n as u32;
        self.mesh.positions.extend(corners);
        self.vertex_colours.extend((0..corners.len()).map(|n| colours[n % colours.len()]));
        for n in 1..corners.len() - 1 {
            self.mesh.triangles.push([corner(0), corner(n), corner(n + 1)]);
        }
    }

    /// The scene with these polygons.
    pub fn finish(mut self, mut scene: Scene) -> Scene {
        self.mesh.colours = Colours::Vertex(self.vertex_colours);
        scene.meshes.push(self.mesh);
        scene
    }
}

/// A saturated colour; 0 red, 1/3 green, 2/3 blue.
pub fn hue(h: f64, brightness: f64) -> [u8; 3] {
    [0.0, 1.0, 2.0].map(|n| {
        let away = (h - n / 3.0 + 0.5).rem_euclid(1.0) - 0.5;
        let share = (2.0 - 6.0 * away.abs()).clamp(0.0, 1.0);
        ((0.25 + 0.75 * share) * brightness * 255.0) as u8
    })
}

/// A darker shade.
pub fn dim(colour: [u8; 3], factor: f64) -> [u8; 3] {
    colour.map(|n| (f64::from(n) * factor) as u8)
}

/// Bars of a range of disparities, above a floor that runs through all of them.
pub fn ramp(width: u32, height: u32) -> Scene {
    let (e, d) = (64.0, 640.0);
    let depth = |disparity: f64| disparity * d / (e - disparity);
    // A point that both eyes together see at (x, y) on the screen.
    let behind = |x: f64, y: f64, z: f64| [x * (1.0 + z / d), y * (1.0 + z / d), z];
    let mut painter = Painter::default();
    for bar in 0..17 {
        let disparity = f64::from(bar - 8) * 4.0;
        let z = depth(disparity);
        let x = f64::from(bar - 8) * 34.0;
        let colour = hue(0.62 * f64::from(bar) / 16.0, 1.0);
        let corners = [[-13.0, -40.0], [13.0, -40.0], [13.0, 180.0], [-13.0, 180.0]];
        let [light, dark] = [colour, dim(colour, 0.55)];
        painter.polygon(&corners.map(|[dx, y]| behind(x + dx, y, z)), &[dark, dark, light, light]);
    }
    // Its near end is lowest; its strips have equal steps of disparity.
    for strip in 0..32 {
        let edge = |n: i32| {
            let disparity = f64::from(n) * 2.0 - 32.0;
            let z = depth(disparity);
            (z, (-120.0 - 80.0 * f64::from(32 - n) / 32.0) * (1.0 + z / d))
        };
        let ((z0, y0), (z1, y1)) = (edge(strip), edge(strip + 1));
        let half = |z: f64| 300.0 * (1.0 + z / d);
        let corners =
            [[-half(z0), y0, z0], [half(z0), y0, z0], [half(z1), y1, z1], [-half(z1), y1, z1]];
        let colour = hue(0.62 * f64::from(strip) / 31.0, if strip % 2 == 0 { 0.85 } else { 0.5 });
        painter.polygon(&corners, &[colour]);
    }
    painter.finish(chart(width, height, e))
}

/// Values of G1, row by row. The smallest that hardware maps is 1/29.
const RATIOS: [f64; 32] = [
    1.0,
    0.95,
    0.9,
    0.8,
    0.7,
    0.6,
    0.5,
    0.45,
    0.4,
    0.35,
    0.3,
    0.25,
    0.2,
    1.0 / 6.0,
    1.0 / 7.0,
    1.0 / 8.0,
    1.0 / 10.0,
    1.0 / 12.0,
    1.0 / 14.0,
    1.0 / 16.0,
    1.0 / 18.0,
    1.0 / 20.0,
    1.0 / 22.0,
    1.0 / 24.0,
    1.0 / 26.0,
    1.0 / 28.0,
    1.0 / 29.0,
    1.0 / 29.5,
    1.0 / 32.0,
    1.0 / 64.0,
    0.0,
    -0.1,
];

/// Panels turned about their upright axes.
pub fn ratio(width: u32, height: u32) -> Scene {
    let (e, d) = (320.0, 640.0);
    let mut painter = Painter::default();
    for (n, ratio) in RATIOS.into_iter().enumerate() {
        let (column, row) = (n % 8, n / 8);
        let x = (column as f64 - 3.5) * 78.0;
        let y = (1.5 - row as f64) * 114.0;
        // The plane through (x, 0) whose distances to the two eyes are in the ratio; every other
        // panel has the left eye nearer to its plane.
        let e = if (row + column) % 2 == 0 { e } else { -e };
        let [across, along] = [e / 2.0 - x + ratio * (e / 2.0 + x), d * (ratio - 1.0)];
        let length = (across * across + along * along).sqrt();
        let direction = [across / length, along / length];
        let half = half_width(x, direction, [e, d]);
        let ends = [-half, half].map(|t| [x + t * direction[0], t * direction[1]]);
        // Perspective would make the near end tall.
        let reach = |z: f64| 46.0 * (1.0 + z / d);
        let [[x0, z0], [x1, z1]] = ends;
        let centre = |z: f64| y * (1.0 + z / d);
        let corners = [
            [x0, centre(z0) - reach(z0), z0],
            [x1, centre(z1) - reach(z1), z1],
            [x1, centre(z1) + reach(z1), z1],
            [x0, centre(z0) + reach(z0), z0],
        ];
        let colour = hue(n as f64 / 32.0, 1.0);
        let white = [240, 240, 240];
        painter.polygon(&corners, &[dim(colour, 0.5), colour, white, colour]);
    }
    painter.finish(chart(width, height, e))
}

/// Half the length of a panel that is about 64 pixels wide for the eye that sees it wider.
fn half_width(x: f64, direction: [f64; 2], rig: [f64; 2]) -> f64 {
    let [e, d] = rig;
    let seen = |half: f64, eye: f64| {
        let [a, b] = [-half, half]
            .map(|t| eye + (x + t * direction[0] - eye) / (1.0 + t * direction[1] / d));
        (b - a).abs()
    };
    let (mut least, mut most) = (0.0, 0.6 * d);
    for _ in 0..40 {
        let middle = (least + most) / 2.0;
        if seen(middle, e / 2.0).max(seen(middle, -e / 2.0)) > 64.0 {
            most = middle;
        } else {
            least = middle;
        }
    }
    least
}

/// Thin triangles.
pub fn slivers(width: u32, height: u32) -> Scene {
    let mut painter = Painter::default();
    for n in 0..28 {
        let step = f64::from(n);
        // From 4 pixels down to 1/16.
        let thickness = 4.0 / f64::from(1u32 << (n / 4)) * (1.0 - 0.12 * f64::from(n % 4));
        let lean = f64::from(n % 5 - 2) * 3.0;
        let x = -300.0 + step * 9.5;
        let depth = f64::from(n % 7 - 3) * 20.0;
        let upright = [
            [x, -20.0, depth],
            [x + thickness, -20.0, depth],
            [x + lean + thickness / 2.0, 220.0, -depth],
        ];
        painter.polygon(&upright, &[hue(step / 28.0, 1.0)]);
        let y = -40.0 - step * 6.8;
        let flat = [[-305.0, y, depth], [-35.0, y + lean, -depth], [-305.0, y + thickness, depth]];
        painter.polygon(&flat, &[hue(step / 28.0 + 0.5, 1.0)]);
    }
    // Rays from the middle of the right half, far and near in turn.
    for n in 0..72 {
        let ray = |fraction: f64, radius: f64, z: f64| {
            let [x, y] = turn(fraction);
            [150.0 + radius * x, radius * y, z]
        };
        let at = f64::from(n) / 72.0;
        let breadth = 0.004 / f64::from(1 + n % 6);
        let depth = if n % 2 == 0 { 60.0 } else { -60.0 };
        let corners = [ray(at, 14.0, 0.0), ray(at + breadth, 200.0, depth), ray(at, 200.0, depth)];
        painter.polygon(&corners, &[[255, 255, 255], hue(at, 1.0), hue(at, 0.7)]);
    }
    painter.finish(chart(width, height, 64.0))
}

/// Convex polygons of four to six corners.
pub fn polygons(width: u32, height: u32) -> Scene {
    let mut scene = chart(width, height, 64.0);
    let mut mesh = Mesh::default();
    let mut colours = Vec::new();
    for row in 0..3u32 {
        for column in 0..5u32 {
            let corners = row + 4;
            let n = row * 5 + column;
            let centre = [
                (f64::from(column) - 2.0) * 114.0,
                (1.0 - f64::from(row)) * 150.0,
                f64::from(n % 4) * 60.0 - 90.0,
            ];
            let tilt = |p: Vec3| {
                let p = rotate(p, 2, 11.0 * f64::from(n));
                let p = rotate(p, 0, 14.0 * (f64::from(column) - 2.0));
                rotate(p, 1, 24.0 * (f64::from(row + column % 3) - 2.0))
            };
            let first = mesh.positions.len() as u32;
            for k in 0..corners {
                let [x, y] = turn(f64::from(k) / f64::from(corners));
                mesh.positions.push(add(centre, tilt(scale([x, y, 0.0], 50.0))));
            }
            mesh.faces.push((first..first + corners).collect());
            colours.push(hue(f64::from(n) / 15.0, 0.95));
        }
    }
    mesh.colours = Colours::Face(colours);
    scene.meshes.push(mesh);
    scene
}
