//! Functions that the tests of hidden-surface algorithms share.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::scene::{self, Cull, Geometry};
use wheatstone_golden::setup::{Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::visibility::{Items, Surfaces};

/// A built-in scene for the default configuration.
pub fn scene(name: &str, size: [u32; 2], cull: Cull) -> Geometry {
    let scene = scene::open(name, Some(size), None).expect("a built-in scene");
    let options = scene::Options { cull, ..scene::Options::default() };
    scene.geometry(&Formats::new(&Config::DEFAULT), &options).expect("it is sound")
}

/// A built-in scene as a viewer with a tilted head sees it.
pub fn tilted(name: &str, size: [u32; 2], degrees: f64) -> Geometry {
    let mut scene = scene::open(name, Some(size), None).expect("a built-in scene");
    scene.rig.head_tilt = degrees;
    let formats = Formats::new(&Config::DEFAULT);
    scene.geometry(&formats, &scene::Options::default()).expect("it is sound")
}

/// The opaque polygons of a scene, without their textures.
pub fn opaque(geometry: &Geometry) -> Vec<Polygon> {
    let solid = |p: &&Polygon| p.vertices.iter().all(|v| v.colour[0].0[3] == 255);
    let bare = |p: &Polygon| Polygon { texture: None, ..p.clone() };
    geometry.polygons.iter().filter(solid).map(bare).collect()
}

/// A job of these polygons.
pub fn job(polygons: &[Polygon], size: [u32; 2]) -> Job<'_> {
    Job {
        config: Config::DEFAULT,
        options: Options::new(&Config::DEFAULT),
        width: size[0],
        height: size[1],
        background: [20, 30, 40],
        scissor: Scissor::default(),
        polygons,
        textures: &[],
        lookup: Lookup::Nearest,
    }
}

/// Random triangles of all classes, which pass through each other, numbered in order; the eyes see
/// every fourth one from different sides.
pub fn random_triangles(seed: u64, count: usize, size: [u32; 2]) -> Vec<Polygon> {
    let formats = Formats::new(&Config::DEFAULT);
    let mut triangles = Triangles::new(seed, formats, size[0], size[1]);
    let mut polygon = |n: usize| {
        let mut polygon = triangles.triangle(Class::ALL[n % Class::ALL.len()]);
        if n.is_multiple_of(4) {
            let middle = polygon.vertices[0].x[0] + 300;
            polygon.vertices.iter_mut().for_each(|v| v.x[1] = 2 * middle - v.x[0]);
        }
        Polygon { id: n as u32, ..polygon }
    };
    (0..count).map(&mut polygon).collect()
}

/// Holds item buffers against direct rendering of a job without translucent polygons: the same
/// ids, colours and depths, except where the depths of the two polygons agree to within one unit,
/// the rounding of direct rendering's planes.
pub fn assert_seen(name: &str, job: &Job, surfaces: &Surfaces, items: &[Items; 2]) {
    for (eye, direct) in Eye::BOTH.into_iter().zip(job.direct()) {
        let frame = surfaces.frame(&items[eye as usize], eye);
        let mut ties = 0;
        for index in 0..frame.id.len() {
            let (ours, theirs) = (frame.id[index], direct.id[index]);
            let place = || {
                let [x, y] = [index % job.width as usize, index / job.width as usize];
                format!("{name}, {} view, pixel {x}, {y}: polygons {ours}, {theirs}", eye.name())
            };
            let [depth, other] = [frame.depth[index], direct.depth[index]];
            assert!(depth.abs_diff(other) <= 1, "{}: depths {depth}, {other}", place());
            if ours != theirs {
                ties += 1;
            } else if depth == other {
                let [a, b] = [frame.colour[index], direct.colour[index]];
                assert!(a == b || depth_is_shared(surfaces, ours), "{}: {a:?}, {b:?}", place());
            }
        }
        println!("{name}, {} view: {ties} of {} pixels are ties", eye.name(), frame.id.len());
        assert!(ties * 100 < frame.id.len(), "{name}: {ties} ties");
    }
}

/// True if polygons have this id in common, as parts of one polygon that was cut have.
fn depth_is_shared(surfaces: &Surfaces, id: u32) -> bool {
    surfaces.opaque.iter().filter(|p| p.id == id).count() > 1
}
