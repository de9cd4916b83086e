//! Visible polygons, times and wrong pixels of an office.

use super::published::SIZE;
use crate::timing;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::scene::{builtin, Scene, SceneError};
use wheatstone_golden::visibility::p_buffer::{self, Visible};
use wheatstone_golden::visibility::warping::{self, Disparity, Faults, Warped};
use wheatstone_golden::visibility::z_buffer::ZBuffer;
use wheatstone_golden::visibility::{Model, Pose, View};
use wheatstone_golden::work::{Unmetered, Work};

/// Runs of each piece of code that is timed.
const ROUNDS: usize = 81;
/// Further runs of the view from visible polygons, which takes a fraction of a millisecond.
const SHORT_RUNS: usize = 200;
/// Movements of the viewer in the publication's figures 3 to 7: 20 cm to the left, and three degrees about the y axis;
/// in which direction is not said.
pub const MOVES: [Pose; 2] =
    [Pose { moved: [-0.2, 0.0, 0.0], turned: 3.0 }, Pose { moved: [-0.2, 0.0, 0.0], turned: -3.0 }];

/// A scene with its polygons.
#[derive(Clone, Debug)]
pub struct Office {
    /// The scene.
    pub scene: Scene,
    /// Its polygons.
    pub model: Model,
    /// Views of the left and the right eye.
    pub eyes: [View; 2],
}

/// A view drawn in full, and the next one by every method.
#[derive(Clone, Debug)]
pub struct Step {
    /// The first view.
    pub source: Frame,
    /// The next view by the full pipeline.
    pub truth: Frame,
    /// The next view from visible polygons.
    pub p_buffer: Frame,
    /// The next view from pixels.
    pub warped: Warped,
}

/// Measurements for one number of rooms.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Polygons.
    pub polygons: usize,
    /// Visible polygons of the right view.
    pub visible: usize,
    /// Milliseconds for the right and the left view by the full pipeline.
    pub full: [f64; 2],
    /// Milliseconds for the right view with a P-buffer, and the left one from visible polygons.
    pub p_buffer: [f64; 2],
    /// First view with a P-buffer : without, side by side.
    pub first_ratio: f64,
    /// Work of the left view by the full pipeline and from visible polygons.
    pub work: [Work; 2],
    /// Wrong pixels of the left view from the right one's visible polygons, in per cent.
    pub wrong: f64,
    /// The same by warping.
    pub faults: Faults,
    /// Pixels at which warping by overwriting differs from warping by depth test.
    pub misordered: usize,
    /// Per cent of wrong pixels with P-buffer and warping after each of the [`MOVES`].
    pub moved: [[f64; 2]; 2],
}

impl Office {
    /// An office of this many rooms, or another built-in scene.
    pub fn new(name: &str, size: [u32; 2]) -> Result<Office, SceneError> {
        let scene = builtin::scene(name, size[0], size[1])?;
        let eyes = Eye::BOTH.map(|eye| View::of(&scene, eye));
        Ok(Office { model: Model::new(&scene), scene, eyes })
    }

    /// The office of this many rooms at the publication's size.
    pub fn of_rooms(rooms: usize) -> Result<Office, SceneError> {
        Office::new(&format!("office-{rooms}"), [SIZE; 2])
    }

    /// A cleared frame for a view.
    pub fn buffer(&self, view: View) -> ZBuffer {
        ZBuffer::new(view, self.scene.background)
    }

    /// A view by the full pipeline.
    pub fn full(&self, view: View) -> Frame {
        let mut buffer = self.buffer(view);
        buffer.draw_all::<true>(&self.model, &mut Unmetered);
        buffer.frame
    }

    /// A view from the polygons that another frame shows.
    pub fn from_visible(&self, source: &Frame, view: View) -> Frame {
        let mut visible = Visible::new(self.model.len());
        visible.find(&source.id, &mut Unmetered);
        let mut buffer = self.buffer(view);
        p_buffer::next_view::<true>(&self.model, &mut buffer, &visible, &mut Unmetered);
        buffer.frame
    }

    /// From one view to another; `warp` makes the warped one from the first frame.
    fn step(&self, from: View, to: View, warp: impl FnOnce(&Frame) -> Warped) -> Step {
        let source = self.full(from);
        let p_buffer = self.from_visible(&source, to);
        Step { truth: self.full(to), p_buffer, warped: warp(&source), source }
    }

