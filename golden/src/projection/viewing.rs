//! The eyes and the screen of a rig.

/// Values of a rig that a projection needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    /// Distance between the eyes.
    pub eye_separation: f64,
    /// Distance from the eyes to the screen, in the scene.
    pub viewing_distance: f64,
    /// Distance from the eyes to the far plane, where it is given.
    pub far: Option<f64>,
    /// Tilt of the head in degrees.
    pub head_tilt: f64,
}
