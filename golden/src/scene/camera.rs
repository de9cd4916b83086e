//! From places in the scene to places in the two views.

use super::rig::{side, HalfSpace, Rig};
use super::vector::{turn, Vec3};
use crate::formats::{Eye, Formats, DEPTH_MAX};
use crate::projection::{Kind, Range};

/// A snapped point as both eyes see it, in subpixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Snapped {
    /// x for each eye.
    pub x: [i64; 2],
    /// y for each eye.
    pub y: [i64; 2],
}

/// In which order a point is moved and projected. All give the same but for rounding where they apply.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    /// (x ∓ z·e/(2d))/(1 + z/d): from the two eyes, in the fewest operations.
    Folded,
    /// Sheared, then projected from the middle.
    ShearProject,
    /// Moved, projected from the middle, moved back.
    MoveProjectMove,
}

/// A rig in front of a picture of a certain size.
#[derive(Clone, Debug)]
pub struct Camera {
    viewing_distance: f64,
    near: f64,
    far: f64,
    level: bool,
    lenses: Vec<Lens>,
}

/// Projection of points within a range of distances.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    order: Order,
    half: [f64; 2],
    pixels_per_unit: f64,
    viewing_distance: f64,
    screen_distance: f64,
    /// Components of the vector from the left to the right eye.
    separation: [f64; 2],
    /// Offsets of the left eye: of the scene before projecting, and of the picture after it.
    before: [f64; 2],
    after: [f64; 2],
    /// z of the range's ends.
    range: [f64; 2],
    /// Another lens begins at the far end and has what lies there.
    joined: bool,
    subpixels: f64,
    guard: f64,
}

impl Camera {
    /// The camera of a rig for views of this size, which snaps as the formats say.
    pub fn new(rig: &Rig, width: u32, height: u32, formats: &Formats) -> Camera {
        let ranges = rig.ranges();
        let lens = |range: &Range| Lens::new(rig, range, [width, height], formats);
        let mut lenses: Vec<Lens> = ranges.iter().map(lens).collect();
        for n in 1..lenses.len() {
            lenses[n - 1].joined = lenses[n - 1].range[1] == lenses[n].range[0];
        }
        Camera {
            viewing_distance: rig.viewing_distance,
            near: rig.near(),
            far: rig.far(),
            level: lenses.iter().all(|lens| lens.before[1] == 0.0 && lens.after[1] == 0.0),
            lenses,
        }
    }

    /// The lenses, the nearest first: one but for the piecewise projection.
    pub fn lenses(&self) -> &[Lens] {
        &self.lenses
    }

    /// The lens for a point; beside the ranges of all, the next farther one or else the last.
    pub fn lens(&self, p: Vec3) -> &Lens {
        let found = self.lenses.iter().find(|lens| !lens.ends_before(p[2]));
        found.unwrap_or(&self.lenses[self.lenses.len() - 1])
    }

    /// True if the lenses cover the whole of a range of z, given that they cover a part of it.
    pub fn covers(&self, [least, most]: [f64; 2]) -> bool {
        let mut reached = least;
        for [near, far] in self.lenses.iter().map(|lens| lens.range) {
            if near <= reached {
                reached = reached.max(far);
            }
        }
        reached >= most
    }

    /// Pixel position of a point for an eye, by its lens.
    pub fn pixel(&self, p: Vec3, eye: Eye) -> [f64; 2] {
        self.lens(p).pixel(p, eye)
    }

    /// The nearest subpixel for each eye, ties to even; for points in front of the eyes.
    pub fn snap(&self, p: Vec3) -> Snapped {
        self.lens(p).snap(p)
    }

    /// Depth of a point: 24 bits, affine in 1/(z + d), 0 at the near plane.
    pub fn depth(&self, p: Vec3) -> u32 {
        let w = p[2] + self.viewing_distance;
        let part = self.far * (w - self.near) / (w * (self.far - self.near));
        (part * f64::from(DEPTH_MAX)).round_ties_even().clamp(0.0, DEPTH_MAX.into()) as u32
    }

    /// 1 + z/d: the distance from the eye plane in units of the viewing distance.
    pub fn distance(&self, p: Vec3) -> f64 {
        1.0 + p[2] / self.viewing_distance
    }

    /// True if both eyes see the same rows, so that polygons may be cut in common there.
    pub fn is_level(&self) -> bool {
        self.level
    }
}