    /// From the right to the left view.
    pub fn other_eye(&self) -> Step {
        let [left, right] = self.eyes;
        let disparity = Disparity::new(&self.scene.rig, Eye::Right);
        let background = self.scene.background;
        self.step(right, left, |source| {
            warping::other_eye(source, Eye::Right, &disparity, background, &mut Unmetered)
        })
    }

    /// View of a single eye between the two after the viewer has moved.
    pub fn view(&self, pose: &Pose) -> View {
        View::between(&self.scene).at(pose, &self.scene.rig)
    }

    /// From one frame of a moving viewer to the next.
    pub fn moved(&self, from: &Pose, to: &Pose) -> Step {
        let [from, to] = [self.view(from), self.view(to)];
        let background = self.scene.background;
        self.step(from, to, |source| warping::moved(source, &from, &to, background, &mut Unmetered))
    }

    /// All of it.
    pub fn measure(&self) -> Measured {
        let [left, _] = self.eyes;
        let step = self.other_eye();
        let by_depth = by_depth(&step.source, &Disparity::new(&self.scene.rig, Eye::Right));
        let overwritten = &step.warped.frame.id;
        let mut visible = Visible::new(self.model.len());
        visible.find(&step.source.id, &mut Unmetered);
        let [mut full, mut flagged] = [Work::default(); 2];
        self.buffer(left).draw_all::<false>(&self.model, &mut full);
        p_buffer::next_view::<false>(&self.model, &mut self.buffer(left), &visible, &mut flagged);
        let first = self.time_first();
        let next = self.time_next(&visible);
        Measured {
            polygons: self.model.len(),
            visible: visible.ids().len(),
            full: [first.second, next.second].map(milliseconds),
            p_buffer: [first.first, next.first].map(milliseconds),
            first_ratio: first.of_shortest(),
            work: [full, flagged],
            wrong: step.percent()[0],
            faults: step.warped.faults(&step.truth),
            misordered: overwritten.iter().zip(&by_depth).filter(|(a, b)| a != b).count(),
            moved: MOVES.map(|pose| self.moved(&Pose::default(), &pose).percent()),
        }
    }

    /// The right view with a P-buffer beside the same without.
    fn time_first(&self) -> timing::Ratio {
        let [_, right] = self.eyes;
        let [mut with, mut without] = [right; 2].map(|view| self.buffer(view));
        let mut visible = Visible::new(self.model.len());
        timing::ratio(
            ROUNDS,
            || {
                with.clear::<true>(right, self.scene.background);
                p_buffer::first_view(&self.model, &mut with, &mut visible, &mut Unmetered);
            },
            || {
                without.clear::<false>(right, self.scene.background);
                without.draw_all::<false>(&self.model, &mut Unmetered);
            },
        )
    }

    /// The left view from visible polygons beside the same by the full pipeline.
    fn time_next(&self, visible: &Visible) -> timing::Ratio {
        let [left, _] = self.eyes;
        let [mut some, mut all] = [left; 2].map(|view| self.buffer(view));
        let mut next = || {
            some.clear::<false>(left, self.scene.background);
            p_buffer::next_view::<false>(&self.model, &mut some, visible, &mut Unmetered);
        };
        let both = timing::ratio(ROUNDS, &mut next, || {
            all.clear::<false>(left, self.scene.background);
            all.draw_all::<false>(&self.model, &mut Unmetered);
        });
        timing::Ratio { first: both.first.min(timing::shortest(SHORT_RUNS, next)), ..both }
    }
}

impl Step {
    /// Wrong pixels of the P-buffer's and of the warped view, in per cent.
    pub fn percent(&self) -> [f64; 2] {
        let faults = self.warped.faults(&self.truth);
        let wrong = warping::wrong_pixels(&self.p_buffer, &self.truth);
        [wrong, faults.wrong()].map(|n| faults.percent(n))
    }
}

/// Ids of the other eye's view by warping in any order with a depth test: the nearest of the pixels
/// that fall on a place.
pub fn by_depth(source: &Frame, disparity: &Disparity) -> Vec<u32> {
    let width = i64::from(source.width);
    let mut nearest = vec![(u32::MAX, NO_ID); source.id.len()];
    for (n, &depth) in source.depth.iter().enumerate() {
        let column = n as i64 % width;
        let target = column + disparity.rounded(depth);
        if (0..width).contains(&target) {
            let place = &mut nearest[(n as i64 - column + target) as usize];
            if depth < place.0 {
                *place = (depth, source.id[n]);
            }
        }
    }
    nearest.into_iter().map(|(_, id)| id).collect()
}

fn milliseconds(time: std::time::Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
