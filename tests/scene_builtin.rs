//! The built-in scenes: the teapot's shape, and that each shows what its description says.

use std::collections::{BTreeSet, HashMap};
use wheatstone_golden::config::Config;
use wheatstone_golden::direct::Direct;
use wheatstone_golden::formats::{Eye, Formats, DEPTH_MAX};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::scene::builtin::{scene as builtin, teapot, SCENES};
use wheatstone_golden::scene::vector::{dot, outward, sub, Vec3};
use wheatstone_golden::scene::{Geometry, Options, Scene};
use wheatstone_golden::setup::{Eyes, Polygon, Vertex};
use wheatstone_golden::texture::Lookup;

const WIDE: Formats = Formats::new(&Config::DEFAULT);
const NARROW: Formats = Formats::new(&Config::PAPER);

fn geometry(scene: &Scene) -> Geometry {
    scene.geometry(&WIDE, &Options::default()).expect("the scene is legal")
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

#[test]
fn the_teapot_is_newells() {
    for level in [1, 2, 5, 10] {
        let mesh = teapot(level);
        assert_eq!(mesh.triangles.len() as u32, 64 * level * level - 8 * level);
        assert!(mesh.positions.iter().flatten().all(|n| n.is_finite()));
        assert!(mesh.normals.iter().all(|n| (dot(*n, *n) - 1.0).abs() < 1e-9));
    }
    let mesh = teapot(10);
    let has = |p: Vec3| mesh.positions.iter().any(|q| dot(sub(p, *q), sub(p, *q)) < 1e-18);
    // Corners of patches: rim, widest part, bottom, lid's knob and edge, handle, spout.
    for corner in [
        [1.4, 2.4, 0.0],
        [0.0, 2.4, -1.5],
        [2.0, 0.9, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 3.15, 0.0],
        [0.0, 2.4, 1.3],
        [-1.6, 2.025, 0.0],
        [-3.0, 1.8, 0.0],
        [1.7, 1.425, 0.0],
        [2.7, 2.4, 0.0],
        [3.2, 2.4, 0.0],
    ] {
        assert!(has(corner), "{corner:?}");
    }
    let extent = |axis: usize, pick: fn(f64, f64) -> f64, from: f64| {
        mesh.positions.iter().fold(from, |m, p| pick(m, p[axis]))
    };
    let size = |axis| [extent(axis, f64::min, f64::MAX), extent(axis, f64::max, f64::MIN)];
    assert_eq!(size(0)[0], -3.0);
    assert!((3.4..3.45).contains(&size(0)[1]), "{:?}", size(0));
    assert_eq!(size(1), [0.0, 3.15]);
    assert_eq!(size(2)[1], -size(2)[0]);
    assert!((1.99..2.01).contains(&size(2)[1]));
}

#[test]
fn the_teapot_is_closed_but_for_its_openings() {
    let mesh = teapot(6);
    // Mirrored patches may differ in the sign of zero.
    let key = |n: u32| mesh.positions[n as usize].map(|n| (n * 1e9).round() as i64);
    let mut edges: HashMap<_, i32> = HashMap::new();
    for t in &mesh.triangles {
        for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
            let [a, b] = [key(a), key(b)];
            // Neighbours follow a shared edge in opposite directions.
            *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    let open: Vec<_> = edges.iter().filter(|(_, n)| **n != 0).map(|(e, _)| *e).collect();
    assert!(open.iter().flatten().all(|[x, y, z]| {
        let [x, y, z] = [x, y, z].map(|n| *n as f64 / 1e9);
        let radius = (x * x + z * z).sqrt();
        // Rim and lid on their circles; handle and spout where they enter the body; the
        // spout's mouth.
        let circle = y == 2.4 && ((1.35..1.42).contains(&radius) || (1.25..1.32).contains(&radius));
        let handle = (-2.01..=-1.5).contains(&x) && z.abs() <= 0.3;
        let spout = x == 1.7 && z.abs() <= 0.66;
        let mouth = y == 2.4 && (2.7..=3.2).contains(&x);
        circle || handle || spout || mouth
    }));
    // 6 cells for each of 4 quarters of rim and lid, and 2 halves of the other four.
    assert_eq!(open.len(), 2 * 24 + 4 * 12);
    // Triangles face outward: away from the axis of the body, or from inside the tubes.
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|n| mesh.positions[n as usize]);
        let normal = outward(a, b, c);
        assert!(dot(normal, mesh.normals[t[0] as usize]) > -1e-12);
        if a[0].abs() < 1.9 && a[1] > 0.2 && a[1] < 2.3 && a[2].abs() > 0.8 {
            assert!(dot(normal, [a[0], 0.0, a[2]]) > 0.0, "{a:?}");
        }
    }
}

