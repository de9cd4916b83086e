//! Image warping: its order of scanning, its reprojection, and the count of its faults.

use wheatstone_golden::config::Config;
use wheatstone_golden::direct::Direct;
use wheatstone_golden::formats::{Eye, Formats, DEPTH_MAX};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::projection::Kind;
use wheatstone_golden::scene::{builtin, open_projected, Scene};
use wheatstone_golden::setup::{Attributes, Eyes, Outline, Polygon, Vertex};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::visibility::warping::{self, Disparity, Fault, Warped};
use wheatstone_golden::visibility::z_buffer::ZBuffer;
use wheatstone_golden::visibility::{Model, Pose, View};
use wheatstone_golden::work::{Unmetered, Work};
use wheatstone_studies::p_buffer::measure::by_depth;

fn scene(name: &str) -> Scene {
    builtin::scene(name, 300, 300).expect("a built-in scene")
}

fn full(scene: &Scene, model: &Model, view: View) -> Frame {
    let mut buffer = ZBuffer::new(view, scene.background);
    buffer.draw_all::<true>(model, &mut Unmetered);
    buffer.frame
}

fn views(scene: &Scene) -> [Frame; 2] {
    let model = Model::new(scene);
    Eye::BOTH.map(|eye| full(scene, &model, View::of(scene, eye)))
}

fn warp(scene: &Scene, source: &Frame, from: Eye) -> Warped {
    let disparity = Disparity::new(&scene.rig, from);
    warping::other_eye(source, from, &disparity, scene.background, &mut Unmetered)
}

/// Ids by overwriting in the wrong order.
fn overwritten_wrongly(scene: &Scene, source: &Frame, from: Eye) -> Vec<u32> {
    let disparity = Disparity::new(&scene.rig, from);
    let width = source.width as usize;
    let mut ids = vec![NO_ID; source.id.len()];
    for n in 0..source.id.len() {
        let x = if from == Eye::Right { n % width } else { width - 1 - n % width };
        let from = n - n % width + x;
        let x = x as i64 + disparity.rounded(source.depth[from]);
        if (0..width as i64).contains(&x) {
            ids[n - n % width + x as usize] = source.id[from];
        }
    }
    ids
}

#[test]
fn overwriting_in_the_right_order_leaves_the_nearest() {
    for name in ["office-1", "office-15", "perception-cylinder", "perception-solid"] {
        let scene = scene(name);
        let views = views(&scene);
        for from in Eye::BOTH {
            let source = &views[from as usize];
            let warped = warp(&scene, source, from);
            assert!(
                warped.frame.id == by_depth(source, &Disparity::new(&scene.rig, from)),
                "{name} from {from:?}"
            );
            assert!(warped.frame.id != overwritten_wrongly(&scene, source, from), "{name}");
            assert!(warped.sources.iter().any(|&n| n > 1), "{name}: overlaps");
        }
    }
}

#[test]
fn disparity_is_the_difference_of_the_projections() {
    let scene = scene("office-1");
    let [left, right] = Eye::BOTH.map(|eye| View::of(&scene, eye));
    let to_left = Disparity::new(&scene.rig, Eye::Right);
    let to_right = Disparity::new(&scene.rig, Eye::Left);
    for n in 0..500 {
        let p = [f64::from(n % 7) - 3.0, f64::from(n % 3) - 1.0, -3.0 + 0.4 * f64::from(n)];
        let [x_left, x_right] = [left, right].map(|view| {
            let [x, _, w] = view.homogeneous(p);
            x / w
        });
        let depth = left.depth(left.homogeneous(p)[2]);
        assert!((to_left.at(depth) - (x_left - x_right)).abs() < 1e-4, "{p:?}");
        assert!((to_right.at(depth) + to_left.at(depth)).abs() < 1e-12);
    }
    // Nothing moves at the screen; far things lie farther to the left for the left eye.
    let screen = left.depth(scene.rig.viewing_distance);
    assert!(to_left.at(screen).abs() < 1e-4 && to_left.at(screen + 100_000) < -0.01);
}

#[test]
fn reprojection_agrees_with_disparity() {
    let scene = scene("office-2");
    let [_, source] = views(&scene);
    let [left, right] = Eye::BOTH.map(|eye| View::of(&scene, eye));
    let by_shift = warp(&scene, &source, Eye::Right);
    let by_map = warping::moved(&source, &right, &left, scene.background, &mut Unmetered);
    let differ = (0..source.id.len()).filter(|&n| by_shift.frame.id[n] != by_map.frame.id[n]);
    // Disparities that are half a pixel but for rounding.
    let differ = differ.count();
    assert!(differ <= 20, "{differ} pixels");
}

