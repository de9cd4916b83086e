//! Scenes: what is to be drawn, before any of it is snapped to integers.
//!
//! Coordinates are left-handed: x right, y up, z away from the viewer, in units of the scene's
//! own. The screen is the plane z = 0, centred on the origin; the eyes are at (∓e/2, 0, −d) and see it
//! through a [`crate::projection::Projection`].
//! A scene comes from
//!
//! - code: the built-in scenes, [`builtin`];
//! - a mesh, [`obj`]: centred and fitted at the screen plane, lit;
//! - a grid of heights, [`height_field`]: placed in the same way;
//! - a file of its own format, [`json`]: drawn as it stands.
//!
//! [`open`] finds out which. A rig file ([`rig_file`]) may move the eyes and change the screen.
//! [`Scene::geometry`] makes polygons of it, as setup wants them.

mod builder;
pub mod builtin;
mod camera;
pub mod clip;
pub mod cut;
mod error;
mod extent;
mod geometry;
pub mod height_field;
pub mod json;
pub mod light;
mod locate;
mod mesh;
pub mod obj;
mod open;
pub mod place;
mod rig;
pub mod rig_file;
mod shading;
pub mod vector;
mod warning;
pub mod wires;

pub use camera::{Camera, Lens, Snapped};
pub use error::*;
pub use extent::Extent;
pub use geometry::{Counts, Cull, Geometry, Options};
pub use light::{Environment, Light, Lighting, Material, Panel, Source};
pub use mesh::{Colours, Mesh, REPEAT_LIMIT};
pub use open::{open, open_projected};
pub use rig::{HalfSpace, Rig};
pub use rig_file::RigFile;
pub use warning::{Warning, Warnings};

use crate::texture::Texture;

/// Size of the views where nothing else is said.
pub const DEFAULT_SIZE: [u32; 2] = [640, 480];

/// Everything to draw, and from where.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Width of each view in pixels.
    pub width: u32,
    /// Height of each view in pixels.
    pub height: u32,
    /// Eyes and screen.
    pub rig: Rig,
    /// Colour where there is nothing.
    pub background: [u8; 3],
    /// Light; without it meshes show their colours as they are.
    pub lighting: Option<Lighting>,
    /// Surroundings that polished surfaces reflect.
    pub environment: Environment,
    /// Materials of the meshes.
    pub materials: Vec<Material>,
    /// Textures of the materials.
    pub textures: Vec<Texture>,
    /// The meshes. Ids count their polygons in this order, triangles before faces in each.
    pub meshes: Vec<Mesh>,
    /// Statements of its files that were not followed.
    pub warnings: Warnings,
}

impl Scene {
    /// Changes the size of the views; the smaller one of the two ratios scales the picture, so
    /// that all of it stays in view.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), SceneError> {
        check_size(width, height, SIZE_LIMIT)?;
        let ratio = |new: u32, old: u32| f64::from(new) / f64::from(old.max(1));
        self.rig.pixels_per_unit *= ratio(width, self.width).min(ratio(height, self.height));
        (self.width, self.height) = (width, height);
        Ok(())
    }

    /// Refuses what could not be drawn.
    pub(super) fn check(&self) -> Result<(), SceneError> {
        self.rig.check()?;
        let lit = self.lighting.is_some();
        let mut ids = 0;
        for (index, mesh) in self.meshes.iter().enumerate() {
            mesh.check(index, lit)?;
            let wrong = |field, problem| Err(SceneError::Mesh { mesh: index, field, problem });
            let Some(material) = self.materials.get(mesh.material as usize) else {
                return wrong("material", format!("no material {}", mesh.material));
            };
            if material.texture.is_some_and(|n| n as usize >= self.textures.len()) {
                return wrong("material", "no such texture".into());
            }
            ids += mesh.id_count();
            if ids > ID_LIMIT {
                return wrong("triangles", format!("more than {ID_LIMIT} in the scene"));
            }
        }
        Ok(())
    }
}
