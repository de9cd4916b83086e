//! Distances of a scene from the eyes, and the polygons that its projection leaves out.

use super::vector::extent;
use super::{Camera, Scene, SceneError};
use crate::config::Config;
use crate::formats::Formats;

/// The distances of a scene's triangles and faces from the plane of the eyes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// The nearest and the farthest corner; none where there is nothing.
    pub distances: Option<[f64; 2]>,
    /// Triangles and faces.
    pub polygons: usize,
    /// Triangles and faces that lie in no range of distances that is drawn.
    pub undrawn: usize,
    /// Triangles and faces of which a part lies in none.
    pub partly: usize,
}

impl Scene {
    /// The distances of the scene, seen with its rig. Fails if either contradicts itself.
    pub fn extent(&self) -> Result<Extent, SceneError> {
        self.check()?;
        // The snapping of this camera is not used.
        let formats = Formats::new(&Config::DEFAULT);
        let camera = Camera::new(&self.rig, self.width, self.height, &formats);
        let mut found = Extent::default();
        let mut all = [f64::INFINITY, f64::NEG_INFINITY];
        for mesh in &self.meshes {
            let triangles = mesh.triangles.iter().map(|t| &t[..]);
            for corners in triangles.chain(mesh.faces.iter().map(|f| &f[..])) {
                let z = extent(corners.iter().map(|&n| mesh.positions[n as usize][2]));
                all = [all[0].min(z[0]), all[1].max(z[1])];
                found.polygons += 1;
                let reached = camera.lenses().iter().any(|lens| lens.reaches(z));
                found.undrawn += usize::from(!reached);
                found.partly += usize::from(reached && !camera.covers(z));
            }
        }
        let distances = all.map(|z| z + self.rig.viewing_distance);
        Ok(Extent { distances: (found.polygons > 0).then_some(distances), ..found })
    }
}