#[test]
fn a_viewer_who_stays_sees_the_same() {
    let scene = scene("office-3");
    let model = Model::new(&scene);
    let view = View::between(&scene);
    let source = full(&scene, &model, view);
    let same = warping::moved(&source, &view, &view, scene.background, &mut Unmetered);
    assert!(same.frame.id == source.id && same.frame.colour == source.colour);
    assert!(same.sources.iter().all(|&n| n == 1));
    assert_eq!(same.faults(&source).wrong(), 0);
    // There and back: what is still there is where it was, to a pixel.
    let aside = view.at(&Pose { moved: [-0.2, 0.0, 0.0], turned: -3.0 }, &scene.rig);
    let there = warping::moved(&source, &view, &aside, scene.background, &mut Unmetered);
    let back = warping::moved(&there.frame, &aside, &view, scene.background, &mut Unmetered);
    let faults = back.faults(&source);
    assert!(faults.see_through * 50 < faults.pixels, "{faults:?}");
}

/// The place in the right view of a place in the left one, by the corners of a polygon as they were
/// projected and snapped for each eye: disparity is affine on a plane.
fn by_corners(corners: &[Vertex; 3], [x, y]: [f64; 2]) -> [f64; 2] {
    let place = |n: usize, eye: usize| {
        [f64::from(corners[n].x[eye]) / 256.0, f64::from(corners[n].y[eye]) / 256.0]
    };
    let [a, b, c] = [0, 1, 2].map(|n| place(n, 0));
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let from = |u: [f64; 2], v: [f64; 2]| [v[0] - u[0], v[1] - u[1]];
    let area = cross(from(a, b), from(a, c));
    let s = cross(from(a, [x, y]), from(a, c)) / area;
    let t = cross(from(a, b), from(a, [x, y])) / area;
    let [a, b, c] = [0, 1, 2].map(|n| place(n, 1));
    [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
}

/// Of each polygon with some area on its own: every pixel of it is moved to where the same point of
/// it is projected for the other eye. Returns how many pixels were looked at.
fn check_moves(name: &str, kind: Kind, tilt: f64) -> usize {
    const SIZE: [u32; 2] = [160, 120];
    let mut scene = open_projected(name, Some(SIZE), None, Some(kind)).expect("built in");
    scene.rig.head_tilt = tilt;
    let formats = Formats::new(&Config::DEFAULT);
    let options = wheatstone_golden::scene::Options::default();
    let geometry = scene.geometry(&formats, &options).expect("it is sound");
    let disparity = Disparity::new(&scene.rig, Eye::Left);
    let direct = Direct { formats, textures: &[], lookup: Lookup::Nearest };
    let mut pixels = 0;
    let areas = |p: &Polygon| Eye::BOTH.map(|eye| Outline::new(p, eye).doubled_area().abs());
    let large = |p: &&Polygon| areas(p).iter().all(|&n| n > 80 << 16) && p.eyes == Eyes::Both;
    for polygon in geometry.polygons.iter().filter(large).filter(|p| !p.guard_band) {
        let mut frame = Frame::new(SIZE[0], SIZE[1], [0; 3]);
        let opaque = Polygon { texture: None, ..polygon.clone() };
        direct.draw(&opaque, Eye::Left, &mut frame);
        let warped = warping::other_eye(&frame, Eye::Left, &disparity, [0; 3], &mut Unmetered);
        let corners = Attributes::corners(polygon, Eye::Left);
        let covered = (0..frame.id.len()).filter(|&n| frame.depth[n] != DEPTH_MAX);
        for n in covered {
            let [x, y] = [n % SIZE[0] as usize, n / SIZE[0] as usize].map(|n| n as f64 + 0.5);
            let depth = frame.depth[n];
            let [right, down] = disparity.both_at(depth);
            let expected = by_corners(&corners, [x, y]);
            // A subpixel is 1/256, depths are whole units.
            let unit = [0, 1].map(|k| {
                let near = disparity.both_at(depth.saturating_sub(2))[k];
                (near - disparity.both_at(depth)[k]).abs()
            });
            let what = || format!("{} of {name}, tilt {tilt}, pixel {x}, {y}", kind.name());
            for (k, found) in [x + right, y + down].into_iter().enumerate() {
                let off = (found - expected[k]).abs();
                assert!(off < 2.5 / 256.0 + unit[k], "{}: {found}, not {expected:?}", what());
            }
            pixels += 1;
            let near_a_border = |n: f64| (n - n.round()).abs() < 0.02;
            if expected.into_iter().any(near_a_border) {
                continue;
            }
            let [x, y] = expected.map(|n| n.floor() as i64);
            if let Some(at) = warped.frame.index(x, y) {
                assert!(
                    warped.sources[at] > 0 && warped.frame.depth[at] != DEPTH_MAX,
                    "{}",
                    what()
                );
            }
        }
    }
    pixels
}

#[test]
fn pixels_go_where_the_other_eye_sees_them_in_every_projection() {
    for kind in Kind::ALL {
        let tilts: &[f64] = if kind == Kind::Symmetric { &[0.0] } else { &[0.0, 25.0, -90.0] };
        for &tilt in tilts {
            let pixels: usize =
                ["office-1", "exclusive"].map(|name| check_moves(name, kind, tilt)).iter().sum();
            println!("{} at {tilt}: {pixels} pixels", kind.name());
            assert!(pixels > 10_000, "{} at {tilt}: only {pixels} pixels", kind.name());
        }
    }
}

#[test]
fn the_nearest_is_left_in_every_projection() {
    for (kind, tilt) in Kind::ALL.map(|kind| (kind, 0.0)).into_iter().chain([
        (Kind::TwoCentres, 180.0),
        (Kind::TwoCentres, 30.0),
        (Kind::Piecewise, -60.0),
    ]) {
        let mut scene =
            open_projected("office-2", Some([200, 150]), None, Some(kind)).expect("it is");
        scene.rig.head_tilt = tilt;
        let formats = Formats::new(&Config::DEFAULT);
        let geometry = scene.geometry(&formats, &Default::default()).expect("it is sound");
        let options = wheatstone_golden::setup::Options::new(&Config::DEFAULT);
        let job = Job::of(&geometry, Config::DEFAULT, options, Lookup::Nearest);
        for (from, source) in Eye::BOTH.into_iter().zip(job.direct()) {
            let disparity = Disparity::new(&scene.rig, from);
            let ordered = tilt == 0.0 && kind != Kind::Piecewise;
            assert_eq!(disparity.is_ordered(), ordered, "{} at {tilt}", kind.name());
            let warped = warping::other_eye(&source, from, &disparity, [0; 3], &mut Unmetered);
            let mut nearest = vec![DEPTH_MAX; source.id.len()];
            for (n, &depth) in source.depth.iter().enumerate() {
                let [right, down] = disparity.both_rounded(depth);
                let [x, y] = [n as i64 % 200 + right, n as i64 / 200 + down];
                if let Some(at) = source.index(x, y) {
                    nearest[at] = nearest[at].min(depth);
                }
            }
            assert!(warped.frame.depth == nearest, "{} at {tilt} from {from:?}", kind.name());
        }
    }
}

/// A frame of one row: depths in units of a sixteenth of the range, ids as given.
fn row(ids: &[u32], depths: &[u32]) -> Frame {
    let mut frame = Frame::new(ids.len() as u32, 1, [9; 3]);
    frame.id = ids.to_vec();
    frame.depth = depths.iter().map(|d| d << 20).collect();
    frame
}

#[test]
fn faults_are_told_apart() {
    // A rig in which a depth of n/16 moves by 4 - n pixels to the right for the left eye.
    let rig = wheatstone_golden::scene::Rig {
        near: Some(1.0),
        far: Some(1e9),
        viewing_distance: 4.0 / 3.0,
        eye_separation: 12.0,
        pixels_per_unit: 1.0,
        ..Default::default()
    };
    let disparity = Disparity::new(&rig, Eye::Right);
    for n in 0..16 {
        assert!((disparity.at(n << 20) - (4.0 - f64::from(n))).abs() < 1e-5, "{n}");
    }
    // Polygon 7 is at the screen but for a near polygon 5 that is two pixels wide: moved by two, it
    // covers two pixels of 7 and leaves two holes.
    let source = row(&[7, 7, 5, 5, 7, 7, 7, 7], &[4, 4, 2, 2, 4, 4, 4, 4]);
    let warped = warping::other_eye(&source, Eye::Right, &disparity, [9; 3], &mut Unmetered);
    assert_eq!(warped.frame.id, [7, 7, NO_ID, NO_ID, 5, 5, 7, 7]);
    assert_eq!(warped.sources, [1, 1, 0, 0, 2, 2, 1, 1]);
    // The truth: polygon 5 a pixel wider, and a polygon 3 in front of the far right that cannot be known.
    let truth = row(&[7, 7, 7, 5, 5, 5, 3, 3], &[4, 4, 4, 2, 2, 2, 1, 1]);
    let faults = warped.faults(&truth);
    assert_eq!([faults.overlaps, faults.holes, faults.edges, faults.see_through], [2, 2, 0, 2]);
    assert_eq!(warped.fault(&truth, 7), Some(Fault::SeeThrough));
    let shifted = row(&[7, 7, 7, 7, 7, 5, 5, 7], &[4, 4, 4, 4, 4, 2, 2, 4]);
    assert_eq!(warped.fault(&shifted, 4), Some(Fault::Edge));
    assert_eq!(warped.faults(&shifted).wrong(), 4);
}

#[test]
fn work_is_a_constant_for_each_pixel() {
    let pixels = 90_000;
    for name in ["office-1", "office-15"] {
        let scene = scene(name);
        let [_, source] = views(&scene);
        let disparity = Disparity::new(&scene.rig, Eye::Right);
        let mut work = Work::default();
        warping::other_eye(&source, Eye::Right, &disparity, scene.background, &mut work);
        assert_eq!((work.pixels_tested, work.depth_tests, work.polygons), (pixels, 0, 0));
        assert!(work.pixels_written <= pixels && work.pixels_written > pixels * 9 / 10);
    }
}
