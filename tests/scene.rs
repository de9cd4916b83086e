//! Projection, clipping and culling.

use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats, Rgba, DEPTH_MAX};
use wheatstone_golden::projection::{Partition, Piecewise, Projection};
use wheatstone_golden::scene::builtin::scene as builtin;
use wheatstone_golden::scene::vector::Vec3;
use wheatstone_golden::scene::{
    json, Camera, Colours, Cull, Geometry, Material, Mesh, Options, Rig, Scene,
};
use wheatstone_golden::setup::{Eyes, Polygon, Vertex};
use wheatstone_golden::texture::Texture;

const WIDE: Formats = Formats::new(&Config::DEFAULT);
const NARROW: Formats = Formats::new(&Config::PAPER);

fn triangles(positions: Vec<Vec3>, rig: Rig) -> Scene {
    let count = positions.len() as u32;
    let colours = Colours::Vertex((0..count).map(|n| [(n % 6) as u8 * 40, 100, 200]).collect());
    let triangles = (0..count / 3).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    Scene {
        width: 640,
        height: 480,
        rig,
        materials: vec![Material::default()],
        meshes: vec![Mesh { positions, triangles, colours, ..Mesh::default() }],
        ..Scene::default()
    }
}

fn geometry(scene: &Scene) -> Geometry {
    scene.geometry(&WIDE, &Options::default()).expect("the scene is legal")
}

fn rig(pixels_per_unit: f64, eye_separation: f64, viewing_distance: f64) -> Rig {
    Rig { pixels_per_unit, eye_separation, viewing_distance, ..Rig::default() }
}

/// n/d rounded to the nearest integer, ties to even.
fn nearest(n: i128, d: i128) -> i128 {
    let (n, d) = if d < 0 { (-n, -d) } else { (n, d) };
    let floor = n.div_euclid(d);
    match (2 * n.rem_euclid(d)).cmp(&d) {
        std::cmp::Ordering::Less => floor,
        std::cmp::Ordering::Greater => floor + 1,
        std::cmp::Ordering::Equal => floor + floor.rem_euclid(2),
    }
}

#[test]
fn projection_is_the_exact_one_rounded() {
    // The line from the eye through the point meets the screen at eye + (p - eye) d / (z + d).
    // Where 1 + z/d is exact in binary, so is the result; else it may be wrong at a tie.
    const ONE: i128 = 4096;
    for (d, exact) in [(32, true), (37, false)] {
        let e = 5;
        let camera = Camera::new(&rig(32.0, e as f64, d as f64), 640, 480, &WIDE);
        let mut random = fastrand::Rng::with_seed(1);
        let mut ties = 0;
        let mut check = |middle: i128, numerator: i128, denominator: i128, snapped: i64| {
            let tie = (2 * numerator).rem_euclid(denominator) == 0
                && numerator.rem_euclid(denominator) != 0;
            ties += i32::from(tie);
            let error = i128::from(snapped) - middle * 128 - nearest(numerator, denominator);
            assert!(error == 0 || (tie && !exact && error.abs() == 1), "{error}");
        };
        for _ in 0..200_000 {
            let mut n = |limit: i64| i128::from(random.i64(-limit..limit));
            let (x, y) = (n(50 * 4096), n(50 * 4096));
            let z = match n(8) {
                0 => 0,
                1 => d * ONE,
                2 => 3 * d * ONE,
                _ => n(31 * 4096),
            };
            let snapped = camera.snap([x, y, z].map(|n| n as f64 / ONE as f64));
            for eye in Eye::BOTH {
                // Twice the position of the eye; ppu · 256 / ONE is 2.
                let from = if eye == Eye::Left { -ONE * e } else { ONE * e };
                let below = z + ONE * d;
                let across = from * below + (2 * x - from) * ONE * d;
                check(640, across, below, snapped.x[eye as usize]);
                check(480, -2 * y * ONE * d, below, snapped.y[eye as usize]);
            }
        }
        assert!(ties > 1000, "{ties}");
    }
}

