//! Charts of edge cases: faces for one eye, ties, and polygons that leave the picture.

use super::diagnostic::{dim, hue, Painter};
use super::empty::chart;
use crate::scene::vector::{turn, Vec3};
use crate::scene::{Rig, Scene};

/// Faces that only one eye sees: red for the left eye, blue for the right one.
pub fn exclusive(width: u32, height: u32) -> Scene {
    const LEFT: [u8; 3] = [226, 74, 58];
    const RIGHT: [u8; 3] = [64, 120, 232];
    let (e, d) = (160.0, 640.0);
    let mut painter = Painter::default();
    // Upright wedges, their edges towards the viewer. The planes of their sides pass between the
    // eyes, at a quarter of e from the middle.
    for n in 0..7 {
        let x = f64::from(n - 3) * 84.0;
        let near = [x, -40.0 + f64::from(n % 3) * 30.0];
        let behind = |from: f64| [near[0] + 0.3 * (near[0] - from), near[1] + 0.3 * (near[1] + d)];
        let [left, right] = [behind(e / 4.0), behind(-e / 4.0)];
        let wall = |from: [f64; 2], to: [f64; 2]| -> [Vec3; 4] {
            let corner = |[x, z]: [f64; 2], y: f64| [x, y, z];
            [corner(from, 20.0), corner(to, 20.0), corner(to, 190.0), corner(from, 190.0)]
        };
        painter.polygon(&wall(left, near), &[dim(LEFT, 0.5), LEFT, LEFT, dim(LEFT, 0.5)]);
        painter.polygon(&wall(near, right), &[RIGHT, dim(RIGHT, 0.5), dim(RIGHT, 0.5), RIGHT]);
        painter.polygon(&wall(right, left), &[[70, 74, 84]]);
    }
    // Columns: the sides of the outline belong to one eye.
    for n in 0..4 {
        let centre = [(f64::from(n) - 1.5) * 150.0, 40.0];
        for side in 0..24 {
            let at = |k: i32| {
                let [x, z] = turn(f64::from(k) / 24.0);
                [centre[0] + 40.0 * x, centre[1] + 40.0 * z]
            };
            let ([x0, z0], [x1, z1]) = (at(side), at(side + 1));
            let corners = [[x0, -200.0, z0], [x1, -200.0, z1], [x1, -20.0, z1], [x0, -20.0, z0]];
            let colour = hue(f64::from(side) / 24.0, if side % 2 == 0 { 0.9 } else { 0.6 });
            painter.polygon(&corners, &[colour]);
        }
    }
    painter.finish(chart(width, height, e))
}

