//! The two eyes and the screen.

use super::vector::{turn, Vec3};
use crate::formats::Eye;
use crate::frame::Scissor;
use crate::projection::{check_length, Projection, Range, RigError, Viewer, Viewing};

/// 1 for the left and -1 for the right eye: the sign of the disparity that depth subtracts.
pub(super) fn side(eye: Eye) -> f64 {
    match eye {
        Eye::Left => 1.0,
        Eye::Right => -1.0,
    }
}

/// Positions of the eyes and size of the screen; lengths are in the scene's own unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// Pixels to a unit of length on the screen, the plane z = 0.
    pub pixels_per_unit: f64,
    /// Distance between the eyes, e; more than 0.
    pub eye_separation: f64,
    /// Distance from the eyes to the screen, d.
    pub viewing_distance: f64,
    /// Distance from the eyes to the near plane; where not given, the projection's, or else d/100.
    pub near: Option<f64>,
    /// Distance from the eyes to the far plane; where not given, the projection's, or else 100 d.
    pub far: Option<f64>,
    /// Tilt of the head in degrees: how far the right eye is turned up about the middle of the
    /// head. The screen stays upright.
    pub head_tilt: f64,
    /// Map from the scene to the screen.
    pub projection: Projection,
}

impl Default for Rig {
    /// A viewer at a desk: centimetres, eyes 6.5 apart and 60 from a screen of 20 pixels a
    /// centimetre (640 × 480 pixels are 32 × 24 cm).
    fn default() -> Rig {
        Rig {
            pixels_per_unit: 20.0,
            eye_separation: 6.5,
            viewing_distance: 60.0,
            near: None,
            far: None,
            head_tilt: 0.0,
            projection: Projection::TwoCentres,
        }
    }
}

impl Rig {
    /// Distance from the eyes to the near plane.
    pub fn near(&self) -> f64 {
        let projected = || self.projection.near(&self.viewing());
        self.near.or_else(projected).unwrap_or(self.viewing_distance / 100.0)
    }

    /// Distance from the eyes to the far plane.
    pub fn far(&self) -> f64 {
        let projected = || self.projection.far(&self.viewing());
        self.far.or_else(projected).unwrap_or(self.viewing_distance * 100.0)
    }

    /// The values that its projection needs.
    fn viewing(&self) -> Viewing {
        Viewing {
            eye_separation: self.eye_separation,
            viewing_distance: self.viewing_distance,
            far: self.far,
            head_tilt: self.head_tilt,
        }
    }

    /// The eyes and the screen, as the projection sees them.
    pub fn viewer(&self) -> Viewer {
        self.projection.viewer(&self.viewing())
    }

    /// The ranges of distances that are projected, the nearest first. The rig is one that passed [`Rig::check`].
    pub fn ranges(&self) -> Vec<Range> {
        self.projection.ranges(&self.viewing(), [self.near(), self.far()])
    }

    /// Refuses values that nothing can be projected with.
    pub fn check(&self) -> Result<(), RigError> {
        check_length("pixels_per_unit", self.pixels_per_unit)?;
        check_length("viewing_distance", self.viewing_distance)?;
        check_length("eye_separation", self.eye_separation)?;
        if !(-180.0..=180.0).contains(&self.head_tilt) {
            let expected = "an angle from -180 to 180 degrees";
            return Err(RigError::new("head_tilt", expected, self.head_tilt));
        }
        self.projection.check(&self.viewing())?;
        self.check_planes()
    }

    /// Refuses a viewing distance of which the planes that follow from it are beyond any length.
    fn check_derived_planes(&self) -> Result<(), RigError> {
        let projected = self.projection.near(&self.viewing()).is_some();
        let near = self.near.is_none() && !projected;
        let far = self.far.is_none() && self.projection.far(&self.viewing()).is_none();
        for (derived, plane, field, part) in [
            (near, self.near(), "near", "a hundredth of it"),
            (far, self.far(), "far", "a hundred times it"),
        ] {
            if let (true, Err(error)) = (derived, check_length(field, plane)) {
                let expected = format!("one with {field}, {part}, {}", error.expected);
                return Err(RigError::new("viewing_distance", expected, self.viewing_distance));
            }
        }
        Ok(())
    }

    /// Refuses near and far planes with nothing between them that could be projected.
    fn check_planes(&self) -> Result<(), RigError> {
        self.check_derived_planes()?;
        check_length("near", self.near())?;
        check_length("far", self.far())?;
        // Closer to the eyes, z + d is all rounding.
        let least = self.viewing_distance / 1e6;
        if self.near() < least {
            let expected = format!("at least a millionth of viewing_distance, {least:e}");
            return Err(RigError::new("near", expected, self.near()));
        }
        if let (Some(near), None) = (self.near, self.far) {
            if self.far() <= near {
                let expected = format!("less than far, which is {}", self.far());
                return Err(RigError::new("near", expected, near));
            }
        }
        if self.far() <= self.near() {
            let expected = format!("more than near, which is {}", self.near());
            return Err(RigError::new("far", expected, self.far()));
        }
        if self.ranges().is_empty() {
            let expected = format!("a partition between near and far, {}", self.far());
            return Err(RigError::new("near", expected, self.near()));
        }
        Ok(())
    }

    /// The columns of each view that are drawn, of `width`.
    ///
    /// With symmetric clipping the left eye, at −e/2, sees from the left edge of the screen, −h, to
    /// h − e, which is as far to its right, and the right eye the mirror image (NASA 1992, figure 5).
    pub fn scissor(&self, width: u32) -> Result<Scissor, RigError> {
        if self.projection != Projection::Symmetric {
            return Ok(Scissor::default());
        }
        let blank = (self.pixels_per_unit * self.eye_separation).round_ties_even();
        if blank >= f64::from(width) {
            let most = f64::from(width) / self.pixels_per_unit;
            let expected = format!("less than the width of the screen, {most}");
            return Err(RigError::new("eye_separation", expected, self.eye_separation));
        }
        let blank = blank as u32;
        Ok(Scissor { first: [0, blank], end: [width - blank, width] })
    }

    /// Position of an eye: (∓e/2, 0, −d), turned by the tilt of the head.
    pub fn eye(&self, eye: Eye) -> Vec3 {
        let [cosine, sine] = turn(self.head_tilt / 360.0);
        let half = side(eye) * self.eye_separation / 2.0;
        [-half * cosine, -half * sine, -self.viewing_distance]
    }

    /// Half-way between the eyes.
    pub fn middle(&self) -> Vec3 {
        [0.0, 0.0, -self.viewing_distance]
    }
}

/// A half space: points with `normal`·p + `offset` >= 0 are inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Direction into the half space.
    pub normal: Vec3,
    /// Value at the origin.
    pub offset: f64,
}

impl HalfSpace {
    /// Signed distance of a point, in arbitrary units.
    pub fn at(&self, p: Vec3) -> f64 {
        super::vector::dot(self.normal, p) + self.offset
    }
}
