//! BSP trees against direct rendering: each view by order alone, and both by one traversal.

use std::time::{Duration, Instant};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::scene::builtin::SCENES;
use wheatstone_golden::scene::Cull;
use wheatstone_golden::setup::Polygon;
use wheatstone_golden::visibility::bsp::{self, Tree, ZBuffer};
use wheatstone_golden::visibility::Surfaces;
use wheatstone_golden::work::{Unmetered, Work};
use wheatstone_tests::visibility::{assert_seen, job, opaque, random_triangles, scene};

/// Two traversals, and one for both views, see what direct rendering sees. Returns the tree.
fn check(name: &str, polygons: &[Polygon], size: [u32; 2]) -> Tree {
    let job = job(polygons, size);
    let surfaces = Surfaces::new(&job).expect("level and not anti-aliased");
    let start = Instant::now();
    let tree = Tree::new(&surfaces);
    let made = start.elapsed();
    let alone = Eye::BOTH.map(|eye| bsp::one(&surfaces, &tree, eye, &mut Unmetered));
    let both = bsp::both(&surfaces, &tree, &mut Unmetered);
    println!(
        "{name}: {} polygons, {} pieces, {} planes between the eyes, made in {made:.2?}",
        surfaces.opaque.len(),
        tree.pieces(),
        tree.contested()
    );
    assert_seen(&format!("{name}, twice"), &job, &surfaces, &alone);
    assert_seen(&format!("{name}, both"), &job, &surfaces, &both);
    assert!(both[1] == alone[1], "{name}: the right view is not painted by order");
    tree
}

#[test]
fn built_in_scenes_are_seen_as_direct_rendering_sees_them() {
    for builtin in SCENES.iter().filter(|scene| scene.name != "room") {
        let polygons = opaque(&scene(builtin.name, [320, 240], Cull::None));
        let tree = check(builtin.name, &polygons, [320, 240]);
        assert!(tree.pieces() < 3 * polygons.len(), "{} of {}", tree.pieces(), polygons.len());
    }
}

#[test]
fn the_room_is_too() {
    let polygons = opaque(&scene("room", [160, 120], Cull::Back));
    let tree = check("room", &polygons, [160, 120]);
    assert!(tree.pieces() < 2 * polygons.len(), "{} of {}", tree.pieces(), polygons.len());
}

/// Scenes whose trees would take time by the square of their polygons without lines across the views.
#[test]
fn large_scenes_are_too() {
    for (name, most) in [("office-15", 1.5), ("atoms", 3.0)] {
        let polygons = opaque(&scene(name, [640, 480], Cull::Back));
        let start = Instant::now();
        let tree = check(name, &polygons, [640, 480]);
        assert!(start.elapsed() < Duration::from_secs(20), "{name}: {:.1?}", start.elapsed());
        let pieces = tree.pieces() as f64;
        assert!(pieces < most * polygons.len() as f64, "{name}: {pieces} pieces");
    }
}

#[test]
fn random_triangles_that_pass_through_each_other() {
    let mut contested = 0;
    for seed in 0..8 {
        let polygons = random_triangles(seed, 120, [200, 150]);
        let tree = check(&format!("seed {seed}"), &polygons, [200, 150]);
        assert!(tree.pieces() > 120, "nothing was cut");
        contested += tree.contested();
    }
    assert!(contested > 20, "only {contested} planes pass between the eyes");
}

#[test]
fn one_traversal_does_less() {
    let polygons = opaque(&scene("village", [320, 240], Cull::Back));
    let job = job(&polygons, [320, 240]);
    let surfaces = Surfaces::new(&job).expect("level and not anti-aliased");
    let tree = Tree::new(&surfaces);
    let mut twice = Work::default();
    for eye in Eye::BOTH {
        bsp::one(&surfaces, &tree, eye, &mut twice);
    }
    let mut both = Work::default();
    bsp::both(&surfaces, &tree, &mut both);
    println!("twice {twice:?}\nboth {both:?}");
    assert_eq!((both.polygons, both.pixels_written), (twice.polygons, twice.pixels_written));
    assert_eq!(twice.depth_tests, 0);
    assert!((both.edge_updates as f64) < 0.6 * twice.edge_updates as f64);
    // Depth decides below planes between the eyes only.
    assert!(both.depth_tests < both.pixels_written / 4, "{}", both.depth_tests);
}

/// A z-buffer serves any number of frames without being cleared.
#[test]
fn a_z_buffer_is_used_again() {
    let polygons = random_triangles(5, 100, [200, 150]);
    let job = job(&polygons, [200, 150]);
    let surfaces = Surfaces::new(&job).expect("level and not anti-aliased");
    let tree = Tree::new(&surfaces);
    let mut z_buffer = ZBuffer::default();
    let first = bsp::both(&surfaces, &tree, &mut Unmetered);
    for _ in 0..3 {
        let mut items = [surfaces.items(), surfaces.items()];
        bsp::draw(&surfaces, &tree, Eye::BOTH, &mut items, &mut z_buffer, &mut Unmetered);
        assert!(items == first);
    }
}
