//! One to fifteen office rooms one behind the other, after J. H. Heo, S. K. Jung and K. Y. Wohn, "Fast
//! generation of stereoscopic virtual environment display using P-buffer" (1998), section V: a
//! room of 3,652 polygons that is copied along the line of sight, its walls taken away and posts
//! put in their place. The publication shows the room but does not list it; this one is furnished
//! so that as many of its polygons are visible as of theirs.

use super::quads::{Quads, Side};
use crate::scene::vector::{add, Vec3};
use crate::scene::{Material, Rig, Scene};

/// Most rooms.
pub const ROOMS: u32 = 15;
/// Polygons of a room.
pub const POLYGONS: u32 = 3652;
/// From one room to the next, in metres.
const PITCH: f64 = 16.0;
/// From the eyes to the first room.
const START: f64 = 1.0;
/// Half the width of a room.
const HALF: f64 = 4.0;
/// Floor and ceiling, from the height of the eyes.
const FLOOR: f64 = -1.6;
const CEILING: f64 = FLOOR + 2.7;
/// Distance from the eyes to the screen, where there is no parallax.
const VIEWING_DISTANCE: f64 = 4.0;

const WOOD: [u8; 3] = [186, 140, 92];
const METAL: [u8; 3] = [150, 154, 160];
const DARK: [u8; 3] = [62, 64, 72];
const PAPER: [u8; 3] = [236, 234, 224];
const SPINES: [[u8; 3]; 7] = [
    [158, 44, 46],
    [40, 84, 140],
    [58, 116, 70],
    [206, 168, 64],
    [110, 66, 124],
    [214, 206, 188],
    [52, 54, 66],
];

/// The office of this many rooms, in metres; of 300 × 300 pixels a view's focal length is 260.
pub fn scene(width: u32, height: u32, rooms: u32) -> Scene {
    let focal_length = 260.0 * f64::from(width.min(height)) / 300.0;
    let mut quads = Quads::default();
    for n in 0..rooms {
        room(&mut quads, [0.0, FLOOR, START + f64::from(n) * PITCH - VIEWING_DISTANCE]);
    }
    Scene {
        width,
        height,
        rig: Rig {
            pixels_per_unit: focal_length / VIEWING_DISTANCE,
            eye_separation: 0.065,
            viewing_distance: VIEWING_DISTANCE,
            far: Some(f64::from(ROOMS) * PITCH + 10.0),
            ..Rig::default()
        },
        background: [196, 208, 220],
        materials: vec![Material::default()],
        meshes: vec![quads.finish()],
        ..Scene::default()
    }
}

/// The number of rooms that a scene's name asks for: `office-N`.
pub fn rooms(name: &str) -> Option<u32> {
    let rooms = name.strip_prefix("office-")?.parse().ok()?;
    (1..=ROOMS).contains(&rooms).then_some(rooms)
}

/// Positions of the desks: distances of the partitions from the room's near side, and the middle of a desk from that of
/// the room.
const DESK_ROWS: [f64; 3] = [2.8, 6.8, 10.8];
const DESK_COLUMNS: [f64; 2] = [-2.95, 2.95];
/// Height of the top of a desk.
const TOP: f64 = 0.73;

