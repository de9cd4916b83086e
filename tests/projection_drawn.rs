//! Scenes in every projection: drawn directly, by both systems and by the Verilog.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Coordinate, Eye, Formats, Quantity, DEPTH_MAX};
use wheatstone_golden::frame::NO_ID;
use wheatstone_golden::projection::{Kind, Partition, Piecewise, Projection};
use wheatstone_golden::scene::{
    self, open_projected, Camera, Geometry, Material, Mesh, Rig, Scene,
};
use wheatstone_golden::setup::{Arrangement, Options, Placement};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;
use wheatstone_golden::texture::Lookup;
use wheatstone_testbench::regression::NamedScene;
use wheatstone_tests::{builder, plan, run, settings};

/// Everything built in that makes the hybrid exact with an upright head.
const EXACT: Config = Config { tilt: false, ..Config::FULL };
const SIZE: [u32; 2] = [240, 180];

fn scene(name: &str, kind: Kind) -> Scene {
    open_projected(name, Some(SIZE), None, Some(kind)).unwrap_or_else(|error| panic!("{error}"))
}

fn geometry(scene: &Scene, config: &Config) -> Geometry {
    let geometry = scene.geometry(&Formats::new(config), &scene::Options::default());
    geometry.unwrap_or_else(|error| panic!("{error}"))
}

fn job(config: Config, options: Options, geometry: &Geometry) -> Job<'_> {
    Job::of(geometry, config, options, Lookup::Bilinear)
}

#[test]
fn the_hybrid_draws_every_projection_exactly() {
    for kind in Kind::ALL {
        for name in ["teapot", "room", "exclusive"] {
            let geometry = geometry(&scene(name, kind), &EXACT);
            let options = Options { cost_rule: false, ..Options::new(&EXACT) };
            let job = job(EXACT, options, &geometry);
            let (frames, counts) = job.derived(false);
            for (ours, direct) in frames.eyes.iter().zip(&job.direct()) {
                let what = format!("{} of {name}", kind.name());
                assert!(ours.depth == direct.depth && ours.id == direct.id, "{what}");
                assert!(ours.colour == direct.colour || !geometry.textures.is_empty(), "{what}");
            }
            assert!(counts.derived > 50, "{}: {} derived", kind.name(), counts.derived);
        }
    }
}

#[test]
fn only_asymptotic_and_piecewise_views_differ() {
    let pixels = |kind| {
        let direct = {
            let geometry = geometry(&scene("teapot", kind), &EXACT);
            job(EXACT, Options::new(&EXACT), &geometry).direct()
        };
        direct.map(|frame| frame.id)
    };
    let two_centres = pixels(Kind::TwoCentres);
    for kind in [Kind::Shear, Kind::Translate] {
        assert!(pixels(kind) == two_centres, "{}", kind.name());
    }
    for kind in [Kind::Asymptotic, Kind::Piecewise] {
        assert!(pixels(kind) != two_centres, "{}", kind.name());
    }
}

/// A pixel belongs to one of the polygons that share an edge, whatever their depths there.
const POINTS: Config = Config { antialias: false, ..EXACT };

/// Partitions that all show things where they are: cut, but projected as by two centres.
fn transparent(borders: &[f64]) -> Projection {
    let partition = |pair: &[f64]| Partition {
        near: pair[0],
        far: pair[1],
        min_distance: pair[0],
        max_distance: pair[1],
    };
    let partitions = borders.windows(2).map(partition).collect();
    Projection::Piecewise(Piecewise { partitions, ..Piecewise::default() })
}

