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
pub(crate) use rig::check_length;
pub use rig::{HalfSpace, Rig};
pub use rig_file::RigFile;
pub use warning::{Warning, Warnings};

use crate::projection::Kind;
use crate::texture::Texture;
use std::path::Path;

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
    /// What polished surfaces reflect.
    pub environment: Environment,
    /// Materials of the meshes.
    pub materials: Vec<Material>,
    /// Textures of the materials.
    pub textures: Vec<Texture>,
    /// The meshes. Ids count their polygons in this order, triangles before faces in each.
    pub meshes: Vec<Mesh>,
    /// What of its files was not followed.
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
}

/// Opens a built-in scene by its name, or a file that ends in `.obj`, `.json`, or, with a grid of
/// heights, in `.png`, `.txt` or `.grid`.
///
/// `size` is the size of the views in pixels; it goes before that of the rig file, which goes
/// before that of the scene. Where the size differs from the scene's own and the rig file does
/// not say how large a pixel is, the picture is scaled with it.
pub fn open(
    name: &str,
    size: Option<[u32; 2]>,
    rig_file: Option<&Path>,
) -> Result<Scene, SceneError> {
    open_projected(name, size, rig_file, None)
}

/// As [`open`], with a projection that goes before that of the rig file.
pub fn open_projected(
    name: &str,
    size: Option<[u32; 2]>,
    rig_file: Option<&Path>,
    projection: Option<Kind>,
) -> Result<Scene, SceneError> {
    let path = Path::new(name);
    let rig_file = rig_file.map_or_else(|| Ok(RigFile::empty(path)), RigFile::load)?;
    let size = size.or(rig_file.size());
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let mut scene = match extension.as_deref() {
        Some("obj") => {
            let mut empty = obj::empty_scene();
            rig_file.apply(&mut empty, size, projection)?;
            let scene = obj::load(path, empty, &rig_file.placement())?;
            return rig_file.check_placed(&scene).map(|()| scene);
        }
        Some("json") => json::load(path)?,
        Some(e) if height_field::is_grid(e) => {
            return field(&height_field::load(path)?, size, &rig_file, projection);
        }
        // The one built-in scene that a rig file may place.
        _ if name == builtin::ATOMS => {
            return field(&height_field::atoms(), size, &rig_file, projection);
        }
        _ => {
            let [width, height] = size.unwrap_or(DEFAULT_SIZE);
            builtin::scene(name, width, height)?
        }
    };
    rig_file.apply(&mut scene, size, projection)?;
    Ok(scene)
}

/// A height field with a rig file's changes.
fn field(
    grid: &height_field::HeightGrid,
    size: Option<[u32; 2]>,
    rig_file: &RigFile,
    projection: Option<Kind>,
) -> Result<Scene, SceneError> {
    let [width, height] = DEFAULT_SIZE;
    let mut empty = height_field::empty_scene(width, height);
    rig_file.apply(&mut empty, size, projection)?;
    let scene = height_field::scene(grid, empty, &rig_file.placement());
    rig_file.check_placed(&scene).map(|()| scene)
}