/// A room whose floor begins at `origin`, the middle of its near side.
fn room(quads: &mut Quads, origin: Vec3) {
    let at = |x: f64, y: f64, z: f64| add(origin, [x, y, z]);
    let height = CEILING - FLOOR;
    let (across, along) = ([2.0 * HALF, 0.0, 0.0], [0.0, 0.0, PITCH]);
    let chequered = |even: [u8; 3], odd: [u8; 3]| {
        move |column: u32, row: u32| if (column + row).is_multiple_of(2) { even } else { odd }
    };
    let floor = chequered([150, 142, 134], [128, 122, 118]);
    quads.grid(at(-HALF, 0.0, 0.0), [across, along], [4, 4], floor);
    let back = [0.0, 0.0, -PITCH];
    let ceiling = chequered([255, 255, 250], [236, 236, 232]);
    quads.grid(at(-HALF, height, PITCH), [across, back], [3, 3], ceiling);
    for x in [-HALF, HALF - 0.3] {
        for z in [0.0, PITCH - 0.3] {
            let (least, most) = (at(x, 0.0, z), at(x + 0.3, height, z + 0.3));
            for side in [Side::Left, Side::Right, Side::Front, Side::Back] {
                quads.side(side, least, most, [206, 200, 188]);
            }
        }
    }
    let mat = [at(-0.6, 0.01, 0.4), at(0.6, 0.01, 0.4), at(0.6, 0.01, 1.2), at(-0.6, 0.01, 1.2)];
    quads.quad(mat, [104, 60, 52]);
    let entrance = at(0.8, 0.0, -0.35);
    chair(&mut |least, most, colour| {
        quads.cuboid(add(entrance, least), add(entrance, most), colour)
    });
    for row in 0..3 {
        let z = PITCH * (0.5 + f64::from(row)) / 3.0;
        for x in [-2.0, 2.0] {
            let (least, most) =
                (at(x - 0.15, height - 0.1, z - 0.6), at(x + 0.15, height - 0.04, z + 0.6));
            quads.cuboid(least, most, [255, 255, 240]);
        }
    }
    [-3.5, 3.5].into_iter().for_each(|x| cabinet(quads, at(x, 0.0, 1.5)));
    for (row, z) in DESK_ROWS.into_iter().enumerate() {
        for (column, x) in DESK_COLUMNS.into_iter().enumerate() {
            desk(quads, at(x, 0.0, z), 2 * row + column);
        }
    }
}

/// A filing cabinet with four drawers towards the viewer.
fn cabinet(quads: &mut Quads, origin: Vec3) {
    quads.cuboid(add(origin, [-0.25, 0.0, 0.0]), add(origin, [0.25, 1.34, 0.6]), METAL);
    for drawer in 0..4 {
        let least = add(origin, [-0.23, 0.02 + 0.33 * f64::from(drawer), -0.02]);
        let most = add(least, [0.46, 0.31, 0.02]);
        let seen = [Side::Left, Side::Right, Side::Top, Side::Bottom, Side::Front];
        seen.into_iter().for_each(|side| quads.side(side, least, most, METAL));
    }
}

/// A desk behind its partition, with what belongs to it; `origin` is at the middle of the
/// partition's foot. Who works there looks towards the viewer.
fn desk(quads: &mut Quads, origin: Vec3, number: usize) {
    let mut put = |least: Vec3, most: Vec3, colour: [u8; 3]| {
        quads.cuboid(add(origin, least), add(origin, most), colour);
    };
    put([-0.9, 0.0, 0.0], [0.9, 0.8, 0.05], [92, 116, 140]);
    put([-0.8, TOP - 0.03, 0.05], [0.8, TOP, 0.85], WOOD);
    put([-0.8, 0.0, 0.05], [-0.77, TOP - 0.03, 0.85], WOOD);
    put([0.77, 0.0, 0.05], [0.8, TOP - 0.03, 0.85], WOOD);
    put([0.37, 0.05, 0.1], [0.77, TOP - 0.03, 0.8], WOOD);
    for drawer in 0..3 {
        let y = 0.07 + 0.21 * f64::from(drawer);
        put([0.39, y, 0.8], [0.75, y + 0.19, 0.82], WOOD);
        put([0.52, y + 0.12, 0.82], [0.62, y + 0.14, 0.84], METAL);
    }
    monitor(&mut put);
    chair(&mut put);
    binders(&mut put, number);
    books(quads, origin, number);
    keyboard(quads, origin);
    clutter(quads, origin);
}