#[test]
fn far_points_are_displaced_outward() {
    let camera = Camera::new(&rig(10.0, 6.0, 50.0), 640, 480, &WIDE);
    // At z = d half of the separation, at z = -d/2 the whole of it, crossed.
    assert_eq!(camera.pixel([0.0, 0.0, 50.0], Eye::Left), [305.0, 240.0]);
    assert_eq!(camera.pixel([0.0, 0.0, 50.0], Eye::Right), [335.0, 240.0]);
    assert_eq!(camera.pixel([0.0, 1.0, -25.0], Eye::Left), [350.0, 220.0]);
    assert_eq!(camera.pixel([2.0, -1.0, 0.0], Eye::Left), [340.0, 250.0]);
    let tilted = Rig { head_tilt: 90.0, ..rig(10.0, 6.0, 50.0) };
    let camera = Camera::new(&tilted, 640, 480, &WIDE);
    // The left eye is below, the right one above.
    assert_eq!(camera.pixel([0.0, 0.0, 50.0], Eye::Left), [320.0, 255.0]);
    assert_eq!(tilted.eye(Eye::Right), [0.0, 3.0, -50.0]);
}

#[test]
fn ties_go_to_even_subpixels() {
    let camera = Camera::new(&rig(1.0, 0.0, 1.0), 640, 480, &WIDE);
    for (halves, expected) in [(1, 0), (3, 2), (5, 2), (-1, 0), (-3, -2), (7, 4), (2, 1)] {
        let snapped = camera.snap([f64::from(halves) / 512.0, f64::from(-halves) / 512.0, 0.0]);
        assert_eq!(snapped.x, [320 * 256 + expected; 2], "{halves}");
        assert_eq!(snapped.y, [240 * 256 + expected; 2], "{halves}");
    }
    let coarse = Camera::new(&rig(1.0, 0.0, 1.0), 640, 480, &NARROW);
    assert_eq!(coarse.snap([1.0 / 32.0, 0.0, 0.0]).x, [320 * 16; 2]);
    assert_eq!(coarse.snap([3.0 / 32.0, 0.0, 0.0]).x, [320 * 16 + 2; 2]);
}

#[test]
fn depth_is_affine_in_the_inverse_distance() {
    for (near, far) in [(None, None), (Some(0.125), Some(77.0)), (Some(0.001), Some(1e8))] {
        let rig = Rig { near, far, ..rig(10.0, 1.0, 16.0) };
        let camera = Camera::new(&rig, 640, 480, &WIDE);
        let depth = |w: f64| camera.depth([5.0, -3.0, w - 16.0]);
        assert_eq!(depth(rig.near()), 0);
        assert_eq!(depth(rig.far()), DEPTH_MAX);
        for k in 1..100 {
            let t = f64::from(k) / 100.0;
            let w = 1.0 / ((1.0 - t) / rig.near() + t / rig.far());
            assert!((f64::from(depth(w)) - t * f64::from(DEPTH_MAX)).abs() < 1.0);
        }
    }
}

/// Twice the area in an eye's view, in subpixels.
fn area(polygon: &Polygon, eye: Eye) -> i64 {
    let at = |v: &Vertex| (i64::from(v.x[eye as usize]), i64::from(v.y[eye as usize]));
    let (x0, y0) = at(&polygon.vertices[0]);
    polygon.vertices[1..]
        .windows(2)
        .map(|pair| {
            let ((x1, y1), (x2, y2)) = (at(&pair[0]), at(&pair[1]));
            (x2 - x0) * (y1 - y0) - (x1 - x0) * (y2 - y0)
        })
        .sum()
}

fn total(geometry: &Geometry, eye: Eye) -> i64 {
    let seen = geometry.polygons.iter().filter(|p| p.eyes.contains(eye));
    seen.map(|p| area(p, eye).abs()).sum()
}