impl Lens {
    fn new(rig: &Rig, range: &Range, size: [u32; 2], formats: &Formats) -> Lens {
        let viewer = rig.viewer();
        let direction = turn(rig.head_tilt / 360.0);
        let d = rig.viewing_distance;
        Lens {
            order: match rig.projection.kind() {
                Kind::TwoCentres | Kind::Symmetric => Order::Folded,
                Kind::Shear => Order::ShearProject,
                Kind::Translate | Kind::Asymptotic | Kind::Piecewise => Order::MoveProjectMove,
            },
            half: size.map(|n| f64::from(n) / 2.0),
            pixels_per_unit: rig.pixels_per_unit,
            viewing_distance: d,
            screen_distance: viewer.screen_distance,
            separation: direction.map(|n| rig.eye_separation * n),
            before: direction.map(|n| viewer.projection_offset(&range.map) * n),
            after: direction.map(|n| viewer.viewport_offset(&range.map) * n),
            range: [range.near - d, range.far - d],
            joined: false,
            subpixels: formats.one_pixel() as f64,
            guard: formats.guard_band.into(),
        }
    }

    /// Pixel position of a point for an eye.
    ///
    /// With two centres, x = width/2 + ppu·(x ∓ z·e/(2d))/(1 + z/d), y = height/2 − ppu·y/(1 + z/d),
    /// − for the left eye: the line from (∓e/2, 0, −d) to (x, y, z) meets z = 0 at
    /// ∓e/2 + (x ± e/2)·d/(z + d) (Adelson 1991, "Differences and Similarities Between The Views").
    /// Far points are displaced to the left for the left eye, near ones to the right.
    pub fn pixel(&self, p: Vec3, eye: Eye) -> [f64; 2] {
        let [x, y] = self.on_screen(p, eye);
        [self.half[0] + x, self.half[1] - y]
    }

    /// Place on the screen in pixels, right and up from its middle.
    fn on_screen(&self, p: Vec3, eye: Eye) -> [f64; 2] {
        let (ppu, d) = (self.pixels_per_unit, self.viewing_distance);
        let shear = |axis: usize| side(eye) * (p[2] * self.separation[axis] / (2.0 * d));
        let project = |n: f64| n * self.screen_distance / (p[2] + d);
        [0, 1].map(|axis| match self.order {
            Order::Folded => ppu * (p[axis] - shear(axis)) / (1.0 + p[2] / d),
            Order::ShearProject => ppu * project(p[axis] - shear(axis)),
            Order::MoveProjectMove => {
                let moved = p[axis] + side(eye) * self.before[axis];
                ppu * (project(moved) + side(eye) * self.after[axis])
            }
        })
    }

    /// The nearest subpixel for each eye, ties to even; for points in front of the eyes.
    pub fn snap(&self, p: Vec3) -> Snapped {
        let [left, right] =
            Eye::BOTH.map(|eye| self.pixel(p, eye).map(|n| (n * self.subpixels).round_ties_even()));
        // The conversion saturates: what lies that far out is clipped before it is drawn.
        Snapped { x: [left[0] as i64, right[0] as i64], y: [left[1] as i64, right[1] as i64] }
    }

    /// The point from which an eye's view is projected.
    pub fn centre(&self, eye: Eye) -> Vec3 {
        let [x, y] = self.before.map(|n| -side(eye) * n);
        [x, y, -self.viewing_distance]
    }

    /// z of the near and of the far end.
    pub fn depth_range(&self) -> [f64; 2] {
        self.range
    }

    fn ends_before(&self, z: f64) -> bool {
        z > self.range[1] || (self.joined && z == self.range[1])
    }

    /// True if a part of an object from one z to another is this lens's. An object that only touches an end has no part
    /// here, and a flat one where two lenses meet is the farther one's, so that nothing is drawn twice.
    pub fn reaches(&self, [least, most]: [f64; 2]) -> bool {
        let [near, far] = self.range;
        if least == most {
            return near <= least && !self.ends_before(least);
        }
        near < most && least < far
    }

    /// Behind the near and before the far end.
    pub fn depth_planes(&self) -> [HalfSpace; 2] {
        let [near, far] = self.range;
        [
            HalfSpace { normal: [0.0, 0.0, 1.0], offset: -near },
            HalfSpace { normal: [0.0, 0.0, -1.0], offset: far },
        ]
    }

    /// Left, right, top and bottom of an eye's window with its guard band.
    pub fn window_planes(&self, eye: Eye) -> [HalfSpace; 4] {
        let (ppu, d) = (self.pixels_per_unit, self.viewing_distance);
        let sd = self.screen_distance;
        // ±(SD (x + before)/(z + d) + after)·ppu + extent >= 0, times (z + d)/SD.
        let plane = |axis: usize, sign: f64| {
            let extent = self.half[axis] + self.guard;
            let scale = sign * ppu * side(eye);
            let mut normal = [0.0, 0.0, extent / sd + scale * self.after[axis] / sd];
            normal[axis] = sign * ppu;
            let moved = scale * (self.after[axis] * (d / sd) + self.before[axis]);
            HalfSpace { normal, offset: extent * (d / sd) + moved }
        };
        [plane(0, 1.0), plane(0, -1.0), plane(1, -1.0), plane(1, 1.0)]
    }
}
