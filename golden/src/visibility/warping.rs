//! Image warping: the next view from the pixels of the first, each moved to where it is seen from
//! there. The baseline of the P-buffer (Heo, Jung and Wohn 1998, section III.2).
//!
//! Three things go wrong (figure 4 there): several pixels may fall on one (*overlap*), none may (*hole*), and
//! a pixel of something that should be hidden may show through where what hides it has been
//! stretched (*bad pixel*). The first is solved: between the eyes a pixel of the right view
//! moves the farther to the right the nearer it is, so that of those that fall on one place in
//! the left view the leftmost is the nearest, and whoever moves them from right to left and
//! overwrites ends with it. The rest is counted here.

use super::view::View;
use crate::formats::Eye;
use crate::frame::{Frame, NO_ID};
use crate::picture::{Rgb, RgbImage};
use crate::work::{Meter, Operations};

pub use super::disparity::Disparity;

/// A view made by warping.
#[derive(Clone, Debug)]
pub struct Warped {
    /// The warped frame; holes show the background.
    pub frame: Frame,
    /// Number of pixels that fell on each place, up to 255.
    pub sources: Vec<u8>,
}

impl Warped {
    fn new(source: &Frame, background: [u8; 3]) -> Warped {
        let frame = Frame::new(source.width, source.height, background);
        Warped { sources: vec![0; frame.id.len()], frame }
    }

    #[inline]
    fn put(&mut self, at: usize, source: &Frame, from: usize, depth: u32) {
        self.frame.colour[at] = source.colour[from];
        self.frame.depth[at] = depth;
        self.frame.id[at] = source.id[from];
    }

    /// Moves the pixels of a row, which begins at an index, within it: from right to left for the
    /// left view, from left to right for the right one.
    fn move_row(
        &mut self,
        source: &Frame,
        row: usize,
        from: Eye,
        disparity: &Disparity,
        meter: &mut impl Meter,
    ) {
        let width = source.width as usize;
        for n in 0..width {
            let x = if from == Eye::Right { width - 1 - n } else { n };
            let depth = source.depth[row + x];
            meter.note(|work| work.fixed_point += disparity.operations(depth));
            let target = x as i64 + disparity.rounded(depth);
            if (0..width as i64).contains(&target) {
                let at = row + target as usize;
                self.sources[at] = self.sources[at].saturating_add(1);
                self.put(at, source, row + x, depth);
                meter.note(|work| work.pixels_written += 1);
            }
        }
    }

    /// Moves the pixels of a row, which begins at an index, to where they are nearer than what is there.
    fn move_row_by_depth(
        &mut self,
        source: &Frame,
        row: usize,
        disparity: &Disparity,
        meter: &mut impl Meter,
    ) {
        let width = source.width as usize;
        for x in 0..width {
            let depth = source.depth[row + x];
            meter.note(|work| work.fixed_point += disparity.operations(depth));
            let [right, down] = disparity.both_rounded(depth);
            let target = [x as i64 + right, (row / width) as i64 + down];
            let Some(at) = self.frame.index(target[0], target[1]) else { continue };
            let first = self.sources[at] == 0;
            self.sources[at] = self.sources[at].saturating_add(1);
            meter.note(|work| {
                work.depth_tests += 1;
                work.fixed_point += Operations::comparisons(1);
            });
            if first || depth < self.frame.depth[at] {
                self.put(at, source, row + x, depth);
                meter.note(|work| work.pixels_written += 1);
            }
        }
    }
}

/// The other eye's view from that of `from`: by overwriting in the order that leaves the nearest pixel,
/// or where there is none ([`Disparity::is_ordered`]) by a depth test. What has been left empty in the
/// source moves as the far plane does.
pub fn other_eye(
    source: &Frame,
    from: Eye,
    disparity: &Disparity,
    background: [u8; 3],
    meter: &mut impl Meter,
) -> Warped {
    let mut warped = Warped::new(source, background);
    let width = source.width as usize;
    for row in (0..source.id.len()).step_by(width.max(1)) {
        if disparity.is_ordered() {
            warped.move_row(source, row, from, disparity, meter);
        } else {
            warped.move_row_by_depth(source, row, disparity, meter);
        }
    }
    meter.note(|work| work.pixels_tested += source.id.len() as u64);
    warped
}

/// The view of a viewer who has moved, by reprojection of every pixel; a depth test decides
/// between pixels that fall on one place.
pub fn moved(
    source: &Frame,
    from: &View,
    to: &View,
    background: [u8; 3],
    meter: &mut impl Meter,
) -> Warped {
    let mut warped = Warped::new(source, background);
    let map = from.onto(to);
    let width = source.width as usize;
    for (index, &depth) in source.depth.iter().enumerate() {
        let [x, y] = [index % width, index / width].map(|n| n as f64 + 0.5);
        let Some([x, y, inverse]) = map.at(x, y, from.inverse_distance(depth)) else { continue };
        let Some(at) = warped.frame.index(x.floor() as i64, y.floor() as i64) else { continue };
        let depth = to.depth_of_inverse(inverse);
        let first = warped.sources[at] == 0;
        warped.sources[at] = warped.sources[at].saturating_add(1);
        meter.note(|work| work.depth_tests += 1);
        if first || depth < warped.frame.depth[at] {
            warped.put(at, source, index, depth);
            meter.note(|work| work.pixels_written += 1);
        }
    }
    meter.note(|work| work.pixels_tested += source.id.len() as u64);
    warped
}

