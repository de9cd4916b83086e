//! Projections: against each other, against matrices and triangulation, and drawn by every path.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats, DEPTH_MAX};
use wheatstone_golden::frame::NO_ID;
use wheatstone_golden::projection::{
    multiply, transform, Asymptotic, Clipping, Device, DistanceMap, Kind, Partition, Piecewise,
    Projection, ProjectionMatrix, Screen, Viewer,
};
use wheatstone_golden::scene::vector::{turn, Vec3};
use wheatstone_golden::scene::{self, open, open_projected, Camera, Geometry, Rig, Scene};
use wheatstone_golden::setup::{Arrangement, Options, Placement};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;
use wheatstone_golden::texture::Lookup;
use wheatstone_testbench::regression::NamedScene;
use wheatstone_tests::{builder, folder, plan, run, settings};

const FORMATS: Formats = Formats::new(&Config::DEFAULT);
/// Everything built in that makes the hybrid exact with an upright head.
const EXACT: Config = Config { tilt: false, ..Config::FULL };
const SIZE: [u32; 2] = [240, 180];

fn camera(rig: &Rig) -> Camera {
    rig.check().unwrap_or_else(|error| panic!("{error}: {rig:?}"));
    Camera::new(rig, 640, 480, &FORMATS)
}

fn rig(projection: Projection) -> Rig {
    Rig { projection, ..Rig::default() }
}

/// Asymptotic and piecewise parameters of all sorts, with the screen in another unit than the scene.
fn mapped_rigs() -> Vec<Rig> {
    let asymptotic = |si: f64, sd: f64, max: f64, ipd: f64| Asymptotic {
        screen_intercept: Some(si),
        screen_distance: Some(sd),
        max_distance: Some(max),
        min_distance: None,
        eye_distance: Some(ipd),
    };
    let part = |[near, far]: [f64; 2], [min_distance, max_distance]: [f64; 2]| Partition {
        near,
        far,
        min_distance,
        max_distance,
    };
    let feet = Piecewise {
        screen_distance: Some(19.0),
        eye_distance: Some(2.5),
        partitions: vec![
            part([20.0, 50.0], [14.0, 19.0]),
            part([50.0, 60.0], [19.0, 19.0]),
            part([70.0, 300.0], [19.0, f64::INFINITY]),
        ],
    };
    vec![
        rig(Kind::Asymptotic.into()),
        rig(Projection::Asymptotic(asymptotic(150.0, 19.0, 40.0, 2.5))),
        rig(Projection::Asymptotic(asymptotic(70.0, 60.0, f64::INFINITY, 6.5))),
        rig(Kind::Piecewise.into()),
        rig(Projection::Piecewise(feet)),
    ]
}

/// A point in the middle of a range of distances, somewhere before the screen.
fn point(random: &mut Rng, rig: &Rig, [near, far]: [f64; 2]) -> Vec3 {
    let w = near + (far.min(20.0 * near) - near) * random.f64();
    let mut across = || (random.f64() - 0.5) * 0.8 * w;
    [across(), across(), w - rig.viewing_distance]
}

#[test]
fn two_centres_are_computed_in_the_documented_order() {
    // Bit for bit: every picture depends on it.
    let mut random = Rng::with_seed(1);
    for _ in 0..20_000 {
        let rig = Rig {
            pixels_per_unit: 1.0 + 30.0 * random.f64(),
            eye_separation: 10.0 * random.f64(),
            viewing_distance: 20.0 + 100.0 * random.f64(),
            head_tilt: if random.bool() { 0.0 } else { 90.0 * random.f64() },
            ..Rig::default()
        };
        let p = point(&mut random, &rig, [rig.near(), rig.far()]);
        let direction = turn(rig.head_tilt / 360.0);
        let camera = camera(&rig);
        for (eye, side) in [(Eye::Left, 1.0), (Eye::Right, -1.0)] {
            let [ex, ey] = direction
                .map(|n| side * (p[2] * (rig.eye_separation * n) / (2.0 * rig.viewing_distance)));
            let w = 1.0 + p[2] / rig.viewing_distance;
            let ppu = rig.pixels_per_unit;
            let expected = [320.0 + ppu * (p[0] - ex) / w, 240.0 - ppu * (p[1] - ey) / w];
            assert_eq!(camera.pixel(p, eye), expected);
        }
    }
}

