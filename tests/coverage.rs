//! Coverage: masks against scan conversion on a grid four times as fine.

use std::collections::BTreeMap;
use wheatstone_golden::config::Config;
use wheatstone_golden::direct::scan;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::frame::Scissor;
use wheatstone_golden::pipeline::observer::Unit;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::record::Recording;
use wheatstone_golden::setup::{Options, Outline, Plan, Planner};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// Masks of the secondary pixels, by place, as the coverage unit gives them.
fn derived_masks(recording: &Recording) -> BTreeMap<(i64, i64), u16> {
    let table = |unit: Unit| &recording.outputs[&unit];
    let (x, y) = (table(Unit::XInterpolator), table(Unit::YInterpolator));
    let (place, coverage) = (table(Unit::Display), table(Unit::Coverage));
    let mut masks = BTreeMap::new();
    for n in 0..x.len() {
        // x: op, save, last, x, move, near, inside, end; y: y, move, inside, end.
        let (inside, end) = (x.row(n)[6] & y.row(n)[2] == 1, (x.row(n)[7] | y.row(n)[3]) == 1);
        let mask = coverage.row(n)[0] as u16;
        if inside && end && mask != 0 {
            let at = (place.row(n)[0] as i64, place.row(n)[1] as i64);
            assert_eq!(masks.insert(at, mask), None, "pixel {at:?} was given twice");
        }
    }
    masks
}

#[test]
fn secondary_masks_equal_direct_scan_conversion() {
    let [width, height] = [160, 120];
    for config in [Config { tilt: false, ..Config::FULL }, Config::DEFAULT, Config::PAPER] {
        let f = Formats::new(&config);
        let options = Options { cost_rule: false, ..Options::new(&config) };
        let planner = Planner::new(config, options, width, height);
        for class in Class::ALL {
            let mut triangles = Triangles::new(class as u64, f, width, height);
            let mut derived = 0;
            for _ in 0..300 {
                let polygon = triangles.triangle(class);
                let Plan::Derived(plan) = planner.plan(&polygon) else { continue };
                derived += 1;
                let job = Job {
                    config,
                    options,
                    width,
                    height,
                    background: [0; 3],
                    scissor: Scissor::default(),
                    polygons: std::slice::from_ref(&polygon),
                    textures: &[],
                    lookup: Lookup::Nearest,
                };
                let masks = derived_masks(&Recording::of(&job, false));
                let mut expected = BTreeMap::new();
                let outline = Outline::new(&polygon, plan.primary.other());
                scan(&outline, [width, height], &f, |x, y, mask, _| {
                    expected.insert((x, y), mask);
                });
                assert_eq!(masks, expected, "{class:?} {polygon:?}");
            }
            assert!(derived > 100, "{class:?}: only {derived} derived");
        }
    }
}
