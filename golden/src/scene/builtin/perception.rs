//! The scenes of two experiments on perception: polygons that one eye sees alone, in another colour
//! than their surroundings and in the same (J. H. Heo, S. K. Jung and K. Y. Wohn, "Fast generation
//! of stereoscopic virtual environment display using P-buffer", 1998, figures 8 and 11).

use super::empty::desk;
use super::quads::Quads;
use crate::formats::Eye;
use crate::scene::vector::{add, cross, scale, turn, unit, Vec3};
use crate::scene::{Material, Scene};

/// Height of the floor, in centimetres from that of the eyes.
const FLOOR: f64 = -9.0;
/// Distance of the wall behind the screen, in centimetres.
const WALL: f64 = 50.0;
/// Sides of a cylinder.
const SIDES: u32 = 24;

const BLUE: [u8; 3] = [52, 92, 214];
const RED: [u8; 3] = [214, 52, 46];

/// Two upright cylinders before a wall: behind the red one is a blue one, which the right eye
/// sees beside it and the left eye not at all.
pub fn cylinder(width: u32, height: u32) -> Scene {
    let mut quads = surroundings();
    upright(&mut quads, [0.0, -10.0], 1.5, [FLOOR, 6.0], RED);
    // On the left eye's line of sight through the middle of the red one.
    let [eye, _, eye_z] = desk(width, height).rig.eye(Eye::Left);
    let x = eye - eye * (30.0 - eye_z) / (-10.0 - eye_z);
    upright(&mut quads, [x, 30.0], 1.0, [FLOOR, 3.0], BLUE);
    finish(quads, width, height)
}

/// A blue block with a slot that leads towards the right eye: its end, in the middle of the block,
/// is seen by that eye alone. It is the first polygon after those of floor and wall.
pub fn solid(width: u32, height: u32) -> Scene {
    let mut quads = surroundings();
    let rig = desk(width, height).rig;
    let [eye, _, eye_z] = rig.eye(Eye::Right);
    let (bottom, top) = (FLOOR, 4.0);
    let (front, end, back) = (-4.0, 10.0, 16.0);
    // Where the line from the right eye to x at the end of the slot passes the front.
    let passes = |x: f64| eye + (x - eye) * (front - eye_z) / (end - eye_z);
    // x at the front and at the end; a little wider at the front, so that the sides are not edge-on.
    let (left, right) = ([passes(-0.7) - 0.05, -0.7], [passes(0.7) + 0.05, 0.7]);
    let mut wall = |from: [f64; 2], to: [f64; 2]| {
        let ([x0, z0], [x1, z1]) = (from, to);
        quads.quad([[x0, bottom, z0], [x1, bottom, z1], [x1, top, z1], [x0, top, z0]], BLUE);
    };
    // Anticlockwise from above, which is from left to right for who sees the front.
    wall([left[1], end], [right[1], end]);
    wall([left[0], front], [left[1], end]);
    wall([right[1], end], [right[0], front]);
    wall([-8.0, front], [left[0], front]);
    wall([right[0], front], [8.0, front]);
    wall([8.0, front], [8.0, back]);
    wall([8.0, back], [-8.0, back]);
    wall([-8.0, back], [-8.0, front]);
    let mut lid = |near: [f64; 2], far: [f64; 2], z: [f64; 2]| {
        let corners = [[near[0], z[0]], [near[1], z[0]], [far[1], z[1]], [far[0], z[1]]];
        quads.quad(corners.map(|[x, z]| [x, top, z]), BLUE);
    };
    lid([-8.0, left[0]], [-8.0, left[1]], [front, end]);
    lid([right[0], 8.0], [right[1], 8.0], [front, end]);
    lid([-8.0, 8.0], [-8.0, 8.0], [end, back]);
    finish(quads, width, height)
}

/// A floor and a wall, one polygon each, and the dark fields of their patterns just before them: a
/// pattern stays a pattern where some of its fields are missing.
fn surroundings() -> Quads {
    const ABOVE: f64 = 0.05;
    let mut quads = Quads::default();
    let mut chequered =
        |corner: Vec3, [across, up]: [Vec3; 2], cells: [u32; 2], colours: [[u8; 3]; 2]| {
            let front = scale(unit(cross(up, across)), ABOVE);
            let field = |column: u32, row: u32, [columns, rows]: [u32; 2]| {
                [[0, 0], [columns, 0], [columns, rows], [0, rows]].map(|[i, j]| {
                    let s = scale(across, f64::from(column + i) / f64::from(cells[0]));
                    let t = scale(up, f64::from(row + j) / f64::from(cells[1]));
                    add(corner, add(s, t))
                })
            };
            quads.quad(field(0, 0, cells), colours[0]);
            for n in 0..cells[0] * cells[1] {
                let (column, row) = (n % cells[0], n / cells[0]);
                if !(column + row).is_multiple_of(2) {
                    quads.quad(field(column, row, [1, 1]).map(|p| add(p, front)), colours[1]);
                }
            }
        };
    let (across, along, up) = ([80.0, 0.0, 0.0], [0.0, 0.0, WALL + 20.0], [0.0, 40.0, 0.0]);
    let floor = [[222, 214, 190], [168, 158, 132]];
    chequered([-40.0, FLOOR, -20.0], [across, along], [16, 14], floor);
    let wall = [[196, 206, 196], [150, 168, 158]];
    chequered([-40.0, FLOOR, WALL], [across, up], [16, 8], wall);
    quads
}

/// An upright cylinder about `[x, z]`, from the lower to the upper of two heights.
fn upright(
    quads: &mut Quads,
    [x, z]: [f64; 2],
    radius: f64,
    [low, high]: [f64; 2],
    colour: [u8; 3],
) {
    let place = |n: u32, y: f64| {
        let [c, s] = turn(f64::from(n) / f64::from(SIDES));
        [x + radius * c, y, z + radius * s]
    };
    for n in 0..SIDES {
        quads.quad([place(n, low), place(n + 1, low), place(n + 1, high), place(n, high)], colour);
    }
    // The lid in strips; the first and the last are triangles.
    for n in 0..SIDES / 2 {
        let (left, right) = (SIDES / 4 + n, SIDES / 4 + SIDES - n);
        let corners = [left, left + 1, right - 1, right];
        quads.quad(corners.map(|k| place(k, high)), colour);
    }
}

fn finish(quads: Quads, width: u32, height: u32) -> Scene {
    Scene {
        background: [24, 26, 32],
        materials: vec![Material::default()],
        meshes: vec![quads.finish()],
        ..desk(width, height)
    }
}
