//! Cases of a part of a scene.

use super::case::Case;
use super::recorded::{recorded, recorded_unit};
use wheatstone_golden::frame::Frames;
use wheatstone_golden::pipeline::{Edges, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::{Primary, Sink};
use wheatstone_golden::record::{Recording, Tape};
use wheatstone_golden::stereo::{pieces, Job};
use wheatstone_golden::targets::Target;

/// A part of a scene.
pub(crate) struct Part {
    /// The streams of the golden model for it.
    pub recording: Recording,
    /// Frame buffers before and after.
    pub frames: [Frames; 2],
    /// Pieces of polygons in it.
    pub pieces: usize,
}

/// Records the polygons of a scene from the first for which `wanted` holds to the last, or until
/// there are `beats`.
pub(crate) fn part(
    job: &Job,
    minimal: bool,
    wanted: impl Fn(u32) -> bool,
    beats: usize,
) -> Option<Part> {
    let mut tape = Tape::new(job, minimal, true);
    let mut primary = Primary::new(job.planner(minimal), job.textures, job.lookup);
    let last =
        pieces(job.polygons).enumerate().filter(|(_, p)| wanted(p.id)).map(|(n, _)| n).last()?;
    let (mut before, mut drawn) = (None, 0);
    for (n, polygon) in pieces(job.polygons).enumerate().take(last + 1) {
        if before.is_none() && wanted(polygon.id) {
            tape.take();
            before = Some(tape.frames().clone());
        }
        primary.draw(&polygon, tape.sink());
        drawn += usize::from(before.is_some());
        if before.is_some() && tape.len() >= beats && n < last {
            break;
        }
        if before.is_none() {
            // What came before only matters for the frame buffers.
            tape.take();
        }
    }
    let recording = tape.take();
    let after = tape.frames().clone();
    let is_empty = recording.streams["beat"].is_empty();
    before.filter(|_| !is_empty).map(|before| Part {
        recording,
        frames: [before, after],
        pieces: drawn,
    })
}

/// The case of a target in a part of a scene.
pub(crate) fn case_of(target: Target, job: &Job, name: &str, part: &Part) -> Case {
    if !target.is_system() {
        return recorded_unit(target, job, name, &part.recording);
    }
    let mut case = recorded(target, job, name, &part.recording);
    case.memory = Some(Box::new(part.frames.clone()));
    case
}

/// The beginning of a scene.
pub struct Head {
    /// The case of a target in it.
    pub case: Case,
    /// Its polygons, and those of the whole scene, in the order of drawing; a concave one is several.
    pub polygons: [u64; 2],
    /// Beats of the primary pipeline for them, and for the whole scene.
    pub beats: [u64; 2],
}

/// Counts beats and does nothing with them.
struct Counter;

impl Sink for Counter {
    fn polygon(&mut self, _: u32) {}
    fn walk(&mut self, _: &Walk, _: &Planes) {}
    fn records(&mut self, _: &Setup, _: &Edges) {}
    fn beat(&mut self, _: &PrimaryBeat) {}
}

/// The beginning of a scene, about `beats` beats, as a case of a target.
pub fn scene_head(target: Target, job: &Job, name: &str, beats: usize) -> Option<Head> {
    let job = &target.job(job);
    let minimal = target == Target::Minimal;
    let part = part(job, minimal, |_| true, beats)?;
    let beats = part.recording.streams["beat"].len() as u64;
    Some(Head {
        case: case_of(target, job, name, &part),
        polygons: [part.pieces, pieces(job.polygons).count()].map(|n| n as u64),
        beats: [beats, job.run(minimal, &mut Counter).beats()],
    })
}
