//! OBJ meshes with their MTL materials.
//!
//! The page `docs/scenes.md` lists the statements that are read, and what becomes of them.
//!
//! - OBJ is right-handed, z towards the viewer. Its z is turned round, which leaves everything
//!   where it is: front faces stay counter-clockwise as seen.
//! - Ids count the faces of the file, then its lines; all triangles of a face have its id.
//! - Corners without normals get the mean of the triangles round them that meet at 60 degrees or
//!   less.
//! - Names of materials and indices are resolved when the whole file is read. What cannot be
//!   followed, such as a library, a material or a picture that is not there, is a warning of the
//!   scene; a wrong vertex is an error.
//! - The mesh is placed as [`super::rig_file`] says: by default its bounding box is centred on
//!   the screen, its longest side 80 % of the screen's smaller one, lit by [`Lighting::default`].

mod convert;
mod find;
mod foreign;
mod lines;
mod material;
mod palette;
mod parse;
mod picture;
mod statement;
#[cfg(test)]
mod tests;

pub use picture::{TEXELS_LIMIT, TEXTURE_LIMIT};

use super::error::{no_text, read, reading, InputError, SceneError};
use super::place::Placement;
use super::warning::Warnings;
use super::{Lighting, Rig, Scene, DEFAULT_SIZE};
use crate::text::decode_with_latin1;
use material::Library;
use parse::Parsed;
use picture::Pictures;
use std::path::Path;

/// The scene that a mesh is put into: the default rig and light, dark grey background.
pub fn empty_scene() -> Scene {
    let [width, height] = DEFAULT_SIZE;
    Scene {
        width,
        height,
        rig: Rig::default(),
        background: [40, 44, 52],
        lighting: Some(Lighting::default()),
        ..Scene::default()
    }
}

/// Loads a mesh into a scene that has none yet.
///
/// # Errors
/// If the file cannot be read, has no faces, or a vertex, an index of one or another number in it
/// is wrong. Less than that is a warning of the scene.
pub fn load(file: &Path, mut scene: Scene, placement: &Placement) -> Result<Scene, SceneError> {
    let mut warnings = Warnings::default();
    let _reading = reading(file);
    let mut parsed = parsed(file, &mut warnings)?;
    let mut library = Library::read(file, &parsed.libraries, &mut warnings);
    let mut pictures = Pictures::default();
    let (materials, used) = (&mut scene.materials, parsed.used());
    let looks = library.looks(file, &used, materials, &mut pictures, &mut warnings);
    scene.meshes = convert::meshes(file, &mut parsed, &looks, &mut warnings);
    scene.textures = pictures.textures;
    scene.warnings = warnings;
    let lines = lines::lines(&parsed, &looks, &scene.materials);
    lines::place_with_lines(&mut scene, lines, placement);
    Ok(scene)
}

/// The statements of a file.
fn parsed(file: &Path, warnings: &mut Warnings) -> Result<Parsed, SceneError> {
    let bytes = read(file)?;
    let kind = foreign::kind(&bytes);
    let text = decode_with_latin1(&bytes).map_err(|error| no_text(file, error).into());
    // The largest files are large.
    drop(bytes);
    let parsed = text.and_then(|text| parse::parse(file, &text, warnings));
    // A file that can be read is one whatever it begins with.
    parsed.map_err(|error| match kind {
        Some(kind) => InputError::new(file, 1, "file", "an OBJ mesh", kind).into(),
        None => error,
    })
}