#[test]
fn the_near_plane_cuts_what_passes_it() {
    // A floor from well behind the viewer to before the screen, and a triangle all behind.
    let scene = triangles(
        vec![
            [0.0, 0.0, 5.0],
            [1.0, 0.0, 5.0],
            [0.0, 1.0, 5.0],
            [-30.0, -2.0, -30.0],
            [0.0, -2.0, 20.0],
            [30.0, -2.0, -30.0],
            [0.0, 0.0, -12.0],
            [1.0, 0.0, -11.0],
            [0.0, 1.0, -10.0],
        ],
        rig(20.0, 0.6, 10.0),
    );
    let geometry = geometry(&scene);
    let cut: Vec<&Polygon> = geometry.polygons.iter().filter(|p| p.id == 1).collect();
    assert!(cut.len() >= 2, "{}", cut.len());
    assert!(geometry.polygons.iter().all(|p| p.id <= 1));
    assert_eq!((geometry.counts.clipped, geometry.counts.behind), (1, 1));
    let bottom = cut.iter().flat_map(|p| &p.vertices).map(|v| v.y[0]).max();
    // Cut off at the lower edge of the guard band.
    assert_eq!(bottom, Some((480 + 1024) * 256));
    // What is in view hides nothing of the first triangle: all in front of the far plane.
    assert!(cut.iter().flat_map(|p| &p.vertices).all(|v| v.depth < DEPTH_MAX));
    let white = |v: &Vertex| v.colour[0].0[3] == 255 && v.colour[0].0[1] == 100;
    assert!(cut.iter().flat_map(|p| &p.vertices).all(white));
}

/// True if a point, in half subpixels, is inside any of the polygons by an even-odd count of edges.
fn covers<'a>(polygons: impl Iterator<Item = &'a Polygon>, eye: Eye, x: i64, y: i64) -> bool {
    let inside = |p: &Polygon| {
        let at = |v: &Vertex| [2 * i64::from(v.x[eye as usize]), 2 * i64::from(v.y[eye as usize])];
        let count = p.vertices.len();
        (0..count).fold(false, |inside, k| {
            let ([x0, y0], [x1, y1]) = (at(&p.vertices[k]), at(&p.vertices[(k + 1) % count]));
            let crossed = (y0 > y) != (y1 > y) && {
                let side = i128::from(x - x0) * i128::from(y1 - y0)
                    - i128::from(x1 - x0) * i128::from(y - y0);
                (side < 0) == (y1 > y0)
            };
            inside != crossed
        })
    };
    polygons.into_iter().any(inside)
}

#[test]
fn cutting_at_the_guard_band_changes_nothing_in_view() {
    let mut random = fastrand::Rng::with_seed(3);
    let mut split = 0;
    for _ in 0..60 {
        let mut corner = |k: usize| {
            let reach = [300.0, 9000.0, 3000.0][k];
            let mut n = || (random.f64() - 0.5) * 2.0;
            [n() * reach, n() * reach * 0.08, n() * 200.0]
        };
        let positions = vec![corner(0), corner(1), corner(2)];
        let scene = triangles(positions.clone(), rig(1.0, 64.0, 640.0));
        let cut = geometry(&scene);
        let camera = Camera::new(&scene.rig, 640, 480, &WIDE);
        let whole = Polygon {
            vertices: positions
                .iter()
                .map(|&p| {
                    let snapped = camera.snap(p);
                    let [x, y] = [snapped.x, snapped.y].map(|n| n.map(|n| n as i32));
                    Vertex { x, y, ..Vertex::default() }
                })
                .collect(),
            ..Polygon::default()
        };
        let leaves = whole
            .vertices
            .iter()
            .any(|v| v.x.iter().any(|x| !(-1024 * 256..=(640 + 1024) * 256).contains(x)));
        split += usize::from(leaves);
        let mut wrong = 0;
        for eye in Eye::BOTH {
            let mine = || cut.polygons.iter().filter(|p| p.eyes.contains(eye));
            assert!(mine().all(|p| p.guard_band == leaves && p.id == 0));
            assert!(mine().all(|p| leaves == (p.eyes == Eyes::One(eye))));
            for polygon in mine() {
                for vertex in &polygon.vertices {
                    let [x, y] = [vertex.x[eye as usize], vertex.y[eye as usize]];
                    assert!((-1024 * 256..=(640 + 1024) * 256).contains(&x), "{x}");
                    assert!((-1024 * 256..=(480 + 1024) * 256).contains(&y), "{y}");
                }
            }
            for _ in 0..400 {
                let [x, y] = [random.i64(..640 * 512), random.i64(..480 * 512)];
                let here = covers(mine(), eye, x, y);
                wrong += i32::from(here != covers(std::iter::once(&whole), eye, x, y));
            }
        }
        // Only within a subpixel of an edge.
        assert!(wrong <= 2, "{wrong} points of 800");
    }
    assert!(split > 30);
}