#[test]
fn shear_and_translation_are_two_centres() {
    let same = Asymptotic {
        max_distance: Some(f64::INFINITY),
        screen_intercept: Some(60.0),
        ..Asymptotic::default()
    };
    let others = [Projection::Shear, Projection::Translate, Projection::Asymptotic(same)];
    for tilt in [0.0, 12.0] {
        let with = |projection| camera(&Rig { head_tilt: tilt, ..rig(projection) });
        let reference = with(Projection::TwoCentres);
        for other in &others {
            let camera = with(other.clone());
            let mut random = Rng::with_seed(2);
            let (mut differ, mut farthest) = (0, 0f64);
            for _ in 0..100_000 {
                let p = point(&mut random, &Rig::default(), [10.0, 6000.0]);
                let (a, b) = (reference.snap(p), camera.snap(p));
                let pairs = a.x.iter().chain(&a.y).zip(b.x.iter().chain(&b.y));
                for (a, b) in pairs {
                    assert!(a.abs_diff(*b) <= 1, "{:?}: {p:?}", other.kind());
                    differ += usize::from(a != b);
                }
                for eye in Eye::BOTH {
                    let (a, b) = (reference.pixel(p, eye), camera.pixel(p, eye));
                    farthest = farthest.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs());
                }
            }
            let name = other.kind().name();
            println!(
                "{name}, tilt {tilt}: {differ} of 400000 differ, by up to {farthest:e} pixels"
            );
            assert!(farthest < 1e-11, "{name}: {farthest:e}");
        }
    }
}

#[test]
fn matrices_project_as_points_and_cameras_do() {
    for rig in mapped_rigs() {
        let camera = camera(&rig);
        let viewer = rig.projection.viewer(&rig);
        let size = [640.0, 480.0].map(|n| n / rig.pixels_per_unit);
        for range in rig.projection.ranges(&rig) {
            let projection = ProjectionMatrix {
                viewer,
                map: range.map,
                near: range.near,
                far: range.far,
                width: size[0],
                height: size[1],
            };
            let mut random = Rng::with_seed(3);
            for eye in Eye::BOTH {
                let matrix = projection.matrix(eye);
                let [first, rest @ ..] = projection.steps(eye);
                let product = rest.iter().fold(first, |matrix, step| multiply(&matrix, step));
                for (a, b) in matrix.iter().flatten().zip(product.iter().flatten()) {
                    assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{matrix:?} {product:?}");
                }
                for (distance, z) in [(range.near, -1.0), (range.far, 1.0)] {
                    let seen = transform([0.0, 0.0, -distance], &matrix);
                    assert!((seen[2] - z).abs() < 1e-9, "{seen:?}");
                }
                for _ in 0..2000 {
                    let p = point(&mut random, &rig, [range.near, range.far]);
                    let distance = p[2] + rig.viewing_distance;
                    let seen = transform([p[0], p[1], -distance], &matrix);
                    let direct = projection.point([p[0], p[1], distance], eye);
                    let pixel = camera.pixel(p, eye);
                    let expected =
                        [(pixel[0] - 320.0) / 320.0, (240.0 - pixel[1]) / 240.0, direct[2]];
                    for k in 0..3 {
                        assert!((seen[k] - expected[k]).abs() < 1e-9, "{seen:?} {expected:?}");
                        assert!((seen[k] - direct[k]).abs() < 1e-9, "{seen:?} {direct:?}");
                    }
                }
            }
        }
    }
}

/// Where the viewer's lines of sight through the two pixels meet: the perceived distance.
fn triangulated(rig: &Rig, camera: &Camera, p: Vec3) -> f64 {
    let viewer = rig.projection.viewer(rig);
    let [left, right] =
        Eye::BOTH.map(|eye| (camera.pixel(p, eye)[0] - 320.0) / rig.pixels_per_unit);
    let a = viewer.eye_distance / 2.0;
    // From (∓a, 0) through (x, SD): the lines' distance is 2a - t (2a - (right - left)).
    viewer.screen_distance * 2.0 * a / (2.0 * a - (right - left))
}

