//! The hybrid's secondary against direct rasterisation, bit for bit, on random triangles.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::{Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const SIZE: [u32; 2] = [160, 120];

fn job(config: Config, options: Options, polygons: &[Polygon]) -> Job<'_> {
    let [width, height] = SIZE;
    let (background, textures, lookup) = ([20, 40, 60], &[], Lookup::Nearest);
    let scissor = Scissor::default();
    Job { config, options, width, height, background, scissor, polygons, textures, lookup }
}

/// Draws `count` triangles of a class, a few to a frame, and returns how many were derived.
fn compare(config: Config, cost_rule: bool, class: Class, count: usize) -> (u64, u64) {
    let [width, height] = SIZE;
    let mut triangles = Triangles::new(class as u64 + 77, Formats::new(&config), width, height);
    let options = Options { cost_rule, ..Options::new(&config) };
    let (mut derived, mut drawn) = (0, 0);
    for batch in 0..count.div_ceil(10) {
        let polygons: Vec<Polygon> =
            (0..10).map(|id| Polygon { id, ..triangles.triangle(class) }).collect();
        let job = job(config, options, &polygons);
        let direct = job.direct();
        let (frames, counts) = job.derived(false);
        for (eye, (direct, hybrid)) in direct.iter().zip(&frames.eyes).enumerate() {
            for index in 0..direct.id.len() {
                let at = (index % width as usize, index / width as usize);
                assert_eq!(
                    hybrid.id[index], direct.id[index],
                    "{class:?} {batch} eye {eye} {at:?} id {polygons:?}"
                );
                assert_eq!(
                    hybrid.depth[index], direct.depth[index],
                    "{class:?} {batch} eye {eye} {at:?} depth"
                );
                assert_eq!(
                    hybrid.colour[index], direct.colour[index],
                    "{class:?} {batch} eye {eye} {at:?} colour"
                );
            }
        }
        derived += counts.derived;
        drawn += counts.polygons - counts.nothing;
    }
    println!("{} {cost_rule}: {derived} of {drawn} derived", class.name());
    (derived, drawn)
}

/// Ten thousand triangles of every class, with the cost rule off and on.
fn compare_all(config: Config) {
    let classes = Class::ALL.chunks(Class::ALL.len().div_ceil(2));
    std::thread::scope(|scope| {
        for half in classes {
            scope.spawn(move || {
                for &class in half {
                    let (derived, drawn) = compare(config, false, class, 10_000);
                    assert!(derived * 2 > drawn, "{class:?}: too few derived");
                    let (derived, _) = compare(config, true, class, 10_000);
                    assert!(derived > 0, "{class:?}: none derived with the cost rule");
                }
            });
        }
    });
}

#[test]
fn both_images_equal_direct_rendering() {
    compare_all(Config { tilt: false, antialias: false, ..Config::FULL });
}

#[test]
fn both_images_equal_direct_rendering_with_antialiasing() {
    compare_all(Config { tilt: false, ..Config::FULL });
}

#[test]
fn and_with_four_subpixel_bits() {
    let narrow = Config { integrated: true, interpolated_depth: true, ..Config::PAPER };
    compare_all(narrow);
}
