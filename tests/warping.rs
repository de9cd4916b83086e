//! Image warping: its order of scanning, its reprojection, and the count of its faults.

use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::scene::{builtin, Scene};
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
