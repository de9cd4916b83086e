//! A walk through the office: from each frame to the next by P-buffer and by warping.

use super::measure::Office;
use wheatstone_golden::scene::vector::turn;
use wheatstone_golden::scene::SceneError;
use wheatstone_golden::visibility::warping::wrong_pixels;
use wheatstone_golden::visibility::Pose;

/// Frames after the first one.
const FRAMES: usize = 60;
/// Frames in which the viewer looks once to either side.
const PERIOD: f64 = 40.0;

/// Wrong pixels on the way, in per cent, frame by frame.
#[derive(Clone, Debug, Default)]
pub struct Walk {
    /// P-buffer, its visible polygons from the frame before, drawn in full.
    pub p_buffer: Vec<f64>,
    /// Warping of the frame before, drawn in full.
    pub warping: Vec<f64>,
    /// P-buffer, its visible polygons from the frame before as the P-buffer drew it: only the very first
    /// frame is drawn in full.
    pub chained: Vec<f64>,
}

/// Position and direction of the viewer at a frame: 20 cm a step along the aisle, turned up to 18 degrees to either
/// side, at most 2.8 degrees farther each step.
fn pose(frame: usize) -> Pose {
    let frame = frame as f64;
    let [_, sine] = turn(frame / PERIOD);
    Pose { moved: [0.1 * sine, 0.0, 0.2 * frame], turned: 18.0 * sine }
}

/// Walks through an office of this many rooms.
pub fn walk(rooms: usize) -> Result<Walk, SceneError> {
    let office = Office::of_rooms(rooms)?;
    let mut walk = Walk::default();
    let mut chained = office.full(office.view(&pose(0)));
    for frame in 1..=FRAMES {
        let step = office.moved(&pose(frame - 1), &pose(frame));
        let [p_buffer, warping] = step.percent();
        walk.p_buffer.push(p_buffer);
        walk.warping.push(warping);
        chained = office.from_visible(&chained, office.view(&pose(frame)));
        let wrong = wrong_pixels(&chained, &step.truth);
        walk.chained.push(100.0 * wrong as f64 / chained.id.len() as f64);
    }
    Ok(walk)
}