#[test]
fn partitions_cut_polygons_without_a_seam() {
    for name in ["room", "ramp", "teapot"] {
        let mut scene = scene(name, Kind::TwoCentres);
        let (near, far, d) = (scene.rig.near(), scene.rig.far(), scene.rig.viewing_distance);
        let plain = geometry(&scene, &POINTS);
        scene.rig.projection =
            transparent(&[near, 0.9 * d, 0.97 * d, 1.02 * d, 1.1 * d, 1.5 * d, far]);
        let cut = geometry(&scene, &POINTS);
        assert!(cut.counts.clipped > plain.counts.clipped + 10, "{name}: {:?}", cut.counts);
        assert_eq!(cut.counts.triangles, plain.counts.triangles);
        let options = Options::new(&POINTS);
        let views = [&plain, &cut].map(|geometry| job(POINTS, options, geometry).direct());
        let [plain, cut] = views;
        let (mut differ, mut pixels, mut holes) = (0, 0, 0);
        for (plain, cut) in plain.iter().zip(&cut) {
            pixels += plain.id.len();
            differ += plain.id.iter().zip(&cut.id).filter(|(a, b)| a != b).count();
            let hole = |(a, b): &(&u32, &u32)| **a != NO_ID && **b == NO_ID;
            holes += plain.id.iter().zip(&cut.id).filter(hole).count();
        }
        println!("{name}: {differ} of {pixels} ids differ, {holes} holes");
        assert!(differ * 5000 < pixels, "{name}: {differ} ids differ");
        assert!(holes * 20_000 < pixels, "{name}: {holes} holes");
    }
}

#[test]
fn partitions_draw_their_own_ranges_at_common_depths() {
    let mut scene = scene("room", Kind::TwoCentres);
    let d = scene.rig.viewing_distance;
    let borders = [[0.5 * d, 1.0 * d], [1.01 * d, 1.3 * d]];
    let partitions = borders.map(|[near, far]| Partition {
        near,
        far,
        min_distance: 0.9 * d,
        max_distance: 1.1 * d,
    });
    let piecewise = Piecewise { partitions: partitions.to_vec(), ..Piecewise::default() };
    scene.rig.projection = Projection::Piecewise(piecewise);
    let drawn = geometry(&scene, &EXACT);
    let camera = Camera::new(&scene.rig, SIZE[0], SIZE[1], &Formats::new(&EXACT));
    // The scale of depth runs over all partitions.
    let depth = |distance: f64| camera.depth([0.0, 0.0, distance - d]);
    assert_eq!((depth(0.5 * d), depth(1.3 * d)), (0, DEPTH_MAX));
    let ranges = borders.map(|border| border.map(depth));
    for polygon in &drawn.polygons {
        let within = |[near, far]: [u32; 2]| {
            polygon.vertices.iter().all(|v| (near..=far).contains(&v.depth))
        };
        assert!(ranges.into_iter().any(within), "{polygon:?}");
    }
    let ids = ranges.map(|[near, far]| {
        let of = drawn.polygons.iter().filter(|p| (near..=far).contains(&p.vertices[0].depth));
        of.map(|p| p.id).collect::<std::collections::BTreeSet<u32>>()
    });
    assert!(ids.iter().all(|ids| !ids.is_empty()));
    // Some polygons go on in the next partition, under the same id.
    assert!(!ids[0].is_disjoint(&ids[1]));
}

#[test]
fn a_flat_partition_shows_both_eyes_the_same() {
    let mut scene = scene("teapot", Kind::TwoCentres);
    let d = scene.rig.viewing_distance;
    let flat = Partition { near: d / 2.0, far: 2.0 * d, min_distance: d, max_distance: d };
    // Nothing is in the other one.
    let other = Partition { near: d / 8.0, far: d / 2.0, min_distance: d / 2.0, max_distance: d };
    let piecewise = Piecewise { partitions: vec![other, flat], ..Piecewise::default() };
    scene.rig.projection = Projection::Piecewise(piecewise);
    let geometry = geometry(&scene, &EXACT);
    // Highlights included.
    let [left, right] = job(EXACT, Options::new(&EXACT), &geometry).direct();
    assert!(left == right);
    let (frames, _) = job(EXACT, Options::new(&EXACT), &geometry).derived(false);
    assert!(frames.eyes[0] == left && frames.eyes[1] == left);
}

/// A triangle at a distance, turned to a side with `lean`.
fn triangle(distance: f64, lean: f64, rig: Rig) -> Scene {
    let z = distance - rig.viewing_distance;
    let positions = vec![[-5.0, -4.0, z], [5.0, -4.0, z + lean], [0.0, 5.0, z]];
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let [width, height] = SIZE;
    let materials = vec![Material::default()];
    Scene { width, height, rig, meshes: vec![mesh], materials, ..Scene::default() }
}

