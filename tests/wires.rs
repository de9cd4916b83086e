//! Wire frames: which edges there are, and that lines are one pixel thick, without gaps, in place, for
//! both eyes.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::projection::{Partition, Piecewise, Projection};
use wheatstone_golden::scene::vector::Vec3;
use wheatstone_golden::scene::wires::{mesh, wire_frame, Line, THICKEST};
use wheatstone_golden::scene::{open, Camera, Colours, Material, Mesh, Rig, Scene};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const FORMATS: Formats = Formats::new(&Config::DEFAULT);
const SIZE: [u32; 2] = [160, 120];
const RIG: Rig = Rig {
    pixels_per_unit: 1.0,
    eye_separation: 20.0,
    viewing_distance: 200.0,
    near: None,
    far: None,
    head_tilt: 0.0,
    projection: Projection::TwoCentres,
};

fn camera() -> Camera {
    Camera::new(&RIG, SIZE[0], SIZE[1], &FORMATS)
}

/// Draws a scene's polygons directly and by the hybrid.
fn views(scene: &Scene) -> [[Frame; 2]; 2] {
    let config = Config::DEFAULT;
    let geometry = scene.geometry(&FORMATS, &Default::default()).expect("a legal scene");
    let job = Job::of(&geometry, config, Options::new(&config), Lookup::Nearest);
    [job.direct(), job.derived(false).0.eyes]
}

fn drawn(lines: &[Line]) -> [Frame; 2] {
    let [width, height] = SIZE;
    let meshes = vec![mesh(lines, &camera())];
    let materials = vec![Material::default()];
    let scene = Scene { width, height, rig: RIG, meshes, materials, ..Scene::default() };
    let [direct, derived] = views(&scene);
    assert!(direct == derived, "{lines:?}");
    direct
}

fn line(ends: [Vec3; 2]) -> Line {
    Line { ends, colours: [[200, 100, 50]; 2] }
}

/// Pixels drawn in each row, or column.
fn along(frame: &Frame, rows: bool) -> Vec<Vec<u32>> {
    let lines = if rows { frame.height } else { frame.width };
    let mut along = vec![Vec::new(); lines as usize];
    for (n, _) in frame.id.iter().enumerate().filter(|(_, &id)| id != NO_ID) {
        let [x, y] = [n as u32 % frame.width, n as u32 / frame.width];
        if rows {
            along[y as usize].push(x)
        } else {
            along[x as usize].push(y)
        }
    }
    along
}

#[test]
fn every_row_or_column_has_its_pixels() {
    let mut rng = Rng::with_seed(1);
    let (mut thin, mut thick) = (0, 0);
    for _ in 0..3000 {
        let mut point = || {
            let z = rng.f64() * 300.0 - 100.0;
            let w = 1.0 + z / 200.0;
            [(rng.f64() - 0.5) * 100.0 * w, (rng.f64() - 0.5) * 90.0 * w, z]
        };
        let ends = [point(), point()];
        let slope = |eye: Eye| {
            let [a, b] = ends.map(|p| camera().pixel(p, eye));
            ((b[0] - a[0]) / (b[1] - a[1])).abs()
        };
        let slopes = Eye::BOTH.map(slope);
        let frames = drawn(&[line(ends)]);
        for (eye, frame) in Eye::BOTH.into_iter().zip(&frames) {
            let rows = slopes[eye as usize] < 1.0;
            let axis = usize::from(rows);
            let [mut a, mut b] = ends.map(|p| camera().pixel(p, eye));
            if a[axis] > b[axis] {
                (a, b) = (b, a);
            }
            let agree = slopes.iter().all(|s| (*s < 1.0) == rows);
            // Thicker only for lines that are upright for one eye and flat for the other.
            let flattest = slopes.map(|s| s.max(1.0 / s)).into_iter().fold(1.0, f64::max);
            if !agree && flattest > THICKEST - 0.1 {
                continue;
            }
            // The ends of such lines are cut slantwise.
            let margin = if agree { 0.01 } else { THICKEST / 2.0 };
            for (n, pixels) in along(frame, rows).iter().enumerate() {
                let centre = n as f64 + 0.5;
                if centre < a[axis] + margin || centre > b[axis] - margin {
                    continue;
                }
                assert!(!pixels.is_empty(), "a gap at {n}: {ends:?} {}", eye.name());
                if agree {
                    assert_eq!(pixels.len(), 1, "{ends:?} {}", eye.name());
                    thin += 1;
                } else {
                    thick += 1;
                }
                let part = (centre - a[axis]) / (b[axis] - a[axis]);
                let ideal = a[1 - axis] + part * (b[1 - axis] - a[1 - axis]);
                let reach = if agree { 0.51 } else { 1.51 };
                let near = |p: &u32| (f64::from(*p) + 0.5 - ideal).abs() <= reach;
                assert!(pixels.iter().all(near), "{pixels:?} {ideal}: {ends:?}");
            }
        }
    }
    assert!(thin > 100_000 && thick > 500, "{thin} {thick}");
}

