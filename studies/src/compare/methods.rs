//! The methods that are compared.

use super::{Method, Pair, Timed};
use crate::prepared::Prepared;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, Frames};
use wheatstone_golden::primary::Counts;
use wheatstone_golden::setup::{Eyes, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::work::{Unmetered, Work};

/// All methods, in the order of the table.
pub const METHODS: &[Method] = &[
    Method {
        name: "direct",
        description: "each view rasterised for itself",
        draw: |prepared| {
            let mut work = Work::default();
            let job = prepared.job();
            let left = job.view(Eye::Left, &mut Unmetered);
            let right = job.view(Eye::Right, &mut work);
            Ok(Pair { frames: [left, right], work, holes: None })
        },
        timed: Timed::Second(|prepared, _| prepared.job().view(Eye::Right, &mut Unmetered)),
    },
    Method {
        name: "sam-minimal",
        description: "stereoscopic affine mapping, minimal system: mapping and sampling only",
        draw: |prepared| Ok(mapped(prepared, true)),
        timed: Timed::Both {
            both: |prepared| both(&prepared.job(), true),
            first: |prepared| first(prepared, true),
        },
    },
    Method {
        name: "sam-hybrid",
        description: "stereoscopic affine mapping, hybrid system: all units",
        draw: |prepared| Ok(mapped(prepared, false)),
        timed: Timed::Both {
            both: |prepared| both(&prepared.job(), false),
            first: |prepared| first(prepared, false),
        },
    },
];

/// Both views by a system.
fn both(job: &Job, minimal: bool) -> Vec<Frame> {
    job.derived(minimal).0.eyes.to_vec()
}

/// The left view alone by a system.
fn first(prepared: &Prepared, minimal: bool) -> Vec<Frame> {
    left_alone(prepared, minimal).0.eyes.to_vec()
}

/// The left view alone by a system, which draws all polygons monocular then.
fn left_alone(prepared: &Prepared, minimal: bool) -> (Frames, Counts) {
    let seen = prepared.geometry.polygons.iter().filter(|p| p.eyes.contains(Eye::Left));
    let left = |p: &Polygon| Polygon { eyes: Eyes::One(Eye::Left), ..p.clone() };
    let polygons: Vec<Polygon> = seen.map(left).collect();
    Job { polygons: &polygons, ..prepared.job() }.derived(minimal)
}

/// Both views by a system; the beats of the second are those that the first alone would not take.
fn mapped(prepared: &Prepared, minimal: bool) -> Pair {
    let (frames, counts) = prepared.job().derived(minimal);
    let (_, alone) = left_alone(prepared, minimal);
    let work = Work {
        beats: counts.beats().saturating_sub(alone.beats()),
        pixels_written: frames.written[Eye::Right as usize],
        ..Work::default()
    };
    Pair { frames: frames.eyes, work, holes: None }
}
