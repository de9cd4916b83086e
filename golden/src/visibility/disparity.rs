//! Disparity: offset from a pixel of one eye's view to its place in the other's, as a function of depth.
//!
//! Every projection shows a point at ppu·(F·(p ± P)/w ± V), + for the left eye, w its distance from
//! the plane of the eyes and P and V along the line of the eyes, in each partition their own
//! (`docs/projections.md`; POT and VPT of NASA 1992, appendices A and B). So the right eye sees it
//! by −2·ppu·(F·P/w + V) further along that line, which is affine in 1/w and thus in depth.

use crate::formats::{Eye, DEPTH_MAX};
use crate::projection::Range;
use crate::scene::vector::turn;
use crate::scene::Rig;
use crate::work::Operations;

/// Fraction bits of a disparity.
const FRACTION: u32 = 40;

/// Position in the other eye's view less that in one eye's, as a function of depth.
#[derive(Clone, Debug)]
pub struct Disparity {
    /// Of each partition, the nearest first.
    stretches: Vec<Stretch>,
    /// True if both eyes see every point in the same row.
    level: bool,
    ordered: bool,
}

/// Depths with one affine function.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// The greatest of them.
    last: u32,
    /// To the right and down.
    axes: [Affine; 2],
}

/// In pixels with [`FRACTION`] bits.
#[derive(Clone, Copy, Debug)]
struct Affine {
    /// At the near plane, depth 0.
    near: i64,
    /// Change for one unit of depth.
    slope: i64,
}

impl Affine {
    #[inline]
    fn at(&self, depth: u32) -> i64 {
        self.near + self.slope * i64::from(depth)
    }

    /// To the nearest pixel, halves upward.
    #[inline]
    fn rounded(&self, depth: u32) -> i64 {
        (self.at(depth) + (1 << (FRACTION - 1))) >> FRACTION
    }
}

impl Disparity {
    /// Of a rig that passed [`Rig::check`], from one eye's view to the other's.
    pub fn new(rig: &Rig, from: Eye) -> Disparity {
        let inverse = [rig.near(), rig.far()].map(|w| 1.0 / w);
        let unit = (inverse[0] - inverse[1]) / f64::from(DEPTH_MAX);
        let depth = |w: f64| (inverse[0] - 1.0 / w) / unit;
        let ranges = rig.ranges();
        let mut stretches: Vec<Stretch> = ranges
            .iter()
            .map(|range| Stretch {
                last: depth(range.far).round_ties_even() as u32,
                axes: axes(rig, range, from).map(|[scale, constant]| {
                    // No picture is that wide; sums stay within their bits.
                    let near = (scale * inverse[0]).clamp(-1e6, 1e6);
                    let slope = -near * (unit / inverse[0]);
                    Affine { near: fixed(near + constant.clamp(-1e6, 1e6)), slope: fixed(slope) }
                }),
            })
            .collect();
        if let Some(farthest) = stretches.last_mut() {
            farthest.last = u32::MAX;
        }
        let level = stretches.iter().all(|s| s.axes[1].near == 0 && s.axes[1].slope == 0);
        let upright = |slope: i64| if from == Eye::Left { slope >= 0 } else { slope <= 0 };
        let ordered = level && stretches.len() == 1 && upright(stretches[0].axes[0].slope);
        Disparity { stretches, level, ordered }
    }

    #[inline]
    fn stretch(&self, depth: u32) -> &Stretch {
        // The last one takes all.
        let found = self.stretches.iter().find(|stretch| depth <= stretch.last);
        found.unwrap_or(&self.stretches[0])
    }

    /// To the right at a depth, in pixels.
    pub fn at(&self, depth: u32) -> f64 {
        self.both_at(depth)[0]
    }

    /// To the right and down at a depth, in pixels.
    pub fn both_at(&self, depth: u32) -> [f64; 2] {
        self.stretch(depth).axes.map(|axis| axis.at(depth) as f64 / (1i64 << FRACTION) as f64)
    }

    /// To the right, to the nearest pixel, halves upward.
    #[inline]
    pub fn rounded(&self, depth: u32) -> i64 {
        self.stretch(depth).axes[0].rounded(depth)
    }

    /// To the right and down, to the nearest pixel each, halves upward.
    #[inline]
    pub fn both_rounded(&self, depth: u32) -> [i64; 2] {
        self.stretch(depth).axes.map(|axis| axis.rounded(depth))
    }

    /// True if of two pixels of a row that meet in the other view the nearer one comes from the side that
    /// [`other_eye`](super::warping::other_eye) scans last: the head is upright, and there are no partitions, between
    /// which disparity may jump.
    pub fn is_ordered(&self) -> bool {
        self.ordered
    }

    /// Operations to move a pixel at a depth: choosing the partition, the disparity, the sum with the place and a look
    /// at the ends of the window, for each direction that pixels move in.
    #[inline]
    pub fn operations(&self, depth: u32) -> Operations {
        let directions = if self.level { 1 } else { 2 };
        let passed = self.stretches.iter().take_while(|stretch| depth > stretch.last).count();
        // The last partition needs no comparison to be chosen.
        let chosen = (passed + 1).min(self.stretches.len() - 1);
        Operations {
            additions: 2 * directions,
            multiplications: directions,
            divisions: 0,
            comparisons: 2 * directions + chosen as u64,
        }
    }
}

/// Factor of 1/w and constant part of a range's disparity, to the right and down.
fn axes(rig: &Rig, range: &Range, from: Eye) -> [[f64; 2]; 2] {
    let viewer = rig.viewer();
    let apart = if from == Eye::Left { -2.0 } else { 2.0 } * rig.pixels_per_unit;
    let scale = apart * viewer.screen_distance * viewer.projection_offset(&range.map);
    let constant = apart * viewer.viewport_offset(&range.map);
    let [across, up] = turn(rig.head_tilt / 360.0);
    [across, -up].map(|part| [scale * part, constant * part])
}

fn fixed(n: f64) -> i64 {
    (n * (1i64 << FRACTION) as f64).round_ties_even() as i64
}