#[test]
fn rows_above_and_below_are_cut_for_both_eyes_alike() {
    let positions = vec![[-50.0, 9000.0, 100.0], [-60.0, -9000.0, -100.0], [50.0, 100.0, 300.0]];
    let scene = triangles(positions, rig(1.0, 64.0, 640.0));
    let cut = geometry(&scene);
    assert!(cut.polygons.len() >= 2);
    for polygon in &cut.polygons {
        assert_eq!((polygon.eyes, polygon.guard_band, polygon.id), (Eyes::Both, false, 0));
        assert!(polygon.vertices.iter().all(|v| v.y[0] == v.y[1]));
    }
    // With the narrow guard band the same, nearer.
    let narrow = scene.geometry(&NARROW, &Options::default()).expect("legal");
    let rows = || narrow.polygons.iter().flat_map(|p| &p.vertices).map(|v| v.y[0]);
    assert_eq!((rows().min(), rows().max()), (Some(-192 * 16), Some((480 + 192) * 16)));
}

#[test]
fn a_tilted_head_has_rows_of_its_own() {
    let positions = vec![[-50.0, -20.0, 100.0], [60.0, -30.0, -100.0], [10.0, 100.0, 300.0]];
    let tilted = Rig { head_tilt: 10.0, ..rig(1.0, 64.0, 640.0) };
    let seen = geometry(&triangles(positions.clone(), tilted.clone()));
    assert!(seen.polygons[0].vertices.iter().all(|v| v.y[0] != v.y[1]));
    let far = positions.iter().map(|p| [p[0], p[1] * 100.0, p[2]]).collect();
    let cut = geometry(&triangles(far, tilted));
    assert!(cut.polygons.iter().all(|p| p.guard_band && p.eyes != Eyes::Both));
}

#[test]
fn what_is_outside_both_windows_is_dropped() {
    let beside = |x: f64| [[x, 0.0, 0.0], [x + 10.0, 0.0, 0.0], [x, 10.0, 0.0]];
    let positions = [beside(-400.0), beside(0.0), beside(321.0), beside(-330.0)].concat();
    let seen = geometry(&triangles(positions, rig(1.0, 64.0, 640.0)));
    assert_eq!(seen.polygons.iter().map(|p| p.id).collect::<Vec<_>>(), [1]);
    assert_eq!(seen.counts.outside, 3);
    // In one window only.
    let near = beside(-225.0).map(|[x, y, _]| [x, y, -200.0]).to_vec();
    let seen = geometry(&triangles(near, rig(1.0, 64.0, 640.0)));
    assert_eq!((seen.polygons.len(), seen.polygons[0].eyes), (1, Eyes::Both));
}

