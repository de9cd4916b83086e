//! Hybrid system: its choices of display, depth and depth test against direct rendering.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::frame::{Frame, Scissor};
use wheatstone_golden::interface::Beat;
use wheatstone_golden::pipeline::{Pixel, PrimaryBeat};
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::record::Recording;
use wheatstone_golden::setup::{Arrangement, Options, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const SIZE: [u32; 2] = [120, 90];

const ARRANGEMENTS: [Arrangement; 5] = [
    Arrangement::Normal,
    Arrangement::Flipped,
    Arrangement::Interleaved,
    Arrangement::AboveBelow,
    Arrangement::Rotated,
];

/// Everything built in that is exact: an upright head.
const UPRIGHT: Config = Config { tilt: false, ..Config::FULL };

fn job(config: Config, options: Options, polygons: &[Polygon]) -> Job<'_> {
    let [width, height] = SIZE;
    let (background, textures, lookup) = ([20, 40, 60], &[], Lookup::Nearest);
    let scissor = Scissor::default();
    Job { config, options, width, height, background, scissor, polygons, textures, lookup }
}

/// Polygons one behind and through another, triangles of all classes and convex ones of up to six
/// corners, some translucent.
fn polygons(seed: u64, config: &Config, count: u32) -> Vec<Polygon> {
    let mut triangles = Triangles::new(seed, Formats::new(config), SIZE[0], SIZE[1]);
    let mut rng = Rng::with_seed(seed);
    (0..count)
        .map(|id| {
            let mut polygon = match rng.usize(..Class::ALL.len() + 2) {
                n if n < Class::ALL.len() => triangles.triangle(Class::ALL[n]),
                _ => triangles.convex(),
            };
            let alpha = if rng.u32(..4) == 0 { rng.u8(..) } else { 255 };
            for vertex in &mut polygon.vertices {
                vertex.colour.iter_mut().for_each(|c| c.0[3] = alpha);
            }
            Polygon { id, ..polygon }
        })
        .collect()
}

/// Colour, depth and id of a view pixel, found on its display by the definition of the arrangement.
fn seen(
    frame: &Frame,
    arrangement: Arrangement,
    eye: Eye,
    [x, y]: [i64; 2],
) -> ([u8; 3], u32, u32) {
    let [width, height] = SIZE.map(i64::from);
    let right = eye == Eye::Right;
    let [column, row] = match arrangement {
        Arrangement::Normal => [x, y],
        Arrangement::Flipped => [x, height - 1 - y],
        Arrangement::Interleaved => [x, 2 * y + i64::from(right)],
        Arrangement::AboveBelow => [x, if right { height + y } else { y }],
        Arrangement::Rotated if right => [y, width - 1 - x],
        Arrangement::Rotated => [height - 1 - y, x],
    };
    let n = frame.index(column, row).expect("every view pixel is on the display");
    (frame.colour[n], frame.depth[n], frame.id[n])
}

fn assert_equal(frames: &[Frame; 2], direct: &[Frame; 2], arrangement: Arrangement, what: &str) {
    for eye in Eye::BOTH {
        for n in 0..direct[0].colour.len() {
            let [x, y] = [n % SIZE[0] as usize, n / SIZE[0] as usize].map(|n| n as i64);
            let expected = seen(&direct[eye as usize], Arrangement::Normal, eye, [x, y]);
            let found = seen(&frames[eye as usize], arrangement, eye, [x, y]);
            assert_eq!(found, expected, "{what} {arrangement:?} {eye:?} ({x}, {y})");
        }
    }
}

#[test]
fn every_arrangement_equals_direct_rendering() {
    for config in [UPRIGHT, Config { antialias: false, ..UPRIGHT }] {
        for (seed, arrangement) in ARRANGEMENTS.into_iter().enumerate() {
            for cost_rule in [true, false] {
                let options = Options { arrangement, cost_rule, ..Options::new(&config) };
                for batch in 0..6 {
                    let polygons = polygons(seed as u64 * 100 + batch, &config, 40);
                    let job = job(config, options, &polygons);
                    let (frames, counts) = job.derived(false);
                    assert!(cost_rule || counts.derived > 10);
                    assert_equal(&frames.eyes, &job.direct(), arrangement, "arranged");
                }
            }
        }
    }
}

