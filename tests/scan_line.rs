//! The scan-line algorithm against direct rendering, and both views at once against each alone.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::scene::builtin::SCENES;
use wheatstone_golden::scene::Cull;
use wheatstone_golden::visibility::{scan_line, Surfaces};
use wheatstone_golden::work::{Counted, Unmetered, Work};
use wheatstone_tests::visibility::{assert_seen, job, opaque, random_triangles, scene, tilted};

/// Both views at once are the same as each alone, and as direct rendering.
fn check(name: &str, polygons: &[wheatstone_golden::setup::Polygon], size: [u32; 2]) {
    let job = job(polygons, size);
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
    let both = scan_line::both::<f64>(&surfaces, &mut Unmetered);
    for eye in Eye::BOTH {
        let alone = scan_line::one::<f64>(&surfaces, eye, &mut Unmetered);
        assert!(both[eye as usize] == alone, "{name}: {} view depends on the other", eye.name());
    }
    assert_seen(name, &job, &surfaces, &both);
}

#[test]
fn built_in_scenes_are_seen_as_direct_rendering_sees_them() {
    for builtin in &SCENES {
        for cull in [Cull::None, Cull::Back] {
            let geometry = scene(builtin.name, [320, 240], cull);
            check(builtin.name, &opaque(&geometry), [320, 240]);
        }
    }
}

#[test]
fn random_triangles_that_pass_through_each_other() {
    for seed in 0..12 {
        let polygons = random_triangles(seed, 300, [240, 180]);
        check(&format!("seed {seed}"), &polygons, [240, 180]);
    }
}

/// Then each view has a pass of its own.
#[test]
fn views_of_a_tilted_head() {
    for (name, tilt) in [("exclusive", 20.0), ("village", -90.0)] {
        check(name, &opaque(&tilted(name, [160, 120], tilt)), [160, 120]);
    }
}

#[test]
fn translucent_polygons_are_drawn_over_the_others() {
    let geometry = scene("room", [320, 240], Cull::None);
    let job = job(&geometry.polygons, [320, 240]);
    let job = wheatstone_golden::stereo::Job { textures: &geometry.textures, ..job };
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
    assert!(surfaces.translucent.len() > 100);
    let both = scan_line::both::<f64>(&surfaces, &mut Unmetered);
    for (eye, direct) in Eye::BOTH.into_iter().zip(job.direct()) {
        let frame = surfaces.frame(&both[eye as usize], eye);
        let wrong = frame.colour.iter().zip(&direct.colour).filter(|(a, b)| a != b).count();
        println!("room, {} view: {wrong} colours differ", eye.name());
        assert!(wrong <= 3, "{} view: {wrong} colours differ", eye.name());
    }
}

#[test]
fn work_of_both_views_at_once() {
    let polygons = opaque(&scene("village", [320, 240], Cull::Back));
    let job = job(&polygons, [320, 240]);
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
    let count = |run: &dyn Fn(&mut Work)| {
        let mut work = Work::default();
        let (_, operations) = wheatstone_golden::work::counted(|| run(&mut work));
        Work { operations, ..work }
    };
    let alone =
        |eye| count(&|work: &mut Work| drop(scan_line::one::<Counted>(&surfaces, eye, work)));
    let twice = alone(Eye::Left) + alone(Eye::Right);
    let both = count(&|work: &mut Work| drop(scan_line::both::<Counted>(&surfaces, work)));
    println!("twice {twice:?}\nboth {both:?}");
    assert_eq!((both.polygons, both.pixels_written), (twice.polygons, twice.pixels_written));
    assert_eq!(both.depth_tests, twice.depth_tests);
    // One list, and one depth along each edge: 3 values an edge and row instead of 4.
    assert!((both.edge_updates as f64) < 0.52 * twice.edge_updates as f64);
    let [both_edges, twice_edges] =
        [both, twice].map(|w| (w.interpolations - w.depth_tests) as f64);
    assert!(both_edges < 0.77 * twice_edges, "{both_edges} of {twice_edges}");
    assert!(both.operations.all() < twice.operations.all());
}

#[test]
fn what_cannot_be_shared_is_refused() {
    let polygons = opaque(&scene("ties", [64, 48], Cull::None));
    let base = job(&polygons, [64, 48]);
    let full = wheatstone_golden::stereo::Job { config: Config::FULL, ..base.clone() };
    assert!(Surfaces::new(&full).unwrap_err().to_string().contains("antialias"));
    let mut tilted = polygons.clone();
    tilted[5].vertices[1].y[1] += 1;
    let job = job(&tilted, [64, 48]);
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
    let error = surfaces.level().unwrap_err().to_string();
    assert!(error.contains(&format!("polygon {}", tilted[5].id)) && error.contains("tilted"));
}
