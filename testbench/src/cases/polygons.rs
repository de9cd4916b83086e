//! Random polygons, and jobs that draw them.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::record::Tape;
use wheatstone_golden::setup::{Arrangement, Eyes, Options, Polygon, Sampling, Specular};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// Options drawn at random among those that the configuration can build.
pub fn options(rng: &mut Rng, config: &Config) -> Options {
    let pick = |rng: &mut Rng, n: usize| rng.usize(..n);
    Options {
        cost_rule: rng.u32(..4) == 0,
        specular: if config.integrated && rng.bool() {
            Specular::Integrated
        } else {
            [Specular::Approximation, Specular::Exception][pick(rng, 2)]
        },
        sampling: [Sampling::Automatic, Sampling::Nearest, Sampling::Average][pick(rng, 3)],
        arrangement: [
            Arrangement::Normal,
            Arrangement::Flipped,
            Arrangement::Interleaved,
            Arrangement::AboveBelow,
            Arrangement::Rotated,
        ][pick(rng, 5)],
        single: rng.u32(..5) == 0,
        minimal: false,
    }
}

/// Polygons of all classes, alpha and convex polygons of more than three corners among them.
pub fn random_polygons(seed: u64, formats: Formats, size: [u32; 2], count: u32) -> Vec<Polygon> {
    let mut triangles = Triangles::new(seed, formats, size[0], size[1]);
    (0..count)
        .map(|id| {
            let class = Class::ALL[triangles.rng.usize(..Class::ALL.len())];
            let mut polygon = triangles.triangle(class);
            if triangles.rng.u32(..8) == 0 {
                polygon = triangles.convex();
            }
            if triangles.rng.u32(..4) == 0 {
                let alpha = triangles.rng.u8(..);
                polygon
                    .vertices
                    .iter_mut()
                    .for_each(|v| v.colour.iter_mut().for_each(|c| c.0[3] = alpha));
            }
            Polygon { id, ..polygon }
        })
        .collect()
}

/// Small polygons one after another in the same place, for either eye first: a slot that is still in
/// the queue holds the place that the next one reads.
pub fn crowd(seed: u64, formats: Formats, size: [u32; 2], count: u32) -> Vec<Polygon> {
    let mut triangles = Triangles::new(seed, formats, size[0], size[1]);
    let mut place = Polygon::default();
    let polygon = |id| {
        if id % 8 == 0 {
            let class = [Class::Px2, Class::Px8][triangles.rng.usize(..2)];
            place = triangles.triangle(class);
        }
        let mut polygon = Polygon { id, ..place.clone() };
        let rng = &mut triangles.rng;
        let (swap, colour) = (rng.bool(), rng.u32(..));
        // Few depths, so that some are equal and some differ by one.
        let depth = DEPTH_MAX / 2 + rng.u32(..4);
        if rng.u32(..4) == 0 {
            polygon.eyes = Eyes::One(Eye::BOTH[rng.usize(..2)]);
        }
        for vertex in &mut polygon.vertices {
            if swap {
                vertex.x.swap(0, 1);
            }
            (vertex.depth, vertex.colour) = (depth, [Rgba::from_word(colour); 2]);
        }
        polygon
    };
    (0..count).map(polygon).collect()
}

/// A tape of random polygons, and a job without them.
pub fn random_tape(
    config: &Config,
    seed: u64,
    beats: usize,
    minimal: bool,
) -> (Job<'static>, Tape) {
    let f = Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let crowded = rng.u32(..4) == 0;
    let size = match crowded {
        true => [rng.u32(4..24), rng.u32(4..24)],
        false => [rng.u32(24..120), rng.u32(16..90)],
    };
    let options = options(rng, config);
    let nothing = job(config, options, size, &[]);
    let mut tape = Tape::new(&nothing, minimal, false);
    let mut drawn = 0;
    for _ in 0..beats {
        let mut polygons = match crowded {
            true => crowd(rng.u64(..), f, size, 64),
            false => random_polygons(rng.u64(..), f, size, 16),
        };
        if config.tilt {
            polygons.iter_mut().for_each(|polygon| tilt(polygon, rng));
        }
        drawn += job(config, options, size, &polygons).run(minimal, tape.sink()).beats();
        if drawn >= beats as u64 {
            break;
        }
    }
    (nothing, tape)
}

/// Shears the right eye's view up or down by at most a pixel a column, as a tilted head does; leaves
/// some polygons upright.
pub(super) fn tilt(polygon: &mut Polygon, rng: &mut Rng) {
    let slant = [0, 0, 256, -256, rng.i32(-256..=256), rng.i32(-40..=40)][rng.usize(..6)];
    let origin = polygon.vertices[0].x[0];
    for vertex in &mut polygon.vertices {
        vertex.y[1] += (vertex.x[0] - origin) * slant / 256;
    }
}

pub fn job<'a>(
    config: &Config,
    options: Options,
    size: [u32; 2],
    polygons: &'a [Polygon],
) -> Job<'a> {
    Job {
        config: *config,
        options,
        width: size[0],
        height: size[1],
        background: [30, 60, 90],
        scissor: Scissor::default(),
        polygons,
        textures: &[],
        lookup: Lookup::Nearest,
    }
}