#[test]
fn what_is_seen_lies_where_the_map_says() {
    for rig in mapped_rigs() {
        let camera = camera(&rig);
        let mut random = Rng::with_seed(4);
        for range in rig.projection.ranges(&rig) {
            for _ in 0..2000 {
                let p = point(&mut random, &rig, [range.near, range.far]);
                let perceived = range.map.perceived(p[2] + rig.viewing_distance);
                let met = triangulated(&rig, &camera, p);
                assert!((1.0 / met - 1.0 / perceived).abs() < 1e-11, "{met} {perceived}");
                let disparity = rig.projection.viewer(&rig).disparity(perceived);
                let [left, right] = Eye::BOTH.map(|eye| camera.pixel(p, eye)[0]);
                assert!((right - left - rig.pixels_per_unit * disparity).abs() < 1e-8);
                if range.map.slope > 0.0 {
                    let scene = range.map.scene(perceived);
                    assert!((scene / (p[2] + rig.viewing_distance) - 1.0).abs() < 1e-9);
                }
            }
        }
    }
}

#[test]
fn maps_meet_their_limits() {
    let close = |a: f64, b: f64| assert!(a == b || (a / b - 1.0).abs() < 1e-12, "{a} {b}");
    let (si, sd, max, min) = (150.0 * 12.0, 19.0, 45.0, 12.0);
    let map = DistanceMap::asymptotic(si, sd, max);
    close(map.perceived(f64::INFINITY), max);
    close(map.perceived(si), sd);
    // The publication's near clipping plane and distance map.
    let near = (si * min * max - si * sd * min) / (sd * max - sd * min);
    close(map.scene(min), near);
    close(map.perceived(near), min);
    for d in [100.0, 1000.0, 5000.0] {
        close(map.perceived(d), d * sd * max / (d * sd + si * max - si * sd));
        // With SI = SD the last term is subtracted, not added as printed.
        close(DistanceMap::asymptotic(sd, sd, max).perceived(d), d * max / (d + max - sd));
        close(DistanceMap::asymptotic(sd, sd, f64::INFINITY).perceived(d), d);
    }
    let viewer = Viewer { eye_distance: 2.5, screen_distance: sd };
    close(viewer.viewport_offset(&map), -1.25 * (1.0 - sd / max));
    close(viewer.projection_offset(&map), 1.25 * (1.0 - sd / max) * si / sd);
    close(viewer.disparity(max), -2.0 * viewer.viewport_offset(&map));

    let (near, far, min, max) = (200.0, 900.0, 14.0, 30.0);
    let map = DistanceMap::piecewise(near, far, min, max);
    close(map.perceived(near), min);
    close(map.perceived(far), max);
    let denominator = max * min * (far - near);
    close(viewer.projection_offset(&map), 1.25 * far * near * (max - min) / denominator);
    let numerator = denominator + sd * (near * max - far * min);
    close(viewer.viewport_offset(&map), -1.25 * numerator / denominator);
    // Linear in d itself only where far·min = near·max.
    let bend = |map: DistanceMap, [near, far]: [f64; 2]| {
        let d = map.perceived((near + far) / 2.0);
        d - (map.perceived(near) + map.perceived(far)) / 2.0
    };
    assert!(bend(map, [near, far]).abs() > 1.0);
    assert!(bend(DistanceMap::piecewise(200.0, 900.0, 4.0, 18.0), [200.0, 900.0]).abs() < 1e-12);
    let flat = DistanceMap::piecewise(200.0, 900.0, 19.0, 19.0);
    assert_eq!((flat.slope, flat.perceived(500.0)), (0.0, 19.0));
}