#[test]
fn built_in_scenes_can_be_drawn_at_any_size() {
    for builtin_scene in SCENES {
        let name = builtin_scene.name;
        assert!(builtin_scene.description.len() > 20 && !builtin_scene.description.contains('\n'));
        for (formats, width, height) in [
            (WIDE, 640, 480),
            (NARROW, 640, 480),
            (WIDE, 2048, 2048),
            (NARROW, 33, 57),
            (WIDE, 1, 1),
        ] {
            let scene = builtin(name, width, height).expect(name);
            let seen = scene.geometry(&formats, &Options::default()).expect(name);
            assert!(!seen.polygons.is_empty() || width < 100, "{name} {width}");
            let one = formats.one_pixel() as i32;
            let guard = formats.guard_band as i32;
            for vertex in seen.polygons.iter().flat_map(|p| &p.vertices) {
                let legal =
                    |n: i32, size: u32| (-guard * one..=(size as i32 + guard) * one).contains(&n);
                assert!(vertex.x.iter().all(|&x| legal(x, width)), "{name}: {vertex:?}");
                assert!(vertex.y.iter().all(|&y| legal(y, height)), "{name}: {vertex:?}");
                assert!(vertex.depth <= DEPTH_MAX && vertex.inverse <= 1 << 24);
            }
            let nearest = |p: &Polygon| p.vertices.iter().map(|v| v.inverse).max();
            assert!(seen.polygons.iter().all(|p| nearest(p) == Some(1 << 24)));
            let again = scene.geometry(&formats, &Options::default()).expect(name);
            assert_eq!(seen.polygons, again.polygons);
        }
    }
}

#[test]
fn each_built_in_scene_shows_what_it_says() {
    let of = |name: &str| geometry(&builtin(name, 640, 480).expect(name));
    let teapot = of("teapot");
    assert_eq!((teapot.polygons.len(), teapot.counts.triangles), (6320, 6320));
    let specular = |g: &Geometry| g.polygons.iter().filter(|p| p.specular).count();
    assert!((100..2000).contains(&specular(&teapot)));
    // Well framed: most of the width, all of it in view.
    let columns = || teapot.polygons.iter().flat_map(|p| &p.vertices).flat_map(|v| v.x);
    let width = (columns().max().unwrap_or(0) - columns().min().unwrap_or(0)) / 256;
    assert!((400..600).contains(&width), "{width}");
    assert!(columns().all(|x| (10 * 256..630 * 256).contains(&x)));

    let room = of("room");
    assert!(room.textures.len() >= 6 && specular(&room) > 500);
    let disparity = |g: &Geometry| -> (i32, i32) {
        let all = g.polygons.iter().filter(|p| p.eyes == Eyes::Both).flat_map(|p| &p.vertices);
        all.map(|v| (v.x[1] - v.x[0]) / 256).fold((0, 0), |(a, b), d| (a.min(d), b.max(d)))
    };
    let (before, behind) = disparity(&room);
    assert!((-40..-10).contains(&before) && (30..70).contains(&behind), "{before} {behind}");
    assert!(room.polygons.iter().any(|p| p.vertices[0].colour[0].0[3] < 255));
    assert_eq!(disparity(&of("ramp")), (-32, 32));

    // Eight buildings with their grounds; nothing is cut.
    let village = of("village");
    assert_eq!(village.counts.triangles, 1_109);
    assert_eq!((village.counts.clipped, village.counts.guard_band, specular(&village)), (0, 0, 0));
    let (before, behind) = disparity(&village);
    assert!((-60..-5).contains(&before) && (40..80).contains(&behind), "{before} {behind}");

    // Ratios of area, and the panels past the limit.
    let ratios: Vec<f64> = of("ratio")
        .polygons
        .iter()
        .map(|p| {
            let [a, b] = Eye::BOTH.map(|eye| area(p, eye) as f64);
            if a.abs() > b.abs() {
                b / a
            } else {
                a / b
            }
        })
        .collect();
    assert!((ratios[0] - 1.0).abs() < 1e-9 && (ratios[1] - 1.0).abs() < 1e-9);
    assert!(ratios.iter().any(|r| (r - 1.0 / 28.0).abs() < 0.002));
    assert!(ratios.iter().any(|r| *r > 0.005 && *r < 0.03) && ratios.iter().any(|r| *r < -0.05));

    let exclusive = of("exclusive");
    let one_eyed = exclusive
        .polygons
        .iter()
        .filter(|p| area(p, Eye::Left).signum() * area(p, Eye::Right).signum() < 0);
    assert!(one_eyed.count() >= 30);
    let polygons = of("polygons");
    let corners = |n: usize| polygons.polygons.iter().filter(|p| p.vertices.len() == n).count();
    assert_eq!([4, 5, 6].map(corners), [5, 5, 5]);
    let windows = of("windows").counts;
    assert!(windows.guard_band > 10 && windows.clipped > 10 && windows.outside > 2, "{windows:?}");
    // Much less than a pixel wide on their 200 or more of length.
    let slivers = of("slivers");
    let thin = |p: &&Polygon| area(p, Eye::Left).abs() < 256 * 256 * 200;
    let count = slivers.polygons.iter().filter(thin).count();
    assert!(count > 50, "{count} of {}", slivers.polygons.len());
}

