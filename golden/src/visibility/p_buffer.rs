//! P-buffer: a buffer of polygon ids beside the z-buffer tells which polygons a view shows, and the
//! next view is drawn from these alone (Heo, Jung and Wohn 1998, section IV).
//!
//! 1. The first view goes through the full pipeline; where the depth test passes, the id of the
//!    polygon is stored with its colour.
//! 2. Every polygon whose id is left in the buffer is flagged as visible.
//! 3. The next view, the other eye's or that of a viewer who has moved, is cleared, and the flagged
//!    polygons alone go through the pipeline.
//!
//! The next view is wrong exactly where it should show a polygon that was hidden in the first one.

use super::model::Model;
use super::z_buffer::ZBuffer;
use crate::direct::Direct;
use crate::formats::{Eye, Formats};
use crate::frame::{Frame, NO_ID};
use crate::stereo::{pieces, Job};
use crate::work::{Meter, Operations};

/// The polygons that a view shows.
#[derive(Clone, Debug, Default)]
pub struct Visible {
    flags: Vec<bool>,
    ids: Vec<u32>,
}

impl Visible {
    /// None of this many polygons.
    pub fn new(polygons: usize) -> Visible {
        Visible { flags: vec![false; polygons], ids: Vec::new() }
    }

    /// Flags the polygons of a P-buffer instead of those flagged before. Takes time for every pixel
    /// and every visible polygon, and none for the others.
    pub fn find(&mut self, p_buffer: &[u32], meter: &mut impl Meter) {
        self.ids.drain(..).for_each(|id| self.flags[id as usize] = false);
        meter.note(|work| {
            work.pixels_tested += p_buffer.len() as u64;
            work.fixed_point += Operations::comparisons(p_buffer.len() as u64);
        });
        let mut last = NO_ID;
        for &id in p_buffer {
            // Neighbours are mostly of one polygon.
            if id == last {
                continue;
            }
            last = id;
            if let Some(flag) = self.flags.get_mut(id as usize).filter(|flag| !**flag) {
                *flag = true;
                self.ids.push(id);
            }
        }
        // Drawn in the order of the first view, so that ties of depth end alike.
        self.ids.sort_unstable();
    }

    /// True if a polygon is visible.
    pub fn contains(&self, id: u32) -> bool {
        self.flags.get(id as usize).is_some_and(|&flag| flag)
    }

    /// The visible polygons, in the order of their ids.
    pub fn ids(&self) -> &[u32] {
        &self.ids
    }
}

/// Draws the first view into a cleared z-buffer and finds its visible polygons.
pub fn first_view(
    model: &Model,
    view: &mut ZBuffer,
    visible: &mut Visible,
    meter: &mut impl Meter,
) {
    view.draw_all::<true>(model, meter);
    visible.find(&view.frame.id, meter);
}

/// Draws the next view into a cleared z-buffer, from visible polygons alone; with `IDS` it is a
/// P-buffer itself.
pub fn next_view<const IDS: bool>(
    model: &Model,
    view: &mut ZBuffer,
    visible: &Visible,
    meter: &mut impl Meter,
) {
    for piece in visible.ids().iter().flat_map(|&id| model.polygon(id)) {
        view.draw::<IDS>(piece, model.corners(piece), meter);
    }
}

/// The other eye's view of polygons that setup takes, drawn directly from those that the first view
/// shows; the first view is `from`'s, drawn directly. A polygon behind a translucent one counts as hidden.
pub fn other_eye(job: &Job, first: &Frame, from: Eye, meter: &mut impl Meter) -> Frame {
    let formats = Formats::new(&job.config);
    let direct = Direct { formats, textures: job.textures, lookup: job.lookup };
    let most = job.polygons.iter().map(|polygon| polygon.id + 1).max().unwrap_or(0);
    let mut visible = Visible::new(most as usize);
    visible.find(&first.id, meter);
    let mut frame = Frame::new(job.width, job.height, job.background);
    for polygon in pieces(job.polygons).filter(|polygon| visible.contains(polygon.id)) {
        direct.draw_metered(&polygon, from.other(), &mut frame, meter);
    }
    frame
}
