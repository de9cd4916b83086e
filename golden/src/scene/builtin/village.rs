//! A village of eight buildings, about 1,100 polygons: the kind of scene that Adelson et al.
//! rendered ("Performance of a Simple Stereo Renderer").
//!
//! Lengths are metres of the village: x to the right, y up, z away from the viewer. It is set up
//! as a model on a desk, on both sides of the screen.

use super::empty::desk;
use super::mason::{toned, Mason, Paint, Wall};
use crate::scene::vector::{add, rotate, scale, turn, Vec3};
use crate::scene::{Light, Lighting, Material, Scene, Source};

const GLASS: [Paint; 2] = [[44, 58, 78], [164, 190, 206]];
const FRAME: Paint = [240, 236, 224];
const STONE: Paint = [196, 188, 172];
const SLATE: Paint = [92, 102, 124];
const BRICK: Paint = [150, 78, 60];
const GRASS: Paint = [112, 150, 70];

/// A house with its ridge along x and its door to the front.
struct House {
    at: [f64; 2],
    yaw: f64,
    /// Width, height of the walls and depth.
    size: Vec3,
    /// Height of the ridge above the walls.
    roof: f64,
    walls: Paint,
    tiles: Paint,
    shutters: Paint,
    /// Windows of the upper floor; below it the door takes the place of one.
    windows: usize,
}

const HOUSES: [House; 7] = [
    House {
        at: [-14.5, 3.0],
        yaw: -24.0,
        size: [7.0, 4.6, 5.6],
        roof: 2.9,
        walls: [232, 214, 176],
        tiles: [168, 76, 52],
        shutters: [70, 104, 82],
        windows: 3,
    },
    House {
        at: [-17.0, 14.5],
        yaw: -62.0,
        size: [6.4, 4.4, 5.4],
        roof: 2.7,
        walls: [214, 186, 170],
        tiles: [140, 66, 50],
        shutters: [112, 66, 54],
        windows: 3,
    },
    House {
        at: [-12.5, 26.5],
        yaw: -30.0,
        size: [6.6, 4.8, 5.6],
        roof: 3.0,
        walls: [236, 230, 214],
        tiles: [120, 74, 60],
        shutters: [66, 88, 122],
        windows: 3,
    },
    House {
        at: [14.0, 1.5],
        yaw: 27.0,
        size: [6.8, 4.4, 5.6],
        roof: 2.8,
        walls: [222, 198, 150],
        tiles: [176, 88, 58],
        shutters: [126, 60, 48],
        windows: 3,
    },
    House {
        at: [18.5, 12.0],
        yaw: 64.0,
        size: [6.6, 4.6, 5.4],
        roof: 2.8,
        walls: [206, 212, 206],
        tiles: [132, 62, 48],
        shutters: [62, 98, 108],
        windows: 3,
    },
    House {
        at: [17.0, 25.5],
        yaw: 34.0,
        size: [7.2, 4.8, 5.6],
        roof: 3.1,
        walls: [238, 206, 184],
        tiles: [150, 80, 56],
        shutters: [92, 110, 70],
        windows: 3,
    },
    House {
        at: [-1.0, 38.0],
        yaw: -6.0,
        size: [8.4, 5.0, 5.8],
        roof: 3.2,
        walls: [228, 208, 196],
        tiles: [124, 60, 52],
        shutters: [88, 70, 58],
        windows: 4,
    },
];

/// The village, seen from above the fields before it.
pub fn scene(width: u32, height: u32) -> Scene {
    let mut mason = Mason::default();
    ground(&mut mason);
    HOUSES.iter().for_each(|house| build(&mut mason, house));
    church(&mut mason);
    for (x, z, size) in [
        (-21.5, 6.0, 1.0),
        (-6.5, 21.0, 0.8),
        (23.0, 19.0, 1.1),
        (8.0, 36.5, 1.2),
        (6.4, -1.5, 0.7),
    ] {
        tree(&mut mason, [x, 0.0, z], size);
    }
    well(&mut mason, [-3.2, 0.0, 5.5]);
    let mut mesh = mason.finish();
    let turned = |p: Vec3| rotate(rotate(p, 1, -7.0), 0, -24.0);
    mesh.transform(
        |p| add(scale(turned(add(p, [0.0, -4.0, -16.0])), 0.62), [0.0, 0.0, 7.0]),
        turned,
    );
    let sun = Light { source: Source::Direction([-3.0, 4.0, -4.4]), colour: [0.8, 0.76, 0.66] };
    Scene {
        background: [158, 196, 228],
        lighting: Some(Lighting { ambient: [0.36, 0.38, 0.44], lights: vec![sun] }),
        materials: vec![Material::default()],
        meshes: vec![mesh],
        ..desk(width, height)
    }
}