/// The fault of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Nothing was moved there.
    Hole,
    /// It shows another polygon than it should, one that is seen nowhere around it: something hidden
    /// shows through, or something has been left standing.
    SeeThrough,
    /// It shows another polygon than it should, which a neighbour should show: an edge has been moved
    /// by a fraction of a pixel.
    Edge,
}

/// Pixels by what is wrong with them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// All pixels of the view.
    pub pixels: usize,
    /// Pixels that more than one fell on; right or wrong.
    pub overlaps: usize,
    /// Pixels that none fell on.
    pub holes: usize,
    /// Pixels of a wrong polygon, far from where it should be.
    pub see_through: usize,
    /// Pixels of a wrong polygon, at its edge.
    pub edges: usize,
}

impl Faults {
    /// Pixels of a wrong polygon.
    pub fn bad(&self) -> usize {
        self.see_through + self.edges
    }

    /// Wrong pixels: holes and bad ones.
    pub fn wrong(&self) -> usize {
        self.holes + self.bad()
    }

    /// A number of pixels as a part of all, in per cent.
    pub fn percent(&self, pixels: usize) -> f64 {
        100.0 * pixels as f64 / self.pixels.max(1) as f64
    }
}

impl Warped {
    /// The fault of the pixel at `index`, if it is wrong; `truth` is the view drawn directly.
    pub fn fault(&self, truth: &Frame, index: usize) -> Option<Fault> {
        let id = self.frame.id[index];
        if self.sources[index] == 0 {
            return Some(Fault::Hole);
        }
        if id == truth.id[index] {
            return None;
        }
        let width = truth.width as usize;
        let [x, y] = [index % width, index / width].map(|n| n as i64);
        let mut around = (-1..=1).flat_map(|j| (-1..=1).map(move |i| [x + i, y + j]));
        let beside = around.any(|[x, y]| truth.index(x, y).is_some_and(|at| truth.id[at] == id));
        Some(if beside { Fault::Edge } else { Fault::SeeThrough })
    }

    /// Counts what is wrong, where `truth` is the view drawn directly.
    pub fn faults(&self, truth: &Frame) -> Faults {
        let mut faults = Faults { pixels: truth.id.len(), ..Faults::default() };
        for (index, &sources) in self.sources.iter().enumerate() {
            faults.overlaps += usize::from(sources > 1);
            match self.fault(truth, index) {
                Some(Fault::Hole) => faults.holes += 1,
                Some(Fault::SeeThrough) => faults.see_through += 1,
                Some(Fault::Edge) => faults.edges += 1,
                None => {}
            }
        }
        faults
    }

    /// The view in faint grey with its faults in colour: holes black, see-through red, edges blue; right
    /// pixels that several fell on are green.
    pub fn fault_picture(&self, truth: &Frame) -> RgbImage {
        RgbImage::from_fn(truth.width, truth.height, |x, y| {
            let index = (y * truth.width + x) as usize;
            match self.fault(truth, index) {
                Some(Fault::Hole) => Rgb([0; 3]),
                Some(Fault::SeeThrough) => Rgb([214, 40, 40]),
                Some(Fault::Edge) => Rgb([30, 90, 200]),
                None if self.sources[index] > 1 => Rgb([40, 160, 80]),
                None => faint(truth.colour[index]),
            }
        })
    }
}

/// Pixels that show another polygon than they should.
pub fn wrong_pixels(frame: &Frame, truth: &Frame) -> usize {
    frame.id.iter().zip(&truth.id).filter(|(ours, theirs)| ours != theirs).count()
}

/// A view in faint grey with the pixels of wrong polygons in red, and in black where nothing is shown
/// that should be.
pub fn wrong_picture(frame: &Frame, truth: &Frame) -> RgbImage {
    RgbImage::from_fn(truth.width, truth.height, |x, y| {
        let index = (y * truth.width + x) as usize;
        match frame.id[index] {
            id if id == truth.id[index] => faint(truth.colour[index]),
            NO_ID => Rgb([0; 3]),
            _ => Rgb([214, 40, 40]),
        }
    })
}

fn faint(colour: [u8; 3]) -> Rgb<u8> {
    let sum: u16 = colour.iter().map(|&n| u16::from(n)).sum();
    Rgb([(170 + sum / 9) as u8; 3])
}