#[test]
fn lines_are_cut_at_the_near_and_far_planes() {
    let planes = camera().lenses()[0].depth_range();
    let straight = |z: [f64; 2]| line([[0.0, -30.0, z[0]], [0.0, -30.0, z[1]]]);
    let cut = |z: [f64; 2]| {
        let mesh = mesh(&[straight(z)], &camera());
        let z: Vec<f64> = mesh.positions.iter().map(|p| p[2]).collect();
        (!z.is_empty()).then(|| [z[0], z[2]])
    };
    assert_eq!(cut([0.0, 100.0]), Some([0.0, 100.0]));
    assert_eq!(cut([-1000.0, 100.0]), Some([planes[0], 100.0]));
    assert_eq!(cut([1e6, -1000.0]), Some([planes[1], planes[0]]));
    assert_eq!(cut([-1000.0, -300.0]), None);
    assert_eq!(cut([1e6, 1e7]), None);
    // One that runs from beneath the viewer's head to the front stays in its place.
    let frames = drawn(&[straight([-1000.0, 400.0])]);
    for (eye, frame) in Eye::BOTH.into_iter().zip(&frames) {
        let end = camera().pixel([0.0, -30.0, 400.0], eye);
        let below = camera().pixel([0.0, -30.0, -100.0], eye);
        for (row, pixels) in along(frame, true).iter().enumerate() {
            let centre = row as f64 + 0.5;
            if centre < end[1] - 0.51 {
                assert!(pixels.is_empty());
            } else if centre > end[1] + 0.51 {
                let part = (centre - end[1]) / (below[1] - end[1]);
                let ideal = end[0] + part * (below[0] - end[0]);
                assert!(pixels.iter().all(|&x| (f64::from(x) + 0.5 - ideal).abs() < 1.01));
                assert!(!pixels.is_empty(), "{row}");
            }
        }
    }
    // Colours go along.
    let colours = [[0, 100, 200], [100, 100, 0]];
    let half = Line { ends: [[0.0, 0.0, 3.0 * planes[0]], [0.0, 0.0, -planes[0]]], colours };
    let Colours::Vertex(cut) = mesh(&[half], &camera()).colours else { panic!("one a vertex") };
    assert_eq!(cut, [[50, 100, 100], [50, 100, 100], [100, 100, 0], [100, 100, 0]]);
}

