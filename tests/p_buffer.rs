//! The full pipeline with a z-buffer against direct rendering; the P-buffer against both.

use std::collections::BTreeSet;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::scene::{self, builtin, Scene};
use wheatstone_golden::setup::{Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::visibility::p_buffer::{self, Visible};
use wheatstone_golden::visibility::z_buffer::ZBuffer;
use wheatstone_golden::visibility::{Model, Pose, View};
use wheatstone_golden::work::{Unmetered, Work};

/// Depths that count as equal, in units of the 24-bit depth: the two halves of a quadrilateral have a
/// plane each in direct rendering, and one in the pipeline.
const TIE: u32 = 2;

fn scene(name: &str, size: [u32; 2]) -> Scene {
    builtin::scene(name, size[0], size[1]).expect("a built-in scene")
}

fn with_job<T>(scene: &Scene, run: impl FnOnce(&Job) -> T) -> T {
    let config = Config::DEFAULT;
    let geometry = scene.geometry(&Formats::new(&config), &scene::Options::default());
    let geometry = geometry.expect("the scene is sound");
    run(&Job::of(&geometry, config, Options::new(&config), Lookup::Nearest))
}

/// A view by the full pipeline, with ids.
fn full(model: &Model, view: View, background: [u8; 3]) -> Frame {
    let mut buffer = ZBuffer::new(view, background);
    buffer.draw_all::<true>(model, &mut Unmetered);
    buffer.frame
}

const SCENES: [&str; 4] = ["office-1", "office-4", "perception-cylinder", "perception-solid"];

#[test]
fn the_full_pipeline_draws_what_direct_rendering_draws() {
    for (name, size) in SCENES.into_iter().zip([[300, 300], [640, 480], [640, 480], [333, 201]]) {
        let scene = scene(name, size);
        let model = Model::new(&scene);
        let direct = with_job(&scene, |job| job.direct());
        for eye in Eye::BOTH {
            let ours = full(&model, View::of(&scene, eye), scene.background);
            let theirs = &direct[eye as usize];
            let mut ties = 0;
            for (n, (a, b)) in ours.id.iter().zip(&theirs.id).enumerate() {
                let apart = ours.depth[n].abs_diff(theirs.depth[n]);
                assert!(apart <= TIE, "{name}, {eye:?}, pixel {n}: depths {apart} apart");
                ties += usize::from(a != b);
                assert!(a != b || ours.colour[n] == theirs.colour[n], "{name}, pixel {n}");
                assert_eq!(*a == NO_ID, *b == NO_ID, "{name}, pixel {n}: coverage");
            }
            println!("{name}, {eye:?}: {ties} ties of {}", ours.id.len());
            assert!(ties * 1000 <= ours.id.len(), "{name}: {ties} ties");
        }
    }
}

#[test]
fn the_first_view_is_that_of_the_z_buffer_bit_for_bit() {
    for name in SCENES {
        let scene = scene(name, [300, 300]);
        let model = Model::new(&scene);
        for eye in Eye::BOTH {
            let view = View::of(&scene, eye);
            let mut plain = ZBuffer::new(view, scene.background);
            plain.draw_all::<false>(&model, &mut Unmetered);
            let mut first = ZBuffer::new(view, scene.background);
            let mut visible = Visible::new(model.len());
            p_buffer::first_view(&model, &mut first, &mut visible, &mut Unmetered);
            assert!(plain.frame.colour == first.frame.colour, "{name}");
            assert!(plain.frame.depth == first.frame.depth, "{name}");
            assert!(plain.frame.id.iter().all(|&id| id == NO_ID));
            // And what is flagged is what is seen.
            let seen: BTreeSet<u32> =
                first.frame.id.into_iter().filter(|&id| id != NO_ID).collect();
            assert!(visible.ids().iter().eq(&seen), "{name}");
            for id in 0..model.len() as u32 {
                assert_eq!(visible.contains(id), seen.contains(&id), "{name}, {id}");
            }
        }
    }
}

/// Draws `to` from the polygons that `from` shows; compares with the truth, and returns wrong pixels.
fn check_next(scene: &Scene, model: &Model, visible: &mut Visible, from: View, to: View) -> usize {
    let mut buffer = ZBuffer::new(from, scene.background);
    p_buffer::first_view(model, &mut buffer, visible, &mut Unmetered);
    buffer.clear::<true>(to, scene.background);
    p_buffer::next_view::<true>(model, &mut buffer, visible, &mut Unmetered);
    let truth = full(model, to, scene.background);
    let mut wrong = 0;
    for (n, &id) in truth.id.iter().enumerate() {
        let hidden = id != NO_ID && !visible.contains(id);
        assert_eq!(buffer.frame.id[n] != id, hidden, "pixel {n}: {id}");
        wrong += usize::from(hidden);
    }
    wrong
}

#[test]
fn the_next_view_is_wrong_exactly_where_the_first_one_saw_nothing() {
    let mut wrong = Vec::new();
    for name in SCENES {
        let scene = scene(name, [300, 300]);
        let model = Model::new(&scene);
        let mut visible = Visible::new(model.len());
        let [left, right] = Eye::BOTH.map(|eye| View::of(&scene, eye));
        let (between, pose) =
            (View::between(&scene), Pose { moved: [-0.2, 0.0, 0.0], turned: -3.0 });
        let moved = between.at(&pose, &scene.rig);
        wrong.push(
            [(right, left), (left, right), (between, moved)]
                .map(|(from, to)| check_next(&scene, &model, &mut visible, from, to)),
        );
    }
    println!("wrong pixels of 90000: {wrong:?}");
    assert!(wrong.iter().flatten().any(|&n| n > 0));
}

#[test]
fn what_one_eye_sees_alone_is_missing() {
    let surroundings = 2 + (16 * 14 + 16 * 8) / 2;
    let blue = surroundings + 36..surroundings + 72;
    let slot = surroundings..surroundings + 1;
    for (name, alone) in [("perception-cylinder", blue), ("perception-solid", slot)] {
        let scene = scene(name, [640, 480]);
        let shown = |frame: &Frame| frame.id.iter().filter(|&id| alone.contains(id)).count();
        with_job(&scene, |job| {
            let direct = job.direct();
            let from_left = p_buffer::other_eye(job, &direct[0], Eye::Left, &mut Unmetered);
            assert_eq!(shown(&direct[0]), 0, "{name}");
            assert!(shown(&direct[1]) > 1000, "{name}: {}", shown(&direct[1]));
            assert_eq!(shown(&from_left), 0, "{name}");
        });
    }
}

#[test]
fn polygons_for_setup_are_flagged_alike() {
    for name in ["teapot", "room", "exclusive", "polygons", "windows", "office-2"] {
        let scene = scene::open(name, Some([320, 240]), None).expect("a built-in scene");
        with_job(&scene, |job| {
            let direct = job.direct();
            for first in Eye::BOTH {
                let mut work = Work::default();
                let source = &direct[first as usize];
                let derived = p_buffer::other_eye(job, source, first, &mut work);
                let second = first.other() as usize;
                let seen: BTreeSet<u32> = source.id.iter().copied().collect();
                let opaque = |p: &Polygon| p.vertices.iter().all(|v| v.colour[0].0[3] == 255);
                if job.polygons.iter().all(opaque) {
                    for (&ours, &theirs) in derived.id.iter().zip(&direct[second].id) {
                        assert_eq!(
                            ours != theirs,
                            theirs != NO_ID && !seen.contains(&theirs),
                            "{name}"
                        );
                    }
                }
                assert!(work.pixels_tested > 0 && work.polygons > 0);
            }
        });
    }
}

#[test]
fn counted_work_is_that_of_the_flagged_polygons() {
    let scene = scene("office-3", [300, 300]);
    let model = Model::new(&scene);
    let [left, right] = Eye::BOTH.map(|eye| View::of(&scene, eye));
    let mut visible = Visible::new(model.len());
    let [mut first, mut second] = [Work::default(); 2];
    let mut buffer = ZBuffer::new(right, scene.background);
    p_buffer::first_view(&model, &mut buffer, &mut visible, &mut first);
    let plain = buffer.frame.clone();
    buffer.clear::<true>(left, scene.background);
    p_buffer::next_view::<false>(&model, &mut buffer, &visible, &mut second);
    assert!(second.polygons <= visible.ids().len() as u64);
    assert!(first.polygons > 4 * second.polygons, "{first:?} {second:?}");
    // Every pixel of the frame is looked at once more to find what is visible.
    assert_eq!(first.pixels_tested, first.depth_tests + 90_000);
    assert!(first.pixels_written >= plain.id.iter().filter(|&&id| id != NO_ID).count() as u64);
    assert!(second.depth_tests < first.depth_tests);
}

#[test]
fn the_experiment_finds_what_it_should_and_writes_its_pictures() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let report = (wheatstone_studies::p_buffer::EXPERIMENT.run)(folder.path()).expect("it runs");
    for file in &report.files {
        assert!(file.metadata().expect("written").len() > 1000, "{}", file.display());
    }
    assert_eq!(report.files.len(), 11);
    let rows: usize = report.tables.iter().map(|table| table.rows.len()).sum();
    assert!(rows > 120, "{rows}");
    // Ratios of times belong to optimised code on a quiet machine.
    let timed = |row: &&wheatstone_studies::Row| row.what.contains(" : full pipeline");
    let differing: Vec<_> = report.differing().filter(|row| !timed(row)).collect();
    assert!(differing.is_empty(), "{differing:#?}");
}
