//! The methods that are compared.

use super::method::{Judged, Method, Pair, Timed, Unsuited};
use crate::prepared::Prepared;
use crate::timing::shortest;
use std::time::Duration;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, Frames};
use wheatstone_golden::primary::Counts;
use wheatstone_golden::setup::{Eyes, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::visibility::bsp::{self, Tree};
use wheatstone_golden::visibility::p_buffer;
use wheatstone_golden::visibility::warping::{self, Disparity, Warped};
use wheatstone_golden::visibility::{scan_line, Items, Surfaces};
use wheatstone_golden::work::{counted, Counted, Meter, Real, Unmetered, Work};

/// All methods, in the order of the table.
pub const METHODS: &[Method] = &[
    Method {
        name: "direct",
        description: "each view rasterised for itself",
        judged: Judged::Right,
        preparation: None,
        draw: |prepared| {
            let mut work = Work::default();
            let job = prepared.job();
            let left = job.view(Eye::Left, &mut Unmetered);
            let right = job.view(Eye::Right, &mut work);
            // What a second pass of the pixel pipeline would take.
            work.beats = alone(prepared, Eye::Right, false).1.beats();
            Ok(Pair { frames: [left, right], work, counts: None })
        },
        timed: Timed::Second(|prepared, _| prepared.job().view(Eye::Right, &mut Unmetered)),
    },
    Method {
        name: "warping",
        description: "pixels of the first view moved by their disparity",
        judged: Judged::Right,
        preparation: None,
        draw: |prepared| {
            let mut work = Work::default();
            let job = prepared.job();
            let left = job.view(Eye::Left, &mut Unmetered);
            let warped = warp(prepared, &left, &mut work);
            Ok(Pair { frames: [left, warped.frame], work, counts: None })
        },
        timed: Timed::Second(|prepared, left| warp(prepared, left, &mut Unmetered).frame),
    },
    Method {
        name: "p-buffer",
        description: "the polygons that the first view shows, drawn for the second",
        judged: Judged::Right,
        preparation: None,
        draw: |prepared| {
            let mut work = Work::default();
            let job = prepared.job();
            let left = job.view(Eye::Left, &mut Unmetered);
            let right = p_buffer::other_eye(&job, &left, Eye::Left, &mut work);
            Ok(Pair { frames: [left, right], work, counts: None })
        },
        timed: Timed::Second(|prepared, left| {
            p_buffer::other_eye(&prepared.job(), left, Eye::Left, &mut Unmetered)
        }),
    },
    Method {
        name: "scan-line",
        description: "scan-line hidden surfaces of both views at once",
        judged: Judged::Both,
        preparation: None,
        draw: |prepared| {
            // With a tilted head there would be a pass for each view, and nothing shared.
            surfaces(prepared)?.level().map_err(|error| Unsuited(error.to_string()))?;
            simultaneous(prepared, scanned::<Counted, _>, scanned_first::<Counted, _>)
        },
        timed: Timed::Both {
            both: |prepared| {
                frames(prepared, |s| scanned::<f64, _>(prepared, s, &mut Unmetered).into())
            },
            first: |prepared| {
                frames(prepared, |s| vec![scanned_first::<f64, _>(prepared, s, &mut Unmetered)])
            },
        },
    },
    Method {
        name: "bsp-z",
        description: "BSP tree, made beforehand, and one z-buffer: both views by one traversal",
        judged: Judged::Both,
        preparation: Some(make_tree),
        draw: |prepared| simultaneous(prepared, painted, painted_first),
        timed: Timed::Both {
            both: |prepared| frames(prepared, |s| painted(prepared, s, &mut Unmetered).into()),
            first: |prepared| {
                frames(prepared, |s| vec![painted_first(prepared, s, &mut Unmetered)])
            },
        },
    },
    Method {
        name: "sam-minimal",
        description: "stereoscopic affine mapping, minimal system: mapping and sampling only",
        judged: Judged::Both,
        preparation: None,
        draw: |prepared| Ok(mapped(prepared, true)),
        timed: Timed::Both {
            both: |prepared| both(&prepared.job(), true),
            first: |prepared| first(prepared, true),
        },
    },
    Method {
        name: "sam-hybrid",
        description: "stereoscopic affine mapping, hybrid system: all units",
        judged: Judged::Both,
        preparation: None,
        draw: |prepared| Ok(mapped(prepared, false)),
        timed: Timed::Both {
            both: |prepared| both(&prepared.job(), false),
            first: |prepared| first(prepared, false),
        },
    },
];

/// The surfaces of a scene.
fn surfaces(prepared: &Prepared) -> Result<Surfaces<'_>, Unsuited> {
    Surfaces::new(&prepared.job()).map_err(|error| Unsuited(error.to_string()))
}

