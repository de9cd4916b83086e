//! The two eyes and the screen: projection, depth, and the planes that polygons are cut by.

use super::error::{RigError, COORDINATE_LIMIT};
use super::vector::{turn, Vec3};
use crate::formats::{Eye, Formats, DEPTH_MAX};

/// Where the eyes are and how large the screen is; lengths are in the scene's own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// Pixels to a unit of length on the screen, the plane z = 0.
    pub pixels_per_unit: f64,
    /// Distance between the eyes, e; not negative.
    pub eye_separation: f64,
    /// Distance from the eyes to the screen, d.
    pub viewing_distance: f64,
    /// Distance from the eyes to the near plane; d/100 where not given.
    pub near: Option<f64>,
    /// Distance from the eyes to the far plane; 100 d where not given.
    pub far: Option<f64>,
    /// Tilt of the head in degrees: how far the right eye is turned up about the middle of the
    /// head. The screen stays upright.
    pub head_tilt: f64,
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
        }
    }
}

impl Rig {
    /// Distance from the eyes to the near plane.
    pub fn near(&self) -> f64 {
        self.near.unwrap_or(self.viewing_distance / 100.0)
    }

    /// Distance from the eyes to the far plane.
    pub fn far(&self) -> f64 {
        self.far.unwrap_or(self.viewing_distance * 100.0)
    }

    /// Refuses values that nothing can be projected with.
    pub fn check(&self) -> Result<(), RigError> {
        let (least, most) = (1.0 / COORDINATE_LIMIT, COORDINATE_LIMIT);
        let positive = |field, found: f64| {
            if (least..=most).contains(&found) {
                return Ok(());
            }
            Err(RigError { field, expected: format!("a number from {least:e} to {most:e}"), found })
        };
        positive("pixels_per_unit", self.pixels_per_unit)?;
        positive("viewing_distance", self.viewing_distance)?;
        if self.eye_separation != 0.0 {
            positive("eye_separation", self.eye_separation)?;
        }
        positive("near", self.near())?;
        positive("far", self.far())?;
        // Closer to the eyes, z + d is all rounding.
        let least = self.viewing_distance / 1e6;
        if self.near() < least {
            let expected = format!("at least a millionth of viewing_distance, {least:e}");
            return Err(RigError { field: "near", expected, found: self.near() });
        }
        if self.far() <= self.near() {
            let expected = format!("more than near, which is {}", self.near());
            return Err(RigError { field: "far", expected, found: self.far() });
        }
        if !(-180.0..=180.0).contains(&self.head_tilt) {
            let expected = "an angle from -180 to 180 degrees".into();
            return Err(RigError { field: "head_tilt", expected, found: self.head_tilt });
        }
        Ok(())
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

/// 1 for the left and -1 for the right eye: the sign of the disparity that depth subtracts.
fn side(eye: Eye) -> f64 {
    match eye {
        Eye::Left => 1.0,
        Eye::Right => -1.0,
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

/// A snapped point as both eyes see it, in subpixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Snapped {
    /// x for each eye.
    pub x: [i64; 2],
    /// y for each eye.
    pub y: [i64; 2],
}

/// A rig in front of a picture of a certain size.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    half: [f64; 2],
    rig: Rig,
    /// Components of the vector from the left to the right eye.
    separation: [f64; 2],
    subpixels: f64,
    guard: f64,
    near: f64,
    far: f64,
}

impl Camera {
    /// The camera of a rig for views of this size, which snaps as the formats say.
    pub fn new(rig: Rig, width: u32, height: u32, formats: &Formats) -> Camera {
        let [cosine, sine] = turn(rig.head_tilt / 360.0);
        Camera {
            half: [f64::from(width) / 2.0, f64::from(height) / 2.0],
            rig,
            separation: [rig.eye_separation * cosine, rig.eye_separation * sine],
            subpixels: formats.one_pixel() as f64,
            guard: formats.guard_band.into(),
            near: rig.near(),
            far: rig.far(),
        }
    }

    /// Pixel position of a point for an eye.
    ///
    /// x = width/2 + ppu·(x ∓ z·e/(2d))/(1 + z/d), y = height/2 − ppu·y/(1 + z/d), − for the left
    /// eye: the line from (∓e/2, 0, −d) to (x, y, z) meets z = 0 at ∓e/2 + (x ± e/2)·d/(z + d).
    /// Far points are displaced to the left for the left eye, near ones to the right.
    pub fn pixel(&self, p: Vec3, eye: Eye) -> [f64; 2] {
        let Rig { pixels_per_unit: ppu, viewing_distance: d, .. } = self.rig;
        let [ex, ey] = self.separation.map(|e| side(eye) * (p[2] * e / (2.0 * d)));
        let w = 1.0 + p[2] / d;
        [self.half[0] + ppu * (p[0] - ex) / w, self.half[1] - ppu * (p[1] - ey) / w]
    }

    /// The nearest subpixel for each eye, ties to even; for points in front of the eyes.
    pub fn snap(&self, p: Vec3) -> Snapped {
        let [left, right] =
            Eye::BOTH.map(|eye| self.pixel(p, eye).map(|n| (n * self.subpixels).round_ties_even()));
        // The conversion saturates: what lies that far out is clipped before it is drawn.
        Snapped { x: [left[0] as i64, right[0] as i64], y: [left[1] as i64, right[1] as i64] }
    }

    /// Depth of a point: 24 bits, affine in 1/(z + d), 0 at the near plane.
    pub fn depth(&self, p: Vec3) -> u32 {
        let w = p[2] + self.rig.viewing_distance;
        let part = self.far * (w - self.near) / (w * (self.far - self.near));
        (part * f64::from(DEPTH_MAX)).round_ties_even().clamp(0.0, DEPTH_MAX.into()) as u32
    }

    /// 1 + z/d: the distance from the eye plane in units of the viewing distance.
    pub fn distance(&self, p: Vec3) -> f64 {
        1.0 + p[2] / self.rig.viewing_distance
    }

    /// Whether both eyes see the same rows, so that polygons may be cut in common there.
    pub fn is_level(&self) -> bool {
        self.separation[1] == 0.0
    }

    /// z of the near and of the far plane.
    pub fn depth_range(&self) -> [f64; 2] {
        let d = self.rig.viewing_distance;
        [self.near - d, self.far - d]
    }

    /// Behind the near plane and before the far plane.
    pub fn depth_planes(&self) -> [HalfSpace; 2] {
        let [near, far] = self.depth_range();
        [
            HalfSpace { normal: [0.0, 0.0, 1.0], offset: -near },
            HalfSpace { normal: [0.0, 0.0, -1.0], offset: far },
        ]
    }

    /// Left, right, top and bottom of an eye's window with its guard band.
    pub fn window_planes(&self, eye: Eye) -> [HalfSpace; 4] {
        let Rig { pixels_per_unit: ppu, viewing_distance: d, .. } = self.rig;
        let plane = |axis: usize, sign: f64| {
            let extent = self.half[axis] + self.guard;
            let shift = sign * ppu * side(eye) * self.separation[axis] / (2.0 * d);
            let mut normal = [0.0, 0.0, extent / d - shift];
            normal[axis] = sign * ppu;
            HalfSpace { normal, offset: extent }
        };
        [plane(0, 1.0), plane(0, -1.0), plane(1, -1.0), plane(1, 1.0)]
    }
}
