//! Horizontal fields of view of two eyes before a screen (NASA 1992, figure 5 and table I).

/// Clipping of each view at the sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clipping {
    /// As far to one side of the eye as the nearer edge of the screen is on the other: part of the
    /// screen stays blank.
    Symmetric,
    /// At the edges of the screen.
    Asymmetric,
}

/// A screen and the eyes before its middle, in any unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Width, W.
    pub width: f64,
    /// Distance from the eyes, SD.
    pub distance: f64,
    /// Distance between the eyes, IPD; less than the width.
    pub eye_distance: f64,
}

/// Angles at which the eyes see a plane parallel to the screen, in degrees as seen from half-way between them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FieldOfView {
    /// Angle that one eye alone sees at the left.
    pub left: f64,
    /// Angle that both eyes see; negative if there is a gap between their fields.
    pub stereo: f64,
    /// Angle that one eye alone sees at the right.
    pub right: f64,
}

impl FieldOfView {
    /// Angle from one end to the other: all that any eye sees, and what lies between.
    pub fn total(&self) -> f64 {
        self.left + self.stereo + self.right
    }
}

impl Screen {
    /// The field of view at a perceived distance, which may be infinite (NASA 1992, table I).
    ///
    /// An eye at ∓IPD/2 looks through point X of the screen at the angle whose tangent, seen from the
    /// middle, is (X ± IPD/2)/SD ∓ IPD/(2d). Nearer than [`Screen::nearest`] the eyes' fields part, and
    /// the gap counts as negative stereo.
    pub fn field_of_view(&self, clipping: Clipping, distance: f64) -> FieldOfView {
        let (half, a) = (self.width / 2.0, self.eye_distance / 2.0);
        // What the left eye sees of the screen; the right eye sees the mirror image.
        let right_end = match clipping {
            Clipping::Symmetric => half - 2.0 * a,
            Clipping::Asymmetric => half,
        };
        let angle = |x: f64| ((x + a) / self.distance - a / distance).atan().to_degrees();
        let [first, last] = [angle(-half), angle(right_end)];
        // The right eye's field is -last to -first.
        let (left, right) = (first.max(-last), last.min(-first));
        FieldOfView {
            left: left - first.min(-last),
            stereo: right - left,
            right: last.max(-first) - right,
        }
    }

    /// The nearest distance at which both eyes see any point together ("nearest" of NASA 1992, table I):
    /// a·SD/(h + a) with asymmetric, a·SD/(h − a) with symmetric clipping, a = IPD/2, h = W/2.
    pub fn nearest(&self, clipping: Clipping) -> f64 {
        let (half, a) = (self.width / 2.0, self.eye_distance / 2.0);
        match clipping {
            Clipping::Symmetric => a * self.distance / (half - a),
            Clipping::Asymmetric => a * self.distance / (half + a),
        }
    }
}