/// Corners on pixel centres, edges through them, equal depths. All positions are exact.
pub fn ties(width: u32, height: u32) -> Scene {
    let mut painter = Painter::default();
    // Pixel (x, y), counted from the middle of the picture, at a depth where 1 + z/d is a power
    // of two; half-way disparities stay multiples of half a pixel.
    let half = [f64::from(width % 2) / 2.0, f64::from(height % 2) / 2.0];
    let at = |x: f64, y: f64, w: f64| [(x - half[0]) * w, (half[1] - y) * w, 512.0 * (w - 1.0)];
    // A net of squares whose corners are pixel centres; all edges are shared.
    for row in 0..6 {
        for column in 0..8 {
            let [x, y] = [f64::from(column) * 16.0 - 135.5, f64::from(row) * 16.0 - 101.5];
            let corner = |i: i32, j: i32| at(x + 16.0 * f64::from(i), y + 16.0 * f64::from(j), 1.0);
            let corners = [corner(0, 1), corner(1, 1), corner(1, 0), corner(0, 0)];
            painter.polygon(&corners, &[hue(f64::from(row * 8 + column) / 48.0, 0.9)]);
        }
    }
    // Diamonds with all edges through pixel centres, at twice the distance.
    for n in 0..6 {
        let [x, y] = [f64::from(n) * 20.0 - 123.5, 20.5];
        let corners =
            [at(x, y + 8.0, 2.0), at(x + 8.0, y, 2.0), at(x, y - 8.0, 2.0), at(x - 8.0, y, 2.0)];
        painter.polygon(&corners, &[hue(f64::from(n) / 6.0, 0.7), [250, 250, 250]]);
    }
    // The same triangle three times: the first one stays.
    for colour in [[250, 220, 60], [200, 30, 30], [30, 30, 200]] {
        let corners = [at(20.5, -20.5, 1.0), at(100.5, -20.5, 1.0), at(60.5, -90.5, 1.0)];
        painter.polygon(&corners, &[colour]);
    }
    // Surfaces that pass through each other and have one depth on a common line: 1/w, and so
    // depth, is linear on the screen, and its mean over the two ends is 1.
    for (n, colour) in [[90, 200, 120], [200, 90, 180], [230, 160, 60]].into_iter().enumerate() {
        let [left, right] = [[1.0, 1.0], [0.75, 1.5], [2.5, 0.625]][n];
        let corners = [
            at(20.5, 90.5, left),
            at(100.5, 90.5, right),
            at(100.5, 10.5, right),
            at(20.5, 10.5, left),
        ];
        painter.polygon(&corners, &[colour, dim(colour, 0.6)]);
    }
    // Without area: a point, a line, and one that is a line for the left eye only.
    let x = -100.5;
    painter.polygon(&[at(x, 60.5, 1.0); 3], &[[255; 3]]);
    painter
        .polygon(&[at(x, 60.5, 1.0), at(x + 40.0, 60.5, 1.0), at(x + 8.0, 60.5, 1.0)], &[[255; 3]]);
    let edge_on = |w: f64, y: f64| {
        let [_, y, z] = at(0.0, y, w);
        // On the plane through the left eye and x on the screen.
        [-16.0 + (x + 16.0) * w, y, z]
    };
    painter
        .polygon(&[edge_on(1.0, 90.5), edge_on(2.0, 90.5), edge_on(1.0, 60.5)], &[[240, 240, 240]]);
    let mut scene = painter.finish(chart(width, height, 32.0));
    scene.rig =
        Rig { pixels_per_unit: 1.0, eye_separation: 32.0, viewing_distance: 512.0, ..scene.rig };
    scene
}

/// Polygons that leave the picture in every direction.
pub fn windows(width: u32, height: u32) -> Scene {
    let mut painter = Painter::default();
    // A floor from behind the viewer to beyond the far plane, and a ceiling that ends before.
    for n in 0..8 {
        let x = f64::from(n - 4) * 400.0;
        let strip = |y: f64, near: f64, far: f64| {
            [[x, y, near], [x + 400.0, y, near], [x + 400.0, y, far], [x, y, far]]
        };
        let colour = hue(0.3 + f64::from(n % 2) * 0.06, 0.6);
        painter.polygon(
            &strip(-230.0, -900.0, 90_000.0),
            &[colour, colour, dim(colour, 0.3), dim(colour, 0.3)],
        );
        let colour = hue(0.6 + f64::from(n % 2) * 0.05, 0.5);
        painter.polygon(
            &strip(260.0, -600.0, 3000.0),
            &[colour, colour, dim(colour, 0.5), dim(colour, 0.5)],
        );
    }
    // Blades out of the middle: within the guard bands, and far beyond them.
    for n in 0..16 {
        let [x, y] = turn(f64::from(n) / 16.0 + 1.0 / 64.0);
        let reach = [330.0, 480.0, 1200.0, 20_000.0][n as usize % 4];
        let depth = [0.0, 80.0, -120.0, 200.0][n as usize % 4];
        let tip = |side: f64| {
            [x * reach - y * side * reach * 0.1, y * reach + x * side * reach * 0.1, depth]
        };
        let colour = hue(f64::from(n) / 16.0, 1.0);
        let root = [60.0 * x, 60.0 * y, 40.0];
        painter.polygon(&[root, tip(-1.0), tip(1.0)], &[[255, 255, 255], colour, colour]);
    }
    // In one window only, and in none.
    for (n, x) in [-330.0, 330.0, -400.0, 400.0].into_iter().enumerate() {
        let sign = f64::signum(x);
        let corners =
            [[x - 14.0, -60.0, -200.0], [x + 14.0, -60.0, -200.0], [x - 8.0 * sign, 60.0, -200.0]];
        painter.polygon(&corners, &[hue(n as f64 / 4.0, 0.9)]);
    }
    // A spike that passes the viewer's head.
    let corners = [[-14.0, -60.0, 300.0], [14.0, -60.0, 300.0], [420.0, -280.0, -1500.0]];
    painter.polygon(&corners, &[[230, 200, 90], [160, 120, 40], [255, 250, 220]]);
    painter.finish(chart(width, height, 64.0))
}