#[test]
fn culling_decides_for_each_eye() {
    // Counter-clockwise as seen, clockwise, without area, and a wall between the eyes whose
    // left side is its front.
    let wall = [[0.0, 0.0, 100.0], [0.0, 0.0, 0.0], [0.0, 50.0, 0.0]];
    let positions = [
        [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0]],
        [[0.0, 0.0, 0.0], [0.0, 10.0, 0.0], [10.0, 0.0, 0.0]],
        [[0.0, 0.0, 0.0], [10.0, 10.0, 0.0], [20.0, 20.0, 0.0]],
        wall,
    ]
    .concat();
    let scene = triangles(positions, rig(1.0, 64.0, 640.0));
    let all = geometry(&scene);
    assert_eq!(all.polygons.iter().map(|p| p.id).collect::<Vec<_>>(), [0, 1, 3]);
    assert_eq!(all.counts.empty, 1);
    let options = Options { cull: Cull::Back, ..Options::default() };
    let culled = scene.geometry(&WIDE, &options).expect("legal");
    let seen: Vec<(u32, Eyes)> = culled.polygons.iter().map(|p| (p.id, p.eyes)).collect();
    assert_eq!(seen, [(0, Eyes::Both), (3, Eyes::One(Eye::Left))]);
    assert_eq!((culled.counts.culled, culled.counts.half_culled), (1, 1));
    assert_eq!(culled.counts.empty, 1);
}

#[test]
fn where_nothing_is_drawn_the_counts_say_why() {
    let (d, far) = (640.0, 64_000.0);
    let at = |z: f64| [[0.0, 0.0, z], [10.0, 0.0, z], [0.0, 10.0, z]];
    let moved = |x: f64| at(0.0).map(|p| [p[0] + x, p[1], p[2]]);
    let cases = [
        ("1 behind the eyes", at(-d - 1.0)),
        ("1 nearer than the rig's near plane", at(-d + 1.0)),
        ("1 farther than the rig's far plane", at(far)),
        ("1 outside the views", moved(1000.0)),
        ("1 without area (polygon 0 is the first)", [[1.0, 2.0, 3.0]; 3]),
        ("1 without area (polygon 0 is the first)", [1.0, 3.0, 7.0].map(|n| [n, n, 0.0])),
        ("1 seen edge-on", [[-10.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 0.0, 10.0]]),
        ("1 smaller than a subpixel", at(0.0).map(|p| p.map(|n| n / 1e6))),
    ];
    for (reason, positions) in cases {
        let counts = geometry(&triangles(positions.to_vec(), rig(1.0, 64.0, d))).counts;
        assert_eq!(counts.to_string(), reason);
        let said = counts.nothing().unwrap_or_default();
        assert!(said.starts_with(reason) && said.contains("; try: "), "{said}");
    }
    // Transparent all over, by the material or by a picture.
    let mut scene = triangles(at(0.0).to_vec(), rig(1.0, 64.0, d));
    assert_eq!(geometry(&scene).counts.nothing(), None);
    let mut clear = scene.clone();
    clear.materials[0].alpha = 0.0;
    scene.materials[0].texture = Some(0);
    scene.meshes[0].texture_coordinates = vec![[0.0; 2], [1.0; 2], [2.0, 0.0]];
    scene.textures =
        vec![Texture { width: 2, height: 1, texels: vec![Rgba([9, 9, 9, 0]), Rgba([9; 4])] }];
    assert_eq!(geometry(&scene).counts.nothing(), None);
    scene.textures[0].texels[1] = Rgba::default();
    for scene in [clear, scene] {
        let said = geometry(&scene).counts.nothing().unwrap_or_default();
        assert!(
            said.starts_with("1 fully transparent; try: give its material a d above"),
            "{said}"
        );
    }
    // Both reasons, the help against the more frequent one.
    let mut clockwise = at(0.0);
    clockwise.swap(1, 2);
    let positions = [clockwise, at(far), clockwise].concat();
    let scene = triangles(positions, rig(1.0, 64.0, d));
    let options = Options { cull: Cull::Back, ..Options::default() };
    let counts = scene.geometry(&WIDE, &options).expect("legal").counts;
    let expected = "1 farther than the rig's far plane, 2 culled for both eyes";
    assert_eq!(
        counts.nothing().as_deref(),
        Some(&*format!("{expected}; try: leave out --cull back"))
    );
    assert_eq!(geometry(&scene).counts.nothing(), None);
    let nothing = geometry(&triangles(Vec::new(), rig(1.0, 64.0, d))).counts.nothing();
    assert_eq!(nothing.as_deref(), Some("there is no triangle and no face"));
    // Between two partitions.
    let mut scene = triangles(at(50.0).to_vec(), rig(1.0, 64.0, d));
    let gap = [(300.0, 650.0), (700.0, 900.0)].map(|(near, far)| Partition {
        near,
        far,
        min_distance: near,
        max_distance: far,
    });
    scene.rig.projection =
        Projection::Piecewise(Piecewise { partitions: gap.to_vec(), ..Piecewise::default() });
    assert_eq!(geometry(&scene).counts.to_string(), "1 at distances of no partition");
}

