//! From distances in the scene to the distances at which they are perceived, and what moves the
//! views so: NASA 1992, appendix A "Overall geometry and distance mapping" and appendix B.

/// The map of a projection: 1/d = `slope`/d' + `intercept`, where d' is a distance in the scene and
/// d the distance at which the viewer perceives it.
///
/// Every projection here is of this form. Looking through the screen as through a window, as with
/// two centres of projection, is slope 1 and intercept 0 (d = d'). On the screen the map makes the
/// disparity affine in 1/d', and with it affine over the image of any plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceMap {
    /// Scene units to a unit of perceived distance; not negative, 0 where all is at one distance.
    pub slope: f64,
    /// Inverse of the distance at which what is infinitely far is perceived.
    pub intercept: f64,
}

impl DistanceMap {
    /// Perceived distances are those in the scene.
    pub const IDENTITY: DistanceMap = DistanceMap { slope: 1.0, intercept: 0.0 };

    /// The map by which infinity is perceived at `max_distance` (infinite itself if there is no limit) and
    /// `screen_intercept` at the screen's distance (NASA 1992, appendix A).
    pub fn asymptotic(
        screen_intercept: f64,
        screen_distance: f64,
        max_distance: f64,
    ) -> DistanceMap {
        let slope = screen_intercept * (1.0 / screen_distance - 1.0 / max_distance);
        DistanceMap { slope, intercept: 1.0 / max_distance }
    }

    /// Scene distances `near` and `far` are perceived at `min_distance` and `max_distance`
    /// (NASA 1992, appendix B). Of d itself the map is linear only where far·min = near·max.
    pub fn piecewise(near: f64, far: f64, min_distance: f64, max_distance: f64) -> DistanceMap {
        let slope = (1.0 / min_distance - 1.0 / max_distance) / (1.0 / near - 1.0 / far);
        DistanceMap { slope, intercept: 1.0 / max_distance - slope / far }
    }

    /// Perceived distance of a scene distance: d of d' (NASA 1992, the last equations of appendices A and B); infinite
    /// distances are legal.
    pub fn perceived(&self, scene: f64) -> f64 {
        1.0 / (self.slope / scene + self.intercept)
    }

    /// The scene distance that is perceived at this distance, d' of d (as above; with MIND: NCP of appendix A); none is where `slope` is 0.
    pub fn scene(&self, perceived: f64) -> f64 {
        self.slope / (1.0 / perceived - self.intercept)
    }
}

/// The viewer before the screen; lengths are in the screen's unit, which need not be the scene's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewer {
    /// Distance between the eyes, IPD.
    pub eye_distance: f64,
    /// Distance from the eyes to the screen, SD.
    pub screen_distance: f64,
}

impl Viewer {
    /// Movement of the scene before it is projected: to the right by this for the left eye, to the left for the right
    /// eye. (IPD/2)·slope: POT of NASA 1992, appendix A, and LPOT of appendix B; in the scene's unit.
    pub fn projection_offset(&self, map: &DistanceMap) -> f64 {
        self.eye_distance / 2.0 * map.slope
    }

    /// Movement of the picture after it is projected: to the right by this for the left eye, to the left for the right
    /// eye. −(IPD/2)(1 − SD·intercept): VPT of NASA 1992, appendix A, and LVPT of appendix B.
    pub fn viewport_offset(&self, map: &DistanceMap) -> f64 {
        -(self.eye_distance / 2.0) * (1.0 - self.screen_distance * map.intercept)
    }

    /// Distance on the screen from the left eye's image of a point perceived at this distance to the right eye's,
    /// positive to the right: IPD(1 − SD/d) (NASA 1992, figure 4).
    pub fn disparity(&self, perceived: f64) -> f64 {
        self.eye_distance * (1.0 - self.screen_distance / perceived)
    }
}

/// The display that turns physical lengths into those of the scene (Duvanenko and Robbins 1993,
/// "Transforming Interocular Distance"; listings 1 and 6): an inch is so many dots, a dot is a pixel,
/// and pixels have a size in the scene.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// Distance between the viewer's eyes, in any unit of length.
    pub eye_distance: f64,
    /// Distance from the viewer to the screen, in the same unit.
    pub viewing_distance: f64,
    /// Distance from one dot of the screen to the next, in the same unit.
    pub dot_pitch: f64,
}

impl Device {
    /// The display of the article, in inches: 119 dots between the eyes, 857 to the screen.
    pub const LEX_90: Device =
        Device { eye_distance: 2.5, viewing_distance: 18.0, dot_pitch: 0.021 };

    /// A physical length in dots.
    pub fn dots(&self, length: f64) -> f64 {
        length / self.dot_pitch
    }

    /// A physical length in the scene's unit, of which a screen unit has so many pixels.
    pub fn view_units(&self, length: f64, pixels_per_unit: f64) -> f64 {
        self.dots(length) / pixels_per_unit
    }
}
