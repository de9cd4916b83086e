//! What drawing receives of a scene, and the choices in making it.

use super::builder::Builder;
use super::error::{check_size, SceneError, ID_LIMIT};
use super::Scene;
use crate::formats::{Formats, Rgba};
use crate::frame::Scissor;
use crate::setup::Polygon;
use crate::texture::Texture;
use std::fmt;

/// Which faces are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// For each eye the ones it sees clockwise.
    Back,
}

/// Choices in making geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Which faces are left out.
    pub cull: Cull,
    /// Difference between the eyes' colours of a corner, in any channel of 0 to 255, above which
    /// a polygon counts as [`Polygon::specular`].
    pub specular_threshold: u8,
}

impl Default for Options {
    /// Nothing is left out; a difference of 3 or more shows as a seam between smooth polygons.
    fn default() -> Options {
        Options { cull: Cull::None, specular_threshold: 2 }
    }
}

/// What became of the triangles and faces of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangles in the meshes.
    pub triangles: usize,
    /// Convex polygons in the meshes.
    pub faces: usize,
    /// Polygons made.
    pub polygons: usize,
    /// Triangles and faces cut at the near or far plane of a partition, or above or below the guard
    /// band; one that crosses partitions counts in each.
    pub clipped: usize,
    /// Triangles and faces cut for each eye alone, because they leave the guard band.
    pub guard_band: usize,
    /// Triangles and faces culled for both eyes.
    pub culled: usize,
    /// Triangles and faces culled for one eye.
    pub half_culled: usize,
    /// Triangles, faces and pieces of them outside the windows, or behind the near or far plane.
    pub outside: usize,
    /// Triangles, faces and pieces of them without area.
    pub empty: usize,
    /// Id of the first of those.
    pub first_empty: Option<u32>,
}

impl fmt::Display for Counts {
    /// What is not drawn, and why; nothing where all is.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let empty = match self.first_empty {
            Some(id) => format!("without area (triangle {id} is the first)"),
            None => "without area".into(),
        };
        let parts = [
            (self.empty, empty.as_str()),
            (self.outside, "outside the views"),
            (self.culled, "culled for both eyes"),
            (self.half_culled, "culled for one eye"),
        ];
        let some = parts.iter().filter(|(count, _)| *count > 0);
        let some: Vec<String> = some.map(|(count, what)| format!("{count} {what}")).collect();
        f.write_str(&some.join(", "))
    }
}

/// Polygons for setup.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// Width of each view in pixels.
    pub width: u32,
    /// Height of each view in pixels.
    pub height: u32,
    /// Colour where nothing is drawn.
    pub background: Rgba,
    /// The polygons in the order to draw them: opaque ones by id, then the others, the farthest
    /// first.
    pub polygons: Vec<Polygon>,
    /// The textures that polygons refer to.
    pub textures: Vec<Texture>,
    /// Columns of each view that are drawn.
    pub scissor: Scissor,
    /// Where the triangles went.
    pub counts: Counts,
}

impl Scene {
    /// Lights, projects, clips and snaps the scene.
    ///
    /// Fails if the views exceed the formats or a mesh contradicts itself.
    pub fn geometry(&self, formats: &Formats, options: &Options) -> Result<Geometry, SceneError> {
        check_size(self.width, self.height, formats.max_size)?;
        self.check()?;
        let scissor = self.rig.scissor(self.width)?;
        let mut builder = Builder::new(self, formats, options);
        let mut first_id = 0;
        for mesh in &self.meshes {
            builder.mesh(mesh, first_id);
            first_id += mesh.id_count() as u32;
        }
        Ok(builder.finish(scissor))
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