#[test]
fn disparity_on_a_plane_is_affine_in_screen_coordinates() {
    let mut random = Rng::with_seed(5);
    for rig in mapped_rigs().into_iter().chain(Kind::ALL.map(|kind| rig(kind.into()))) {
        let camera = camera(&rig);
        for range in rig.projection.ranges(&rig) {
            for _ in 0..300 {
                let corners = [0; 3].map(|_| point(&mut random, &rig, [range.near, range.far]));
                let (s, t) = (random.f64(), random.f64());
                let weights = [1.0 - s, s * (1.0 - t), s * t];
                let inner: Vec3 = core::array::from_fn(|axis| {
                    (0..3).map(|k| weights[k] * corners[k][axis]).sum()
                });
                let seen = |p: Vec3| {
                    let [left, right] = Eye::BOTH.map(|eye| camera.pixel(p, eye));
                    [left[0], left[1], right[0] - left[0]]
                };
                let [a, b, c] = corners.map(seen);
                let p = seen(inner);
                // Barycentric coordinates on the screen.
                let cross = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
                    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
                };
                let area = cross(a, b, c);
                if area.abs() < 1.0 {
                    continue;
                }
                let affine =
                    (cross(p, b, c) * a[2] + cross(a, p, c) * b[2] + cross(a, b, p) * c[2]) / area;
                assert!((p[2] - affine).abs() < 1e-6 * (1.0 + p[2].abs()), "{} {affine}", p[2]);
            }
        }
    }
}

#[test]
fn window_planes_are_where_the_guard_band_ends() {
    let mut random = Rng::with_seed(7);
    for mut rig in mapped_rigs().into_iter().chain(Kind::ALL.map(|kind| rig(kind.into()))) {
        for tilt in [0.0, 25.0] {
            if rig.projection != Projection::Symmetric {
                rig.head_tilt = tilt;
            }
            let camera = camera(&rig);
            let guard = f64::from(FORMATS.guard_band);
            let screen_distance = rig.projection.viewer(&rig).screen_distance;
            for (lens, range) in camera.lenses().iter().zip(rig.projection.ranges(&rig)) {
                for _ in 0..500 {
                    let p = point(&mut random, &rig, [range.near, range.far]);
                    let w = p[2] + rig.viewing_distance;
                    for eye in Eye::BOTH {
                        let [x, y] = lens.pixel(p, eye);
                        let inside = [x, 640.0 - x, y, 480.0 - y].map(|n| n + guard);
                        for (plane, inside) in lens.window_planes(eye).iter().zip(inside) {
                            let distance = plane.at(p) * screen_distance / w;
                            assert!(
                                (distance - inside).abs() < 1e-7,
                                "{distance} {inside} {rig:?}"
                            );
                        }
                    }
                    let ends = lens.depth_planes().map(|plane| plane.at(p));
                    assert!((ends[0] - (w - range.near)).abs() < 1e-7);
                    assert!((ends[1] - (range.far - w)).abs() < 1e-7);
                }
            }
        }
    }
}

#[test]
fn fields_of_view_are_those_of_table_1() {
    let width = 2.0 * 19.0 * 20f64.to_radians().tan();
    let screen = Screen { width, distance: 19.0, eye_distance: 2.5 };
    for (clipping, rows) in [
        (
            Clipping::Symmetric,
            [[30.8, 0.0, 30.8, 61.6], [6.92, 26.17, 6.92, 40.0], [0.0, 33.2, 0.0, 33.2]],
        ),
        (
            Clipping::Asymmetric,
            [[36.05, 0.0, 36.05, 72.1], [0.0, 40.0, 0.0, 40.0], [6.65, 33.2, 6.65, 46.5]],
        ),
    ] {
        let distances = [screen.nearest(clipping), 19.0, f64::INFINITY];
        for (distance, row) in distances.into_iter().zip(rows) {
            let seen = screen.field_of_view(clipping, distance);
            let cells = [seen.left, seen.stereo, seen.right, seen.total()];
            for (cell, printed) in cells.into_iter().zip(row) {
                assert!((cell - printed).abs() < 0.06, "{clipping:?} {distance}: {cells:?}");
            }
        }
        // Nearer than the nearest the fields part.
        assert!(screen.field_of_view(clipping, 0.9 * distances[0]).stereo < 0.0);
        assert!(screen.field_of_view(clipping, 1.1 * distances[0]).stereo > 0.0);
    }
}