#[test]
fn lines_have_no_gaps_in_any_partition() {
    let part = |[near, far]: [f64; 2], [min_distance, max_distance]: [f64; 2]| Partition {
        near,
        far,
        min_distance,
        max_distance,
    };
    // Two that meet, of which the second is flat and moved aside, and one apart from them.
    let partitions = vec![
        part([100.0, 200.0], [60.0, 200.0]),
        part([200.0, 300.0], [150.0, 150.0]),
        part([350.0, 500.0], [200.0, 400.0]),
    ];
    let piecewise = Piecewise { partitions, ..Piecewise::default() };
    let rig = Rig { projection: Projection::Piecewise(piecewise), ..RIG };
    let [width, height] = SIZE;
    let camera = Camera::new(&rig, width, height, &FORMATS);
    let mut random = Rng::with_seed(4);
    let (mut pieces, mut checked) = (0, 0);
    for _ in 0..300 {
        let ends = [-90.0, 290.0].map(|z| {
            let mut across = || (random.f64() - 0.5) * 0.5 * (z + 200.0);
            [across(), across(), z]
        });
        let mesh = mesh(&[line(ends)], &camera);
        let drawn: Vec<[Vec3; 2]> = mesh
            .positions
            .chunks(4)
            .map(|c| [0, 2].map(|k| [0, 1, 2].map(|n| (c[k][n] + c[k + 1][n]) / 2.0)))
            .collect();
        pieces += drawn.len();
        let z: Vec<[f64; 2]> = drawn.iter().map(|ends| ends.map(|p| p[2])).collect();
        assert_eq!(z, [[-90.0, 0.0], [0.0, 100.0], [150.0, 290.0]]);
        let scene = Scene {
            width,
            height,
            rig: rig.clone(),
            meshes: vec![mesh],
            materials: vec![Material::default()],
            ..Scene::default()
        };
        let [direct, derived] = views(&scene);
        assert!(direct == derived, "{ends:?}");
        for (lens, ends) in camera.lenses().iter().zip(&drawn) {
            let seen = Eye::BOTH.map(|eye| ends.map(|p| lens.pixel(p, eye)));
            let runs = seen.map(|[a, b]| [b[0] - a[0], b[1] - a[1]].map(f64::abs));
            for axis in [0, 1] {
                // Upright, or flat, for both eyes: thin, with a pixel in every row, or column.
                if runs.iter().any(|run| run[axis] < run[1 - axis]) {
                    continue;
                }
                for (frame, [a, b]) in direct.iter().zip(seen) {
                    let [from, to] = [a[axis].min(b[axis]), a[axis].max(b[axis])];
                    let along = along(frame, axis == 1);
                    for (n, pixels) in along.iter().enumerate() {
                        let centre = n as f64 + 0.5;
                        if (from + 0.6..to - 0.6).contains(&centre) {
                            let part = (centre - a[axis]) / (b[axis] - a[axis]);
                            let ideal = a[1 - axis] + part * (b[1 - axis] - a[1 - axis]);
                            let hit =
                                pixels.iter().any(|&p| (f64::from(p) + 0.5 - ideal).abs() < 0.52);
                            assert!(hit, "{axis} {n} {ideal}: {pixels:?}");
                            checked += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(pieces == 900 && checked > 10_000, "{pieces} {checked}");
}

#[test]
fn edges_are_drawn_once_and_diagonals_of_polygons_are_not() {
    let corners = |n: u32| [f64::from(n & 1), f64::from(n >> 1 & 1), f64::from(n >> 2)];
    let sides =
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let positions: Vec<Vec3> = (0..8).map(corners).collect();
    let scene = |mesh: Mesh| Scene {
        width: 64,
        height: 64,
        meshes: vec![mesh],
        materials: vec![Material::default()],
        ..Scene::default()
    };
    let count = |mesh: Mesh| {
        let wires = wire_frame(&scene(mesh)).expect("legal");
        wires.meshes[0].triangle_id_count()
    };
    let faces = sides.map(|side| side.to_vec()).to_vec();
    assert_eq!(count(Mesh { positions: positions.clone(), faces, ..Mesh::default() }), 12);
    let halves = |side: [u32; 4]| {
        let [a, b, c, d] = side;
        [[a, b, c], [a, c, d]]
    };
    let triangles: Vec<[u32; 3]> = sides.into_iter().flat_map(halves).collect();
    let cube = Mesh { positions, triangles, ..Mesh::default() };
    assert_eq!(count(cube.clone()), 18);
    let triangle_ids = (0..12).map(|n| n / 2).collect();
    assert_eq!(count(Mesh { triangle_ids, ..cube.clone() }), 12);
    // Doubled vertices are one place.
    let doubled = Mesh {
        positions: cube.triangles.iter().flatten().map(|&n| cube.positions[n as usize]).collect(),
        triangles: (0..12).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect(),
        ..Mesh::default()
    };
    assert_eq!(count(doubled), 18);
    let broken = Mesh { triangles: vec![[0, 1, 9]], ..cube };
    assert!(wire_frame(&scene(broken)).unwrap_err().to_string().contains("vertex 9 of 8"));
}

#[test]
fn wire_frames_of_scenes_are_drawn_as_directly() {
    let edges = [("teapot", None), ("exclusive", None), ("atoms", Some(2 * 200 * 199 + 199 * 199))];
    for (name, expected) in edges {
        let scene = open(name, Some([320, 240]), None).expect("built in");
        let wires = wire_frame(&scene).expect("legal");
        let count = wires.meshes[0].triangle_id_count();
        assert!(expected.is_none_or(|n| n == count), "{name}: {count} edges");
        let [direct, derived] = views(&wires);
        for (direct, derived) in direct.iter().zip(&derived) {
            assert!(direct.id == derived.id, "{name}");
            let ids = direct.id.iter().filter(|&&id| id != NO_ID).count();
            assert!(ids > 2000, "{name}: {ids}");
        }
    }
}

#[test]
fn lines_of_a_file_are_drawn_as_wire_frames_are() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("m.obj");
    let opened = |text: &str| {
        std::fs::write(&file, text).expect("written");
        open(&file.display().to_string(), Some(SIZE), None).expect("well-formed")
    };
    let frame = "v -2 -1 0 1 0 0\nv 2 -1 0 1 0 0\nv 2 1 0 1 0 0\nv -2 1 0 1 0 0\nl 1 2 3 4 1\n";
    let alone = opened(frame);
    let [direct, derived] = views(&alone);
    assert!(direct == derived);
    for frame in &direct {
        // Four sides of 128 by 64 pixels, unlit, each with its id.
        let lit = frame.colour.iter().filter(|&&colour| colour == [255, 0, 0]).count();
        assert!((2 * (96 + 48) - 8..2 * (96 + 48) + 8).contains(&lit), "{lit}");
        let ids: std::collections::BTreeSet<u32> = frame.id.iter().copied().collect();
        assert_eq!(ids.len(), 5);
    }
    // They are their own wire frame.
    let wires = wire_frame(&alone).expect("a legal scene");
    assert!(views(&wires)[0] == direct);
    // Before a face the lines have the ids after it; placed together they stay on its edges.
    let face = "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nf 1 2 3 4\nl 1 3\n";
    let mixed = opened(face);
    assert_eq!(mixed.meshes.iter().map(|mesh| mesh.lines).collect::<Vec<_>>(), [false, true]);
    let ends = mixed.meshes[0].positions.iter().map(|p| p[0]).fold(0.0, f64::max);
    assert!(mixed.meshes[1].positions.iter().all(|p| p[0].abs() <= ends + 1.0));
    let [direct, derived] = views(&mixed);
    assert!(direct == derived);
    let wires = wire_frame(&mixed).expect("a legal scene");
    assert_eq!(wires.meshes.iter().map(Mesh::id_count).collect::<Vec<_>>(), [4, 1]);
}