#[test]
fn what_lies_on_a_border_is_drawn_once() {
    let part = |near: f64, far: f64, max_distance: f64| Partition {
        near,
        far,
        min_distance: 40.0,
        max_distance,
    };
    let partitions = vec![part(40.0, 60.0, 60.0), part(60.0, 70.0, 70.0), part(80.0, 90.0, 90.0)];
    let piecewise = Piecewise { partitions, ..Piecewise::default() };
    let rig = Rig { projection: Projection::Piecewise(piecewise), ..Rig::default() };
    // Flat at a border; a leaning one that only touches it; one that crosses it.
    for (distance, lean, pieces) in [
        (40.0, 0.0, 1),
        (60.0, 0.0, 1),
        (70.0, 0.0, 1),
        (75.0, 0.0, 0),
        (80.0, 0.0, 1),
        (90.0, 0.0, 1),
        (95.0, 0.0, 0),
        (60.0, 1.0, 1),
        (60.0, -1.0, 1),
        (59.5, 1.0, 2),
        (70.0, 1.0, 0),
        (69.5, 1.0, 1),
        (40.0, -1.0, 0),
    ] {
        let drawn = geometry(&triangle(distance, lean, rig.clone()), &EXACT);
        let what = format!("{distance} {lean}: {:?}", drawn.counts);
        let ids: std::collections::BTreeSet<u32> = drawn
            .polygons
            .iter()
            .map(|p| p.vertices.iter().map(|v| v.depth).max().unwrap_or(0))
            .collect();
        assert_eq!(ids.len(), pieces, "{what}");
        assert_eq!(drawn.counts.empty, 0, "{what}");
    }
    // The farther partition's: at 40, not at 60, where nothing would be moved.
    let flat = geometry(&triangle(60.0, 0.0, rig), &EXACT);
    let [left, right] = [0, 1].map(|eye| flat.polygons[0].vertices[0].x[eye]);
    assert!(left > right, "before the screen");
}

#[test]
fn a_tilted_head_sees_to_the_edges() {
    // Rows that the primary has above or below its window are in the secondary's.
    for (name, tilt) in [("village", 90.0)] {
        let mut scene = scene(name, Kind::TwoCentres);
        scene.rig.head_tilt = tilt;
        let geometry = geometry(&scene, &Config::FULL);
        let job = job(Config::FULL, Options::new(&Config::FULL), &geometry);
        let (frames, counts) = job.derived(false);
        assert!(counts.derived > 200, "{name}: {} derived", counts.derived);
        for (ours, direct) in frames.eyes.iter().zip(&job.direct()) {
            let edge = (SIZE[0] * 12) as usize;
            let pixels = ours.id.len();
            let differ = |range: std::ops::Range<usize>| {
                let pairs = ours.id[range.clone()].iter().zip(&direct.id[range]);
                pairs.filter(|(a, b)| a != b).count()
            };
            let found = differ(0..edge) + differ(pixels - edge..pixels);
            assert!(found < 2 * edge / 50, "{name} {tilt}: {found} of {} at the edges", 2 * edge);
        }
    }
}

