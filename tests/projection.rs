//! Projections: against each other, against matrices and against triangulation.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::projection::{
    multiply, transform, Asymptotic, Clipping, DistanceMap, Kind, Partition, Piecewise, Projection,
    ProjectionMatrix, Screen, Viewer,
};
use wheatstone_golden::scene::vector::{turn, Vec3};
use wheatstone_golden::scene::{Camera, Rig};

const FORMATS: Formats = Formats::new(&Config::DEFAULT);

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
        let viewer = rig.viewer();
        let size = [640.0, 480.0].map(|n| n / rig.pixels_per_unit);
        for range in rig.ranges() {
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

/// Perceived distance: that at which the viewer's lines of sight through the two pixels meet.
fn triangulated(rig: &Rig, camera: &Camera, p: Vec3) -> f64 {
    let viewer = rig.viewer();
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
        for range in rig.ranges() {
            for _ in 0..2000 {
                let p = point(&mut random, &rig, [range.near, range.far]);
                let perceived = range.map.perceived(p[2] + rig.viewing_distance);
                let met = triangulated(&rig, &camera, p);
                assert!((1.0 / met - 1.0 / perceived).abs() < 1e-11, "{met} {perceived}");
                let disparity = rig.viewer().disparity(perceived);
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
        for range in rig.ranges() {
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
            let screen_distance = rig.viewer().screen_distance;
            for (lens, range) in camera.lenses().iter().zip(rig.ranges()) {
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
fn what_is_at_the_screen_stays() {
    for rig in [rig(Kind::Asymptotic.into()), rig(Kind::Piecewise.into())] {
        let p = [3.0, -2.0, 0.0];
        for eye in Eye::BOTH {
            let [a, b] = [camera(&rig), camera(&Rig::default())].map(|c| c.pixel(p, eye));
            assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
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
