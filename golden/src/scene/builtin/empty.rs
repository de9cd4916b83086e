//! Empty scenes that the built-in ones begin with.

use crate::scene::{Material, Rig, Scene};

/// An empty scene of which 32 × 24 cm of screen are in view.
pub(super) fn desk(width: u32, height: u32) -> Scene {
    let pixels_per_unit = (f64::from(width) / 32.0).min(f64::from(height) / 24.0);
    Scene { width, height, rig: Rig { pixels_per_unit, ..Rig::default() }, ..Scene::default() }
}

/// An empty unlit scene in units that are pixels of a 640 × 480 picture, with the eyes this far
/// apart, 640 units from the screen.
pub(super) fn chart(width: u32, height: u32, eye_separation: f64) -> Scene {
    let pixels_per_unit = (f64::from(width) / 640.0).min(f64::from(height) / 480.0);
    Scene {
        width,
        height,
        rig: Rig { pixels_per_unit, eye_separation, viewing_distance: 640.0, ..Rig::default() },
        background: [24, 26, 32],
        materials: vec![Material::default()],
        ..Scene::default()
    }
}
