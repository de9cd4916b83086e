//! The methods that are compared.

use super::{Method, Pair, Timed, Unsuited};
use crate::prepared::Prepared;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, Frames};
use wheatstone_golden::primary::Counts;
use wheatstone_golden::projection::Kind;
use wheatstone_golden::setup::{Eyes, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::visibility::p_buffer;
use wheatstone_golden::visibility::warping::{self, Disparity, Warped};
use wheatstone_golden::visibility::{bsp, scan_line, Items, Surfaces};
use wheatstone_golden::work::{counted, Counted, Meter, Real, Unmetered, Work};

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
            // What a second pass of the pixel pipeline would take.
            work.beats = alone(prepared, Eye::Right, false).1.beats();
            Ok(Pair { frames: [left, right], work, holes: None })
        },
        timed: Timed::Second(|prepared, _| prepared.job().view(Eye::Right, &mut Unmetered)),
    },
    Method {
        name: "warping",
        description: "pixels of the first view moved by their disparity",
        draw: |prepared| {
            let mut work = Work::default();
            let job = prepared.job();
            let left = job.view(Eye::Left, &mut Unmetered);
            let warped = warp(prepared, &left, &mut work)?;
            let holes = warped.sources.iter().filter(|&&sources| sources == 0).count() as u64;
            Ok(Pair { frames: [left, warped.frame], work, holes: Some(holes) })
        },
        timed: Timed::Second(|prepared, left| match warp(prepared, left, &mut Unmetered) {
            Ok(warped) => warped.frame,
            // Only scenes that can be drawn are timed.
            Err(_) => left.clone(),
        }),
    },
    Method {
        name: "p-buffer",
        description: "the polygons that the first view shows, drawn for the second",
        draw: |prepared| {
            let mut work = Work::default();
            let job = prepared.job();
            let left = job.view(Eye::Left, &mut Unmetered);
            let right = p_buffer::other_eye(&job, &left, Eye::Left, &mut work);
            Ok(Pair { frames: [left, right], work, holes: None })
        },
        timed: Timed::Second(|prepared, left| {
            p_buffer::other_eye(&prepared.job(), left, Eye::Left, &mut Unmetered)
        }),
    },
    Method {
        name: "scan-line",
        description: "scan-line hidden surfaces of both views at once",
        draw: |prepared| simultaneous(prepared, scanned::<Counted, _>, scanned_first::<Counted, _>),
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
        draw: |prepared| {
            let polygons = prepared.geometry.polygons.len();
            if polygons > LARGEST_TREE {
                let most = format!(
                    "expected at most {LARGEST_TREE} polygons for a tree, found {polygons}"
                );
                return Err(Unsuited(most));
            }
            simultaneous(prepared, painted, painted_first)
        },
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

/// Most polygons of a BSP tree: the time to build one grows with their square.
const LARGEST_TREE: usize = 20_000;

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

/// Both views at once, and the work that they take more than the left one by the same code.
fn simultaneous(
    prepared: &Prepared,
    both: impl Fn(&Prepared, &Surfaces, &mut Work) -> [Items; 2],
    first: impl Fn(&Prepared, &Surfaces, &mut Work) -> Items,
) -> Result<Pair, Unsuited> {
    let job = prepared.job();
    let surfaces = Surfaces::new(&job).map_err(|error| Unsuited(error.to_string()))?;
    let (mut together, mut alone) = (Work::default(), Work::default());
    let (items, done) = counted(|| both(prepared, &surfaces, &mut together));
    together.operations = done;
    (_, alone.operations) = counted(|| first(prepared, &surfaces, &mut alone));
    let frames = Eye::BOTH.map(|eye| surfaces.frame(&items[eye as usize], eye));
    Ok(Pair { frames, work: together.beyond(&alone), holes: None })
}

/// Frames of views that are resolved by `resolve`, the left one first.
fn frames(prepared: &Prepared, resolve: impl Fn(&Surfaces) -> Vec<Items>) -> Vec<Frame> {
    // Only scenes that can be drawn are timed.
    let Ok(surfaces) = Surfaces::new(&prepared.job()) else { return Vec::new() };
    let items = resolve(&surfaces);
    items.iter().zip(Eye::BOTH).map(|(items, eye)| surfaces.frame(items, eye)).collect()
}

/// The right view, warped from the left one.
fn warp(prepared: &Prepared, left: &Frame, meter: &mut impl Meter) -> Result<Warped, Unsuited> {
    let rig = &prepared.scene.rig;
    let moves_pixels_only =
        matches!(rig.projection.kind(), Kind::TwoCentres | Kind::Shear | Kind::Translate)
            && rig.head_tilt == 0.0;
    if !moves_pixels_only {
        return Err(Unsuited("warping knows disparities of level eyes at two centres only".into()));
    }
    let disparity = Disparity::new(rig, Eye::Left);
    Ok(warping::other_eye(left, Eye::Left, &disparity, prepared.job().background, meter))
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
    Pair { frames: frames.eyes, work, holes: None }
}