#[test]
fn symmetric_clipping_leaves_a_strip_blank() {
    let with = |kind| geometry(&scene("room", kind), &EXACT);
    let (whole, cut) = (with(Kind::TwoCentres), with(Kind::Symmetric));
    assert_eq!(whole.polygons, cut.polygons);
    let rig = scene("room", Kind::Symmetric).rig;
    let blank = (rig.pixels_per_unit * rig.eye_separation).round() as usize;
    assert!(blank > 10);
    let arrangements = [
        Arrangement::Normal,
        Arrangement::Flipped,
        Arrangement::Interleaved,
        Arrangement::AboveBelow,
        Arrangement::Rotated,
    ];
    let external = Config { external_depth: true, ..EXACT };
    for config in [EXACT, external] {
        for arrangement in arrangements {
            let options = Options { arrangement, cost_rule: false, ..Options::new(&config) };
            let (whole, cut) = (job(config, options, &whole), job(config, options, &cut));
            let (minimal, hybrid) = (cut.derived(true).0, cut.derived(false).0);
            let all_minimal = whole.derived(true).0;
            let planner = whole.planner(false);
            let cleared = cut.frames(false);
            let (whole, cut) = (whole.direct(), cut.direct());
            for (eye, strip) in
                [(Eye::Left, SIZE[0] as usize - blank..SIZE[0] as usize), (Eye::Right, 0..blank)]
            {
                let e = eye as usize;
                let placement = Placement::new(&planner, eye);
                for n in 0..whole[e].id.len() {
                    let (x, y) = (n % SIZE[0] as usize, n / SIZE[0] as usize);
                    let id = if strip.contains(&x) { NO_ID } else { whole[e].id[n] };
                    assert_eq!(cut[e].id[n], id, "{eye:?} {x} {y}");
                    let [u, v] = placement.place(x as i64, y as i64);
                    let [column, line] = [u, v].map(|n| Coordinate::new(n, &planner.formats));
                    // A closed column answers as the picture is there.
                    let answer = cleared.fetch(eye, column, line);
                    let depth = i64::from(DEPTH_MAX);
                    assert_eq!(answer.depth.raw(), depth, "{arrangement:?} {eye:?} {x} {y}");
                    if strip.contains(&x) {
                        assert_eq!(answer.rgb, cut[e].colour[n], "{arrangement:?} {eye:?} {x} {y}");
                    }
                    let [first, end, top, bottom] = cleared.open(eye).map(i64::from);
                    let is_open = (first..end).contains(&u) && (top..bottom).contains(&v);
                    assert_eq!(is_open, !strip.contains(&x), "{arrangement:?} {eye:?} {x} {y}");
                    let at = hybrid.eyes[e].index(u, v).expect("on the display");
                    assert_eq!(hybrid.eyes[e].id[at], id, "{arrangement:?} {eye:?} {x} {y}");
                    assert_eq!(hybrid.eyes[e].depth[at], cut[e].depth[n]);
                    let expected = match strip.contains(&x) {
                        true => (NO_ID, DEPTH_MAX),
                        false => (all_minimal.eyes[e].id[at], all_minimal.eyes[e].depth[at]),
                    };
                    assert_eq!((minimal.eyes[e].id[at], minimal.eyes[e].depth[at]), expected);
                }
            }
        }
    }
}

#[test]
fn the_verilog_draws_every_projection() {
    let scenes: Vec<(Kind, Geometry)> = Kind::ALL
        .map(|kind| {
            let scene = open_projected("room", Some([96, 72]), None, Some(kind));
            (kind, geometry(&scene.expect("there is one"), &Config::DEFAULT))
        })
        .into();
    let settings = settings("default", &[]);
    let mut plan = plan(&[Target::Minimal, Target::Hybrid], settings, 1000);
    plan.scenes_only = true;
    plan.jobs = 2;
    plan.scenes = scenes
        .iter()
        .map(|(kind, geometry)| NamedScene {
            name: kind.name().into(),
            job: job(settings.config, settings.options, geometry),
        })
        .collect();
    let entries = run(&plan, &builder());
    assert_eq!(entries.len(), 2 * Kind::ALL.len());
    for entry in &entries {
        if let Some(failure) = &entry.failure {
            panic!("{} {}:\n{failure}", entry.target.name(), entry.name);
        }
        let scene = entry.scene.as_ref().expect("a scene");
        assert!(scene.written.iter().all(|&n| n > 500) && scene.pixels == 2 * 96 * 72);
        let blank = |eye: usize, x: usize| {
            (0..72).all(|y| scene.frames.eyes[eye].depth[y * 96 + x] == DEPTH_MAX)
        };
        let strips = [blank(0, 95), blank(1, 0), blank(0, 0), blank(1, 95)];
        let symmetric = entry.name == Kind::Symmetric.name();
        assert_eq!(strips, [symmetric, symmetric, false, false], "{}", entry.name);
    }
}

#[test]
fn every_projection_draws_every_scene_without_a_rig_file() {
    for builtin in &scene::builtin::SCENES {
        for kind in Kind::ALL {
            let scene = open_projected(builtin.name, Some([64, 48]), None, Some(kind));
            let scene = scene.unwrap_or_else(|error| panic!("{} {kind:?}: {error}", builtin.name));
            assert!(!geometry(&scene, &Config::DEFAULT).polygons.is_empty(), "{}", builtin.name);
        }
    }
}
