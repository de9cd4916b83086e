//! A way to make the second view.

use crate::prepared::Prepared;
use std::time::Duration;
use thiserror::Error;
use wheatstone_golden::frame::Frame;
use wheatstone_golden::primary::Counts;
use wheatstone_golden::work::Work;

/// A way to make the second view.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// Its name in tables and of its error picture.
    pub name: &'static str,
    /// A line for the user while it runs.
    pub description: &'static str,
    /// Which views can be wrong.
    pub judged: Judged,
    /// Makes what must be made beforehand, which is not part of what is timed, and tells how long that
    /// takes.
    pub preparation: Option<fn(&Prepared) -> Duration>,
    /// Draws both views and counts.
    pub draw: fn(&Prepared) -> Result<Pair, Unsuited>,
    /// The code that is timed.
    pub timed: Timed,
}

/// The views that a method makes, and that are held against direct rendering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judged {
    /// The right one: the left one is drawn directly.
    Right,
    /// Both: by one pass, or polygon by polygon the one from the other.
    Both,
}

impl Judged {
    /// Its name in tables and reports.
    pub fn name(self) -> &'static str {
        match self {
            Judged::Right => "right",
            Judged::Both => "both",
        }
    }
}

/// Both views, and what the second one took.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Left and right frame, in view coordinates.
    pub frames: [Frame; 2],
    /// Work for the second view.
    pub work: Work,
    /// Statistics of the polygons by the way in which they were drawn, of a method that derives.
    pub counts: Option<Counts>,
}

/// Code of a method that is timed, without counting. Only scenes that [`Method::draw`] can draw come here.
#[derive(Clone, Copy, Debug)]
pub enum Timed {
    /// The right view, from polygons and from the left view as it was drawn directly.
    Second(fn(&Prepared, &Frame) -> Frame),
    /// Both views at once, less the left one by the same code.
    Both {
        /// Both views.
        both: fn(&Prepared) -> Vec<Frame>,
        /// The left view alone.
        first: fn(&Prepared) -> Vec<Frame>,
    },
}

/// A scene that a method cannot draw.
#[derive(Clone, Debug, Error)]
#[error("{0}")]
pub struct Unsuited(pub String);