#[test]
fn the_display_makes_dots_of_inches() {
    let device = Device::LEX_90;
    assert_eq!(device.dots(device.eye_distance).round(), 119.0);
    assert_eq!(device.dots(device.viewing_distance).round(), 857.0);
    let folder = folder();
    let file = folder.path().join("rig.json");
    let text = r#"{"projection": "translate", "pixels_per_unit": 4,
        "translate": {"eye_distance": 2.5, "viewing_distance": 18, "dot_pitch": 0.021}}"#;
    std::fs::write(&file, text).expect("written");
    let scene = open("teapot", Some(SIZE), Some(&file)).expect("well-formed");
    assert!((scene.rig.eye_separation - 2.5 / 0.021 / 4.0).abs() < 1e-12);
    assert!((scene.rig.viewing_distance - 18.0 / 0.021 / 4.0).abs() < 1e-12);
    assert_eq!(scene.rig.projection, Projection::Translate);
    // Another projection has no use for them.
    let scene =
        open_projected("teapot", Some(SIZE), Some(&file), Some(Kind::Shear)).expect("it is");
    assert_eq!((scene.rig.eye_separation, scene.rig.projection), (6.5, Projection::Shear));
}

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
fn perceived_depth_changes_but_what_is_at_the_screen_stays() {
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
    for rig in [rig(Kind::Asymptotic.into()), rig(Kind::Piecewise.into())] {
        let p = [3.0, -2.0, 0.0];
        for eye in Eye::BOTH {
            let [a, b] = [camera(&rig), camera(&Rig::default())].map(|c| c.pixel(p, eye));
            assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
        }
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
    let camera = Camera::new(&scene.rig, SIZE[0], SIZE[1], &FORMATS);
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
    let piecewise = Piecewise { partitions: vec![flat], ..Piecewise::default() };
    scene.rig.projection = Projection::Piecewise(piecewise);
    let geometry = geometry(&scene, &EXACT);
    // Highlights included.
    let [left, right] = job(EXACT, Options::new(&EXACT), &geometry).direct();
    assert!(left == right);
    let (frames, _) = job(EXACT, Options::new(&EXACT), &geometry).derived(false);
    assert!(frames.eyes[0] == left && frames.eyes[1] == left);
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
fn a_tilted_head_turns_every_displacement() {
    for kind in [Kind::Shear, Kind::Translate, Kind::Asymptotic, Kind::Piecewise] {
        for tilt in [30.0, 90.0, -90.0] {
            let [upright, tilted] =
                [0.0, tilt].map(|head_tilt| camera(&Rig { head_tilt, ..rig(kind.into()) }));
            let mut random = Rng::with_seed(6);
            for _ in 0..1000 {
                let p = point(&mut random, &Rig::default(), [31.0, 110.0]);
                let across = |camera: &Camera| {
                    let [left, right] = Eye::BOTH.map(|eye| camera.pixel(p, eye));
                    [right[0] - left[0], right[1] - left[1]]
                };
                let (disparity, [x, y]) = (across(&upright)[0], across(&tilted));
                // Rows go downward.
                let [cosine, sine] = turn(tilt / 360.0).map(|n| n * disparity);
                assert!((x - cosine).abs() < 1e-9 && (y + sine).abs() < 1e-9, "{x} {y}");
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
    let mut plan = plan(&[Target::Minimal, Target::Hybrid], settings.clone(), 1000);
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

/// Wrong rig files, the words that the error must contain.
const WRONG: &[(&str, &[&str])] = &[
    ("{\n\"projection\": \"fisheye\"}", &["rig.json:2: projection: expected one of", "`two-centres`", "fisheye"]),
    ("{\"projection\": \"symmetric\",\n\"eye_separation\": 0}", &["rig.json:2: eye_separation: expected more than 0 with projection symmetric, found 0"]),
    ("{\"projection\": \"asymptotic\",\n\"eye_separation\": 0}", &["rig.json:2: eye_separation: expected more than 0 with projection asymptotic, found 0"]),
    ("{\"projection\": \"piecewise\",\n\"eye_separation\": 0}", &["rig.json:2: eye_separation: expected more than 0 with projection piecewise, found 0"]),
    ("{\"projection\": \"symmetric\",\n\"head_tilt\": 5}", &["rig.json:2: head_tilt: expected 0 with projection symmetric", "found 5"]),
    ("{\"projection\": \"symmetric\",\n\"eye_separation\": 32}", &["rig.json:2: eye_separation: expected less than the width of the screen, 32, found 32"]),
    ("{\n\"viewing_distance\": -60}", &["rig.json:2: viewing_distance: expected a number from 1e-9", "found -60"]),
    ("{\n\"viewing_distance\": 1e999}", &["rig.json:2", "number out of range"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"screen_distance\": -19}}", &["rig.json:2: asymptotic.screen_distance: expected a number from", "found -19"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\"screen_distance\": 19,\n\"max_distance\": 19}}", &["rig.json:2: asymptotic.max_distance: expected more than the screen's distance, 19, found 19"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"screen_intercept\": 0}}", &["rig.json:2: asymptotic.screen_intercept", "found 0"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"min_distance\": 120}}", &["rig.json:2: asymptotic.min_distance: expected less than max_distance, 120, found 120"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"eye_distance\": 0}}", &["rig.json:2: asymptotic.eye_distance", "found 0"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"intercept\": 1}}", &["rig.json:2: asymptotic", "unknown field `intercept`"]),
    ("{\"projection\": \"translate\", \"translate\": {\"eye_distance\": 2.5, \"viewing_distance\": 18,\n\"dot_pitch\": 0}}", &["rig.json:2: translate.dot_pitch", "found 0"]),
    ("{\"projection\": \"translate\", \"translate\": {\n\"eye_distance\": 0, \"viewing_distance\": 18, \"dot_pitch\": 1}}", &["rig.json:2: translate.eye_distance", "found 0"]),
    ("{\"projection\": \"translate\", \"translate\": {\"eye_distance\": 2.5,\n\"dot_pitch\": 1}}", &["rig.json:2: translate.viewing_distance: expected a value, found nothing"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [\n{\"near\": 50, \"far\": 60, \"min_distance\": 55, \"max_distance\": 60},\n{\"near\": 59, \"far\": 70, \"min_distance\": 60, \"max_distance\": 65}]}}", &["rig.json:3: piecewise.partitions[1].near: expected at least 60, where partition 0 ends", "found 59"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [{\"near\": 70,\n\"far\": 70, \"min_distance\": 55, \"max_distance\": 60}]}}", &["rig.json:2: piecewise.partitions[0].far: expected more than near, which is 70, found 70"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [{\"near\": 50, \"far\": 60, \"min_distance\": 55,\n\"max_distance\": 54}]}}", &["rig.json:2: piecewise.partitions[0].max_distance: expected at least min_distance, which is 55, found 54"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [{\"near\": 50, \"far\": 60,\n\"max_distance\": 54}]}}", &["rig.json:2: piecewise.partitions[0].min_distance: expected a value, found nothing"]),
    ("{\"projection\": \"piecewise\", \"far\": 25, \"near\": 20}", &["rig.json:1: near: expected a partition between near and far, 25, found 20"]),
];

#[test]
fn senseless_rigs_give_one_clear_error() {
    let folder = folder();
    for (text, words) in WRONG {
        let file = folder.path().join("rig.json");
        std::fs::write(&file, text).expect("written");
        let error = open("teapot", None, Some(&file)).err().unwrap_or_else(|| panic!("{text}"));
        let error = error.to_string();
        for word in *words {
            assert!(error.contains(word), "{text}: “{error}” does not say “{word}”");
        }
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    // Without a rig file it is the scene that does not fit.
    let flat = folder.path().join("flat.json");
    let scene = r#"{"format": "stereo-scene/1", "width": 8, "height": 8, "pixels_per_unit": 1,
        "eye_separation": 0, "viewing_distance": 9, "background": [0, 0, 0], "vertices": [],
        "colors": [], "triangles": []}"#;
    std::fs::write(&flat, scene).expect("written");
    let name = flat.to_string_lossy();
    open(&name, None, None).expect("legal");
    let error = open_projected(&name, None, None, Some(Kind::Symmetric)).expect_err("no strip");
    let expected =
        "flat.json: eye_separation: expected more than 0 with projection symmetric, found 0";
    assert!(error.to_string().ends_with(expected), "{error}");
    // In code, what is not finite.
    let nan = Asymptotic { max_distance: Some(f64::NAN), ..Asymptotic::default() };
    assert!(rig(Projection::Asymptotic(nan)).check().is_err());
    let infinite = Asymptotic { screen_intercept: Some(f64::INFINITY), ..Asymptotic::default() };
    assert!(rig(Projection::Asymptotic(infinite)).check().is_err());
    assert!(Rig { head_tilt: f64::NAN, ..Rig::default() }.check().is_err());
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