fn scanned<T: Real, M: Meter>(_: &Prepared, surfaces: &Surfaces, meter: &mut M) -> [Items; 2] {
    scan_line::both::<T>(surfaces, meter)
}

fn scanned_first<T: Real, M: Meter>(_: &Prepared, surfaces: &Surfaces, meter: &mut M) -> Items {
    scan_line::one::<T>(surfaces, Eye::Left, meter)
}

fn painted<M: Meter>(prepared: &Prepared, surfaces: &Surfaces, meter: &mut M) -> [Items; 2] {
    bsp::both(surfaces, prepared.tree(surfaces), meter)
}

fn painted_first<M: Meter>(prepared: &Prepared, surfaces: &Surfaces, meter: &mut M) -> Items {
    bsp::one(surfaces, prepared.tree(surfaces), Eye::Left, meter)
}

/// Time to make the tree anew.
fn make_tree(prepared: &Prepared) -> Duration {
    // Only scenes that can be drawn are timed.
    surfaces(prepared).map_or(Duration::ZERO, |surfaces| shortest(1, || Tree::new(&surfaces)))
}

/// Both views at once, and the work that they take more than the left one by the same code.
fn simultaneous(
    prepared: &Prepared,
    both: impl Fn(&Prepared, &Surfaces, &mut Work) -> [Items; 2],
    first: impl Fn(&Prepared, &Surfaces, &mut Work) -> Items,
) -> Result<Pair, Unsuited> {
    let surfaces = surfaces(prepared)?;
    let (mut together, mut alone) = (Work::default(), Work::default());
    let (items, done) = counted(|| both(prepared, &surfaces, &mut together));
    together.operations = done;
    let (_, done) = counted(|| first(prepared, &surfaces, &mut alone));
    alone.operations = done;
    let [left, right] = items;
    let left = surfaces.frame(&left, Eye::Left);
    let right = surfaces.frame_metered(&right, Eye::Right, &mut together);
    Ok(Pair { frames: [left, right], work: together.beyond(&alone), counts: None })
}

/// Frames of views that are resolved by `resolve`, the left one first.
fn frames(prepared: &Prepared, resolve: impl Fn(&Surfaces) -> Vec<Items>) -> Vec<Frame> {
    // Only scenes that can be drawn are timed.
    let Ok(surfaces) = surfaces(prepared) else { return Vec::new() };
    let items = resolve(&surfaces);
    items.iter().zip(Eye::BOTH).map(|(items, eye)| surfaces.frame(items, eye)).collect()
}

/// The right view, warped from the left one.
fn warp(prepared: &Prepared, left: &Frame, meter: &mut impl Meter) -> Warped {
    let disparity = Disparity::new(&prepared.scene.rig, Eye::Left);
    warping::other_eye(left, Eye::Left, &disparity, prepared.job().background, meter)
}

/// Both views by a system.
fn both(job: &Job, minimal: bool) -> Vec<Frame> {
    job.derived(minimal).0.eyes.to_vec()
}

/// The left view alone by a system.
fn first(prepared: &Prepared, minimal: bool) -> Vec<Frame> {
    alone(prepared, Eye::Left, minimal).0.eyes.to_vec()
}

/// One view alone by a system, which draws all polygons monocular then.
fn alone(prepared: &Prepared, eye: Eye, minimal: bool) -> (Frames, Counts) {
    let seen = prepared.geometry.polygons.iter().filter(|p| p.eyes.contains(eye));
    let only = |p: &Polygon| Polygon { eyes: Eyes::One(eye), ..p.clone() };
    let polygons: Vec<Polygon> = seen.map(only).collect();
    Job { polygons: &polygons, ..prepared.job() }.derived(minimal)
}

/// Both views by a system; the beats of the second are those that the first alone would not take.
fn mapped(prepared: &Prepared, minimal: bool) -> Pair {
    let (frames, counts) = prepared.job().derived(minimal);
    let (_, left) = alone(prepared, Eye::Left, minimal);
    let work = Work {
        beats: counts.beats().saturating_sub(left.beats()),
        pixels_written: frames.written[Eye::Right as usize],
        ..Work::default()
    };
    Pair { frames: frames.eyes, work, counts: Some(counts) }
}