#[test]
fn a_face_that_is_not_convex_is_cut() {
    // An L, from each of its corners.
    let outline = [[0, 0], [20, 0], [20, 10], [10, 10], [10, 20], [0, 20]];
    let covered = |first: usize| {
        let positions = outline.iter().map(|p| [f64::from(p[0]), f64::from(p[1]), 0.0]).collect();
        let mut scene = triangles(positions, rig(1.0, 64.0, 640.0));
        let mesh = &mut scene.meshes[0];
        mesh.triangles.clear();
        let mut face: Vec<u32> = (0..6).collect();
        face.rotate_left(first);
        mesh.faces = vec![face];
        let seen = geometry(&scene);
        assert!(seen.polygons.iter().all(|p| p.id == 0));
        let pieces: Vec<i64> = seen.polygons.iter().map(|p| area(p, Eye::Left)).collect();
        assert!(pieces.iter().all(|&area| area > 0), "{first}: {pieces:?}");
        pieces.iter().sum::<i64>()
    };
    for first in 0..6 {
        assert_eq!(covered(first), 2 * 300 * 256 * 256);
    }
}

#[test]
fn texture_coordinates_keep_near_zero_and_inverses_near_one() {
    let mut scene = triangles(
        vec![[0.0, 0.0, 0.0], [10.0, 0.0, 640.0], [0.0, 10.0, 1920.0]],
        rig(1.0, 64.0, 640.0),
    );
    let texels = vec![Rgba([255; 4]); 64 * 32];
    scene.textures = vec![Texture { width: 64, height: 32, texels }];
    scene.materials[0].texture = Some(0);
    scene.meshes[0].texture_coordinates = vec![[100.25, -7.0], [101.5, -6.5], [100.0, -7.25]];
    let polygon = &geometry(&scene).polygons[0];
    assert_eq!(polygon.texture, Some(0));
    let corner = |n: usize| (polygon.vertices[n].texel, polygon.vertices[n].inverse);
    assert_eq!(corner(0), ([64 * 64, 32 * 256], 1 << 24));
    assert_eq!(corner(1), ([96 * 256, 48 * 256], 1 << 23));
    assert_eq!(corner(2), ([0, 24 * 256], 1 << 22));
}

#[test]
fn a_scene_may_be_too_large_for_a_configuration() {
    let mut scene = builtin("ramp", 800, 600).expect("there is one");
    let error = scene.geometry(&NARROW, &Options::default()).unwrap_err().to_string();
    assert!(error.starts_with("size 800x600: expected 1x1 to 640x640 pixels; give "), "{error}");
    scene.rig.viewing_distance = f64::NAN;
    let error = scene.geometry(&WIDE, &Options::default()).unwrap_err().to_string();
    assert!(error.starts_with("viewing_distance: expected"), "{error}");
    assert!(builtin("ramp", 0, 5).is_err());
    assert!(builtin("ramp", 2049, 5).is_err());
}

