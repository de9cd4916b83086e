//! Minimal system: what it draws for the secondary is a covered primary pixel that maps there, the
//! nearest one, and it draws every one that it can.

use crate::walk;

use std::collections::BTreeMap;
use walk::{each_derived, exact, walk, Fraction};
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::interface::{Beat, Table};
use wheatstone_golden::pipeline::{Pixel, PrimaryBeat};
use wheatstone_golden::random::Class;
use wheatstone_golden::record::Recording;
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

const SIZE: [u32; 2] = [160, 120];

fn beats<B: Beat>(table: &Table) -> Vec<B> {
    (0..table.len()).map(|n| B::read(table.row(n))).collect()
}

/// Distance from a pixel's centre, in pixels.
fn distance(position: &Fraction, column: i64) -> f64 {
    (position.value() - column as f64 - 0.5).abs()
}

#[test]
fn a_secondary_pixel_is_the_nearest_covered_primary_pixel_that_maps_into_it() {
    let [width, height] = SIZE;
    // What the register may be off, of which positions near a pixel's border depend.
    const SLACK: f64 = 0.02;
    for config in [Config::DEFAULT, Config { antialias: false, ..Config::PAPER }] {
        let options = Options { minimal: true, cost_rule: false, ..Options::new(&config) };
        let mut drawn = 0;
        each_derived(&config, options, SIZE, &Class::ALL, 40, |planner, polygon, derived| {
            let job = Job {
                config,
                options,
                width,
                height,
                background: [0; 3],
                scissor: Scissor::default(),
                polygons: std::slice::from_ref(polygon),
                textures: &[],
                lookup: Lookup::Nearest,
            };
            let recording = Recording::of(&job, true);
            let primary: Vec<PrimaryBeat> = beats(&recording.streams["beat"]);
            let walk = walk(planner, polygon, derived);
            assert_eq!(primary.len(), walk.beats.len());
            // Covered primary pixels by row: position in the secondary, colour and depth.
            let mut covered: BTreeMap<i64, Vec<(Fraction, Rgba, Depth)>> = BTreeMap::new();
            for (beat, step) in primary.iter().zip(&walk.beats) {
                if beat.centre {
                    let [x, _] = exact(polygon, derived.primary, step.at, &planner.formats);
                    covered.entry(step.at[1]).or_default().push((x, beat.rgba, beat.depth));
                }
            }
            let eye = derived.primary.other();
            let secondary: Vec<Pixel> = beats(&recording.streams[eye.name()]);
            let mut places = BTreeMap::new();
            for pixel in &secondary {
                assert_eq!((pixel.eye, pixel.write, pixel.blended), (eye, true, false));
                let (column, row) = (pixel.x.raw(), pixel.y.raw());
                assert!(places.insert((column, row), ()).is_none(), "drawn twice: {polygon:?}");
                let near = |x: &Fraction| distance(x, column) <= 0.5 + SLACK;
                let mut candidates = covered[&row].iter().filter(|(x, ..)| near(x));
                let nearest = candidates.clone().map(|(x, ..)| distance(x, column));
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                let is_it = |(x, rgba, depth): &(Fraction, Rgba, Depth)| {
                    let best = distance(x, column) <= nearest + SLACK;
                    best && *rgba == pixel.rgba && *depth == pixel.depth
                };
                assert!(candidates.any(is_it), "({column}, {row}): {pixel:?} of {polygon:?}");
                drawn += 1;
            }
            for (row, positions) in &covered {
                for (x, ..) in positions {
                    let column = x.floor();
                    let certain = distance(x, column) < 0.5 - SLACK;
                    if certain && (0..i64::from(width)).contains(&column) {
                        assert!(places.contains_key(&(column, *row)), "({column}, {row}) missing");
                    }
                }
            }
        });
        assert!(drawn > 20_000, "only {drawn} pixels compared");
    }
}

#[test]
fn every_row_ends_within_a_pixel_of_the_direct_one() {
    let [width, height] = SIZE;
    let config = Config::DEFAULT;
    let options = Options { minimal: true, cost_rule: false, ..Options::new(&config) };
    each_derived(&config, options, SIZE, &Class::ALL, 60, |_, polygon, derived| {
        let job = Job {
            config,
            options,
            width,
            height,
            background: [0; 3],
            scissor: Scissor::default(),
            polygons: std::slice::from_ref(polygon),
            textures: &[],
            lookup: Lookup::Nearest,
        };
        let eye = derived.primary.other() as usize;
        let (direct, (frames, _)) = (job.direct(), job.derived(true));
        for row in 0..height {
            let columns = |frame: &wheatstone_golden::frame::Frame| {
                let at = |x: &u32| frame.id[(row * width + x) as usize] == polygon.id;
                let columns: Vec<u32> = (0..width).filter(at).collect();
                columns.first().copied().zip(columns.last().copied())
            };
            let ends = [columns(&frames.eyes[eye]), columns(&direct[eye])];
            match ends {
                [Some((first, last)), Some((left, right))] => {
                    assert!(first.abs_diff(left) <= 1 && last.abs_diff(right) <= 1, "{polygon:?}");
                }
                [Some((first, last)), None] | [None, Some((first, last))] => {
                    assert!(last - first <= 1, "row {row} {ends:?} of {polygon:?}");
                }
                [None, None] => {}
            }
        }
    });
}