#[test]
fn corners_of_ties_lie_on_pixel_centres() {
    for (width, height) in [(640, 480), (641, 479)] {
        let scene = builtin("ties", width, height).expect("there is one");
        for formats in [WIDE, if width > 640 { WIDE } else { NARROW }] {
            let seen = scene.geometry(&formats, &Options::default()).expect("legal");
            let half = formats.one_pixel() as i32 / 2;
            let centred = |n: i32| n.rem_euclid(2 * half) == half;
            let net = seen.polygons.iter().filter(|p| p.id < 96).flat_map(|p| &p.vertices);
            let corners = net.flat_map(|v| v.x.into_iter().chain(v.y));
            assert!(corners.clone().count() == 96 * 12 && corners.into_iter().all(centred));
        }
    }
    let scene = builtin("ties", 640, 480).expect("there is one");
    let seen = geometry(&scene);
    let depths: Vec<u32> = seen.polygons.iter().map(|p| p.vertices[0].depth).collect();
    assert!(depths.windows(3).any(|d| d[0] == d[1] && d[1] == d[2]));
    assert_eq!(seen.counts.empty, 2);
    assert!(seen.polygons.iter().any(|p| area(p, Eye::Left) == 0 && area(p, Eye::Right) != 0));
}

/// Ids of the polygons that an eye sees.
fn seen(scene: &Scene, eye: Eye) -> BTreeSet<u32> {
    let direct = Direct { formats: WIDE, textures: &[], lookup: Lookup::Nearest };
    let mut frame = Frame::new(scene.width, scene.height, scene.background);
    geometry(scene).polygons.iter().for_each(|p| direct.draw(p, eye, &mut frame));
    frame.id.into_iter().filter(|&id| id != NO_ID).collect()
}

/// Heo, Jung and Wohn 1998, table 1: polygons visible to the right eye at 300 x 300 pixels, for one to
/// fifteen rooms.
const VISIBLE: [usize; 15] =
    [301, 474, 536, 569, 584, 604, 617, 623, 626, 632, 634, 636, 638, 638, 640];

#[test]
fn as_many_polygons_of_the_office_are_visible_as_were_published() {
    for (rooms, published) in (1..).zip(VISIBLE) {
        let scene = builtin(&format!("office-{rooms}"), 300, 300).expect("there is one");
        assert_eq!(scene.meshes.iter().map(|m| m.id_count()).sum::<usize>(), 3652 * rooms);
        let visible = seen(&scene, Eye::Right).len();
        let off = visible as f64 / published as f64 - 1.0;
        println!("{rooms} rooms: {visible}, {:+.1} %", 100.0 * off);
        assert!(off.abs() <= 0.06, "{rooms} rooms: {visible} visible, published {published}");
    }
    let whole = builtin("office", 300, 300).expect("there is one");
    assert_eq!(whole.meshes, builtin("office-15", 300, 300).expect("the same").meshes);
    for name in ["office-0", "office-16", "office-", "office-x"] {
        let error = builtin(name, 300, 300).expect_err("no such scene").to_string();
        assert!(error.contains(name) && error.contains("office"), "{error}");
    }
}

#[test]
fn one_eye_alone_sees_what_the_perception_scenes_hide() {
    // Ids of the blue cylinder follow those of floor, wall and red cylinder; the slot's end is
    // the first polygon of the solid.
    let surroundings = 2 + (16 * 14 + 16 * 8) / 2;
    let blue = surroundings + 36..surroundings + 72;
    let slot = surroundings..surroundings + 1;
    for (name, hidden, least) in [("perception-cylinder", blue, 10), ("perception-solid", slot, 1)]
    {
        let scene = builtin(name, 640, 480).expect(name);
        let [left, right] = Eye::BOTH.map(|eye| seen(&scene, eye));
        let of = |ids: &BTreeSet<u32>| hidden.clone().filter(|id| ids.contains(id)).count();
        assert_eq!(of(&left), 0, "{name}");
        assert!(of(&right) >= least, "{name}: {}", of(&right));
    }
}