#[test]
fn the_memory_may_test_depth_instead() {
    let external = Config { external_depth: true, ..UPRIGHT };
    for seed in 0..12 {
        let polygons = polygons(seed, &external, 60);
        let options = Options { cost_rule: seed % 2 == 0, ..Options::new(&external) };
        let job = job(external, options, &polygons);
        let (frames, _) = job.derived(false);
        assert_equal(&frames.eyes, &job.direct(), Arrangement::Normal, "tested by the memory");
        // The memory gets pixels that the hybrid would have dropped.
        let internal = Job { config: UPRIGHT, ..job.clone() };
        let (tested, _) = internal.derived(false);
        assert!(frames.eyes == tested.eyes, "seed {seed}");
        let pixels = |f: &wheatstone_golden::frame::Frames| f.written.iter().sum::<u64>();
        assert!(pixels(&frames) > pixels(&tested));
    }
}

#[test]
fn one_display_gets_every_pixel_in_the_order_of_both_streams() {
    for seed in 0..6 {
        let polygons = polygons(seed + 40, &UPRIGHT, 30);
        let options = Options { cost_rule: false, ..Options::new(&UPRIGHT) };
        let two = job(UPRIGHT, options, &polygons);
        let one = Job { options: Options { single: true, ..options }, ..two.clone() };
        let [two_streams, one_stream] = [&two, &one].map(|job| Recording::of(job, false).streams);
        assert!(one_stream["right"].is_empty());
        let rows = |table: &wheatstone_golden::interface::Table| {
            (0..table.len()).map(|n| Pixel::read(table.row(n))).collect::<Vec<_>>()
        };
        let all = rows(&one_stream["left"]);
        for eye in Eye::BOTH {
            let own: Vec<Pixel> = all.iter().filter(|p| p.eye == eye).copied().collect();
            assert!(own == rows(&two_streams[eye.name()]), "{eye:?} of seed {seed}");
        }
        assert_equal(&one.derived(false).0.eyes, &two.direct(), Arrangement::Normal, "one display");
    }
}

#[test]
fn a_sampled_depth_changes_no_coverage_and_is_that_of_a_primary_pixel() {
    let config = Config { interpolated_depth: false, ..UPRIGHT };
    let mut compared = 0;
    for class in Class::ALL {
        let mut triangles = Triangles::new(class as u64, Formats::new(&config), SIZE[0], SIZE[1]);
        for _ in 0..60 {
            // One at a time: nothing is hidden, so a frame shows what was covered.
            let mut polygon = triangles.triangle(class);
            // Flat enough that no extrapolated depth reaches the far plane and is clamped there.
            polygon.vertices.iter_mut().for_each(|v| v.depth = (1 << 23) + v.depth % 100);
            let options = Options { cost_rule: false, ..Options::new(&config) };
            let job = job(config, options, std::slice::from_ref(&polygon));
            let (direct, recording) = (job.direct(), Recording::of(&job, false));
            let (frames, counts) = job.derived(false);
            for eye in Eye::BOTH {
                let (frame, direct) = (&frames.eyes[eye as usize], &direct[eye as usize]);
                assert!(frame.id == direct.id, "{eye:?} coverage of {polygon:?}");
                assert!(frame.colour == direct.colour, "{eye:?} colour of {polygon:?}");
            }
            if counts.derived == 0 {
                continue;
            }
            compared += 1;
            let beats = &recording.streams["beat"];
            let depths: Vec<Depth> =
                (0..beats.len()).map(|n| PrimaryBeat::read(beats.row(n)).depth).collect();
            for eye in ["left", "right"] {
                let pixels = &recording.streams[eye];
                for n in 0..pixels.len() {
                    let depth = Pixel::read(pixels.row(n)).depth;
                    assert!(depths.contains(&depth), "{depth:?} of {polygon:?}");
                }
            }
        }
    }
    assert!(compared > 400, "only {compared} derived");
}

#[test]
fn without_integrated_colour_only_colours_differ() {
    let config = Config { integrated: false, ..UPRIGHT };
    let mut differ = 0;
    for seed in 0..6 {
        // Opaque ones: a translucent pixel's id is kept where its colour has no weight.
        let mut polygons = polygons(seed + 70, &config, 40);
        let vertices = polygons.iter_mut().flat_map(|p| &mut p.vertices);
        vertices.for_each(|v| v.colour.iter_mut().for_each(|c| c.0[3] = 255));
        let options = Options { cost_rule: false, ..Options::new(&config) };
        let job = job(config, options, &polygons);
        let (direct, (frames, _)) = (job.direct(), job.derived(false));
        for (frame, direct) in frames.eyes.iter().zip(&direct) {
            assert!(frame.id == direct.id && frame.depth == direct.depth, "seed {seed}");
            let pairs = frame.colour.iter().zip(&direct.colour);
            differ += pairs.filter(|(a, b)| a != b).count();
        }
    }
    assert!(differ > 1000, "sampled colours are not interpolated ones");
}