fn monitor(put: &mut impl FnMut(Vec3, Vec3, [u8; 3])) {
    const CASE: [u8; 3] = [214, 208, 190];
    put([-0.12, TOP, 0.2], [0.12, TOP + 0.02, 0.44], CASE);
    put([-0.05, TOP + 0.02, 0.27], [0.05, TOP + 0.06, 0.37], CASE);
    put([-0.14, TOP + 0.1, 0.12], [0.14, TOP + 0.34, 0.32], CASE);
    put([-0.2, TOP + 0.06, 0.32], [0.2, TOP + 0.38, 0.48], CASE);
    put([-0.17, TOP + 0.09, 0.48], [0.17, TOP + 0.35, 0.485], [46, 78, 92]);
}

fn chair(put: &mut impl FnMut(Vec3, Vec3, [u8; 3])) {
    put([-0.24, 0.43, 1.0], [0.24, 0.5, 1.46], DARK);
    put([-0.22, 0.55, 1.44], [0.22, 1.02, 1.5], DARK);
    put([-0.03, 0.12, 1.2], [0.03, 0.43, 1.26], METAL);
    put([-0.3, 0.06, 1.2], [0.3, 0.12, 1.26], METAL);
    put([-0.03, 0.06, 0.93], [0.03, 0.12, 1.53], METAL);
}

/// Eight ring binders on the left half of the desk.
fn binders(put: &mut impl FnMut(Vec3, Vec3, [u8; 3]), number: usize) {
    for binder in 0..8 {
        let x = -0.79 + 0.073 * binder as f64;
        let height = 0.28 + 0.01 * (binder * 2 % 5) as f64;
        put([x, TOP, 0.08], [x + 0.07, TOP + height, 0.36], SPINES[(binder * 3 + number) % 7]);
    }
}

/// A row of 28 books on the right half.
fn books(quads: &mut Quads, origin: Vec3, number: usize) {
    let mut x = 0.22;
    for book in 0..28 {
        let variety = (book * 5 + number * 3) % 7;
        let thickness = 0.014 + 0.002 * variety as f64;
        let height = 0.19 + 0.015 * ((book * 3 + number) % 5) as f64;
        let least = add(origin, [x, TOP, 0.1]);
        quads.standing(least, add(least, [thickness, height, 0.16]), SPINES[variety]);
        x += thickness + 0.001;
    }
}

/// Four rows of twelve key caps.
fn keyboard(quads: &mut Quads, origin: Vec3) {
    let corner = add(origin, [-0.24, TOP, 0.58]);
    quads.cuboid(corner, add(corner, [0.48, 0.02, 0.18]), [196, 192, 180]);
    for key in 0..48 {
        let (column, row) = (f64::from(key % 12), f64::from(key / 12));
        let least = add(corner, [0.01 + 0.0385 * column, 0.02, 0.01 + 0.042 * row]);
        quads.standing(least, add(least, [0.032, 0.012, 0.034]), [232, 228, 216]);
    }
}

/// Two pens, a tray, two sheets of paper, and a bin under the desk.
fn clutter(quads: &mut Quads, origin: Vec3) {
    for pen in 0..2 {
        let least = add(origin, [0.3 + 0.03 * f64::from(pen), TOP, 0.6]);
        quads.standing(least, add(least, [0.012, 0.012, 0.15]), SPINES[pen as usize]);
    }
    let tray = add(origin, [0.45, TOP, 0.45]);
    quads.standing(tray, add(tray, [0.24, 0.06, 0.32]), DARK);
    for sheet in 0..2 {
        let x = -0.7 + 0.22 * f64::from(sheet);
        let [near, far] = [0.5, 0.8].map(|z| [[x, TOP + 0.002, z], [x + 0.2, TOP + 0.002, z]]);
        let corners = [near[0], near[1], far[1], far[0]].map(|p| add(origin, p));
        quads.quad(corners, PAPER);
    }
    let (least, most) = (add(origin, [0.05, 0.0, 0.3]), add(origin, [0.3, 0.35, 0.55]));
    for side in [Side::Left, Side::Right, Side::Front, Side::Back, Side::Bottom] {
        quads.side(side, least, most, DARK);
    }
}