/// Meadows, hills at the end of the valley, and the paved street.
fn ground(mason: &mut Mason) {
    let green = |column: i32, row: i32| {
        let spot = f64::from((column * 37 + row * 61).rem_euclid(7)) / 7.0;
        toned(GRASS, 0.86 + 0.24 * spot)
    };
    for row in 0..4 {
        for column in 0..4 {
            let at = |i: i32, j: i32| [f64::from(i * 25 - 48), 0.0, f64::from(j * 20 - 22)];
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| (column + i, row + j));
            mason.polygon(&corners.map(|(i, j)| at(i, j)), &corners.map(|(i, j)| green(i, j)));
        }
    }
    for (x, z, radius, height, paint) in [
        (-30.0, 66.0, 30.0, 13.0, [96, 134, 88]),
        (26.0, 70.0, 38.0, 16.0, [104, 140, 104]),
        (-2.0, 80.0, 34.0, 19.0, [122, 154, 132]),
    ] {
        mason.cone([x, -0.1, z], radius, height, 9, true, paint);
    }
    // The street winds past the church's door.
    let bends = [[2.5, -16.0], [-1.0, 0.0], [0.5, 8.0], [5.5, 15.0], [8.0, 25.0], [4.0, 34.0]];
    for pair in bends.windows(2) {
        let side = |[x, z]: [f64; 2], half: f64| [x + half, 0.05, z];
        let corners =
            [side(pair[0], -1.5), side(pair[0], 1.5), side(pair[1], 1.5), side(pair[1], -1.5)];
        mason.polygon(&corners, &[toned(STONE, 0.9), toned(STONE, 0.82)]);
    }
}

fn build(mason: &mut Mason, house: &House) {
    mason.stand([house.at[0], 0.0, house.at[1]], house.yaw);
    let [width, height, depth] = house.size;
    let plan = [[-width / 2.0, -depth / 2.0], [width / 2.0, depth / 2.0]];
    let walls = Wall::around(plan[0], plan[1], 0.0);
    for (n, wall) in walls.iter().enumerate() {
        wall.panel(mason, [0.0, 0.0], [wall.length, height], 0.0, shaded(house.walls));
        if n % 2 == 1 {
            wall.gable(mason, height, house.roof, house.walls);
        }
    }
    let [front, right, ..] = &walls;
    window(mason, right, [right.length / 2.0 - 0.45, height - 0.3]);
    let step = width / house.windows as f64;
    for n in 0..house.windows {
        let u = step * (n as f64 + 0.5) - 0.45;
        shuttered(mason, front, [u, height - 1.7], house.shutters);
        if n != house.windows / 2 {
            shuttered(mason, front, [u, 0.9], house.shutters);
        }
    }
    let middle = step * ((house.windows / 2) as f64 + 0.5);
    door(mason, front, middle, house.shutters);
    mason.saddle_roof(plan, height, house.roof, house.tiles);
    let x = 0.28 * width;
    mason.block([x - 0.35, height + 0.8, 0.4], [x + 0.35, height + house.roof + 0.9, 1.1], BRICK);
}

/// Darker towards the ground.
fn shaded(paint: Paint) -> [Paint; 2] {
    [toned(paint, 0.78), paint]
}

/// A window; `place` is its lower left corner.
fn window(mason: &mut Mason, wall: &Wall, place: [f64; 2]) {
    let [u, v] = place;
    wall.panel(mason, [u - 0.1, v - 0.1], [u + 1.0, v + 1.3], 0.04, [FRAME, FRAME]);
    wall.panel(mason, [u, v], [u + 0.9, v + 1.2], 0.08, GLASS);
}

/// A window with shutters.
fn shuttered(mason: &mut Mason, wall: &Wall, place: [f64; 2], paint: Paint) {
    window(mason, wall, place);
    let [u, v] = place;
    for side in [u - 0.6, u + 1.0] {
        wall.panel(mason, [side, v - 0.05], [side + 0.5, v + 1.25], 0.06, shaded(paint));
    }
}

/// A door about `middle` with a step before it.
fn door(mason: &mut Mason, wall: &Wall, middle: f64, paint: Paint) {
    wall.panel(mason, [middle - 0.7, 0.0], [middle + 0.7, 2.3], 0.04, [FRAME, FRAME]);
    wall.panel(mason, [middle - 0.55, 0.0], [middle + 0.55, 2.15], 0.08, shaded(paint));
    let [x, _, z] = wall.at(middle, 0.0, 0.0);
    mason.block([x - 0.8, 0.0, z - 0.7], [x + 0.8, 0.22, z], STONE);
}