#[test]
fn a_scene_file_is_drawn_as_it_stands() {
    let text = r#"{"format": "stereo-scene/1", "width": 200, "height": 100,
        "pixels_per_unit": 10, "eye_separation": 6, "viewing_distance": 50.0,
        "background": [1, 2, 3], "vertices": [[0, 0, 0], [4, 0, 50], [0, 3, 50], [1, 1, 1]],
        "colors": [[255, 0, 0], [0, 255, 0], [0, 0, 255], [9, 9, 9]],
        "triangles": [[3, 3, 3], [0, 1, 2], [2, 1, 0]]"#;
    let plain = json::scene(Path::new("x.json"), &format!("{text}}}")).expect("well-formed");
    let seen = geometry(&plain);
    assert_eq!((seen.width, seen.height, seen.background.rgb()), (200, 100, [1, 2, 3]));
    assert_eq!(seen.counts.empty, 1);
    assert_eq!(seen.polygons.iter().map(|p| p.id).collect::<Vec<_>>(), [1, 2]);
    let vertices = &seen.polygons[0].vertices;
    assert_eq!(vertices[0].x, [100 * 256; 2]);
    // Half the size at twice the distance, 15 pixels apart from the middle.
    assert_eq!(vertices[1].x, [(100 + 20 - 15) * 256, (100 + 20 + 15) * 256]);
    assert_eq!(vertices[2].y, [(50 - 15) * 256; 2]);
    assert_eq!(vertices[1].colour.map(|c| c.0), [[0, 255, 0, 255]; 2]);
    assert_eq!(total(&seen, Eye::Left), 2 * area(&seen.polygons[0], Eye::Left));

    let flat = format!("{text}, \"triangle_colors\": [[1,1,1], [7,8,9], [4,4,4]], \"far\": 80}}");
    let flat = json::scene(Path::new("x.json"), &flat).expect("well-formed");
    let seen = geometry(&flat);
    // The far plane cuts off the two corners behind it.
    let pieces: Vec<&Polygon> = seen.polygons.iter().filter(|p| p.id == 1).collect();
    assert!(pieces.iter().all(|p| p.vertices.iter().all(|v| v.colour[1].0 == [7, 8, 9, 255])));
    let deepest = pieces.iter().flat_map(|p| &p.vertices).map(|v| v.depth).max();
    assert_eq!(deepest, Some(DEPTH_MAX));
}

#[test]
fn extreme_scenes_stay_within_the_formats() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut drawn = 0;
    for _ in 0..20_000 {
        let magnitudes = [1e9, 1e6, 1e3, 1.0, 1e-3, 1e-9];
        let most = magnitudes[random.usize(..6)];
        let mut corner =
            || [0; 3].map(|_| (random.f64() - 0.5) * if random.bool() { most } else { 2.0 });
        let positions = vec![corner(), corner(), corner()];
        let mut power = |range: f64| 10f64.powf((random.f64() - 0.5) * range);
        let rig = Rig { head_tilt: 0.0, ..rig(power(18.0), power(18.0), power(14.0)) };
        let tilt = if random.bool() { random.f64() * 360.0 - 180.0 } else { 0.0 };
        let scene = triangles(positions, Rig { head_tilt: tilt, ..rig });
        for formats in [WIDE, NARROW] {
            let options = Options { cull: Cull::Back, ..Options::default() };
            let seen = scene.geometry(&formats, &options).expect("legal");
            drawn += seen.polygons.len();
            let (one, guard) = (formats.one_pixel() as i32, formats.guard_band as i32);
            for vertex in seen.polygons.iter().flat_map(|p| &p.vertices) {
                let legal = |n: &i32, size: i32| (-guard * one..=(size + guard) * one).contains(n);
                assert!(vertex.x.iter().all(|x| legal(x, 640)), "{scene:?}");
                assert!(vertex.y.iter().all(|y| legal(y, 480)), "{scene:?}");
                assert!(vertex.depth <= DEPTH_MAX && vertex.inverse <= 1 << 24, "{scene:?}");
            }
        }
    }
    assert!(drawn > 5000, "{drawn}");
}
