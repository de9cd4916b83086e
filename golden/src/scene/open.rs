//! Finding out what a name stands for, and opening it.

use super::{builtin, height_field, json, obj, RigFile, Scene, SceneError, DEFAULT_SIZE};
use crate::projection::Kind;
use std::path::Path;

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