fn church(mason: &mut Mason) {
    mason.stand([-3.0, 0.0, 19.0], -52.0);
    // The nave behind the tower, its ridge along x.
    let plan = [[-7.0, -3.2], [5.0, 3.2]];
    for (n, wall) in Wall::around(plan[0], plan[1], 0.0).iter().enumerate() {
        wall.panel(mason, [0.0, 0.0], [wall.length, 5.4], 0.0, shaded([226, 220, 204]));
        if n % 2 == 1 {
            wall.gable(mason, 5.4, 3.6, [226, 220, 204]);
        } else {
            for k in 0..4 {
                pointed(mason, wall, [2.0 + 2.6 * f64::from(k), 1.6], [1.1, 2.0]);
            }
        }
    }
    mason.saddle_roof(plan, 5.4, 3.6, SLATE);
    let (low, high) = ([-10.4, 0.0, -2.2], [-6.0, 12.0, 2.2]);
    mason.block(low, high, [218, 210, 194]);
    for wall in Wall::around([low[0], low[2]], [high[0], high[2]], 0.0) {
        pointed(mason, &wall, [1.6, 8.6], [1.2, 1.7]);
    }
    let [side, _, _, entrance] = Wall::around([low[0], low[2]], [high[0], high[2]], 0.0);
    clock(mason, &side, [2.2, 6.8]);
    clock(mason, &entrance, [2.2, 6.8]);
    entrance.panel(mason, [1.2, 0.0], [3.2, 2.8], 0.05, [STONE, STONE]);
    entrance.panel(mason, [1.4, 0.0], [3.0, 2.6], 0.1, shaded([104, 70, 48]));
    mason.cone([-8.2, 11.9, 0.0], 3.4, 8.6, 4, false, SLATE);
    mason.block([-8.27, 20.2, -0.07], [-8.13, 22.0, 0.07], [222, 190, 90]);
    mason.block([-8.27, 21.2, -0.5], [-8.13, 21.36, 0.5], [222, 190, 90]);
}

/// A window that ends in a point; `place` is its lower left corner.
fn pointed(mason: &mut Mason, wall: &Wall, place: [f64; 2], size: [f64; 2]) {
    let ([u, v], [width, height]) = (place, size);
    for (rim, out, paints) in [(0.12, 0.04, [STONE, FRAME]), (0.0, 0.08, GLASS)] {
        let corner = |du: f64, dv: f64| wall.at(u + du, v + dv, out);
        let corners = [
            corner(-rim, -rim),
            corner(width + rim, -rim),
            corner(width + rim, height),
            corner(width / 2.0, height + 0.8 * width + 1.6 * rim),
            corner(-rim, height),
        ];
        mason.polygon(&corners, &[paints[0], paints[0], paints[1], paints[1], paints[1]]);
    }
}

/// A clock's face and hands about a point.
fn clock(mason: &mut Mason, wall: &Wall, centre: [f64; 2]) {
    let rim = |k: f64| {
        let [c, s] = turn(k / 8.0);
        wall.at(centre[0] + 0.8 * c, centre[1] + 0.8 * s, 0.05)
    };
    let corners: Vec<Vec3> = (0..8).map(|k| rim(f64::from(k))).collect();
    mason.polygon(&corners, &[FRAME]);
    for (reach, fraction) in [(0.65, 0.22), (0.45, 0.6)] {
        let [c, s] = turn(fraction);
        let tip = wall.at(centre[0] + reach * c, centre[1] + reach * s, 0.1);
        let foot = |side: f64| wall.at(centre[0] - side * s, centre[1] + side * c, 0.1);
        mason.polygon(&[foot(-0.08), tip, foot(0.08)], &[[40, 38, 44]]);
    }
}

fn tree(mason: &mut Mason, at: Vec3, size: f64) {
    mason.stand(at, 0.0);
    let trunk = 0.28 * size;
    mason.block([-trunk, 0.0, -trunk], [trunk, 1.6 * size, trunk], [104, 78, 54]);
    mason.cone([0.0, 1.2 * size, 0.0], 2.2 * size, 4.2 * size, 8, true, [104, 156, 82]);
    mason.cone([0.0, 3.4 * size, 0.0], 1.5 * size, 3.4 * size, 8, true, [128, 178, 92]);
}

/// A well under a roof on two posts.
fn well(mason: &mut Mason, at: Vec3) {
    mason.stand(at, 20.0);
    mason.block([-1.1, 0.0, -1.1], [1.1, 0.9, 1.1], STONE);
    mason.polygon(
        &[[-0.8, 0.92, -0.8], [0.8, 0.92, -0.8], [0.8, 0.92, 0.8], [-0.8, 0.92, 0.8]],
        &[[52, 78, 104]],
    );
    for x in [-1.0, 1.0] {
        mason.block([x - 0.1, 0.8, -0.1], [x + 0.1, 2.6, 0.1], [104, 78, 54]);
    }
    mason.saddle_roof([[-1.3, -0.9], [1.3, 0.9]], 2.4, 0.9, [150, 80, 56]);
}
