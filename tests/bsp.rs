//! BSP trees against direct rendering: each view by order alone, and both by one traversal.

use wheatstone_golden::formats::{Eye, Rgba};
use wheatstone_golden::scene::builtin::SCENES;
use wheatstone_golden::scene::Cull;
use wheatstone_golden::setup::{Polygon, Vertex};
use wheatstone_golden::visibility::bsp::{self, Tree, ZBuffer};
use wheatstone_golden::visibility::Surfaces;
use wheatstone_golden::work::{Unmetered, Work};
use wheatstone_tests::visibility::{assert_seen, job, opaque, random_triangles, scene, tilted};

/// Two traversals, and one for both views, see what direct rendering sees. Returns the tree.
fn check(name: &str, polygons: &[Polygon], size: [u32; 2]) -> Tree {
    let job = job(polygons, size);
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
    let tree = Tree::new(&surfaces);
    let alone = Eye::BOTH.map(|eye| bsp::one(&surfaces, &tree, eye, &mut Unmetered));
    let both = bsp::both(&surfaces, &tree, &mut Unmetered);
    println!(
        "{name}: {} polygons, {} pieces, {} planes between the eyes, {} high",
        surfaces.opaque.len(),
        tree.pieces(),
        tree.contested(),
        tree.height()
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

#[test]
fn large_scenes_are_too() {
    for (name, most) in [("office-15", 1.5), ("atoms", 3.0)] {
        let polygons = opaque(&scene(name, [640, 480], Cull::Back));
        let tree = check(name, &polygons, [640, 480]);
        assert!(tree.height() < 1000, "{name}: {} high", tree.height());
        let pieces = tree.pieces() as f64;
        assert!(pieces < most * polygons.len() as f64, "{name}: {pieces} pieces");
    }
}

/// A bowl that the eyes look into, or the back of one: a surface whose every triangle has all others
/// on one side of it, so that its planes divide nothing.
fn bowl(cells: i32, away: bool, size: [u32; 2]) -> Vec<Polygon> {
    let corner = |i: i32, j: i32| {
        let [x, y] = [(i, size[0]), (j, size[1])].map(|(n, size)| n * (size as i32 * 256) / cells);
        let [u, v] = [i, j].map(|n| i64::from(2 * n - cells));
        let part = (u * u + v * v) * (1 << 23) / i64::from(2 * cells * cells);
        let depth = if away { part } else { (1 << 23) - part } as u32;
        let shift = (depth >> 13) as i32 - 512;
        let colour = [Rgba([200, 180, 160, 255]); 2];
        Vertex { x: [x, x + shift], y: [y; 2], depth, colour, ..Vertex::default() }
    };
    let mut polygons = Vec::new();
    for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
        let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(k, l)| corner(i + k, j + l));
        for vertices in [vec![a, b, c], vec![a, c, d]] {
            polygons.push(Polygon { vertices, id: polygons.len() as u32, ..Polygon::default() });
        }
    }
    polygons
}

#[test]
fn surfaces_that_no_plane_divides() {
    for away in [false, true] {
        let polygons = bowl(60, away, [640, 480]);
        let tree = check(&format!("bowl, away {away}"), &polygons, [640, 480]);
        assert!(tree.height() < polygons.len() / 10, "{} high", tree.height());
    }
}

#[test]
fn views_of_a_tilted_head_have_an_order_too() {
    let mut contested = 0;
    for (name, tilt) in [("exclusive", 20.0), ("village", -7.0), ("teapot", 90.0), ("room", 180.0)]
    {
        let scene = tilted(name, [160, 120], tilt);
        let polygons = opaque(&scene);
        let tree = check(&format!("{name} at {tilt} degrees"), &polygons, [160, 120]);
        contested += tree.contested();
    }
    assert!(contested > 10, "only {contested} planes pass between the eyes");
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
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
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
    let surfaces = Surfaces::new(&job).expect("not anti-aliased");
    let tree = Tree::new(&surfaces);
    let mut z_buffer = ZBuffer::default();
    let first = bsp::both(&surfaces, &tree, &mut Unmetered);
    for _ in 0..3 {
        let mut items = [surfaces.items(), surfaces.items()];
        bsp::draw(&surfaces, &tree, Eye::BOTH, &mut items, &mut z_buffer, &mut Unmetered);
        assert!(items == first);
    }
}
