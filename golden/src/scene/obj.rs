//! OBJ meshes with their MTL materials.
//!
//! - Geometry: `v` (with optional w or colour), `vt`, `vn` and `f`, of any number of corners (cut
//!   into a fan), relative indices too. Ids count the faces of the file; all triangles of a face
//!   have its id. Lines, points, curves and groups are ignored.
//! - Materials: `Kd`, `Ks`, `Ns`, `Ke`, `d` or `Tr`, `illum` (below 2 no highlights, from 3 half
//!   of Ks reflects the environment) and `map_Kd`, a PNG or JPEG picture without options. Without
//!   a material library meshes are light grey.
//! - OBJ is right-handed, z towards the viewer. Its z is turned round, which leaves everything
//!   where it is: front faces stay counter-clockwise as seen.
//! - Corners without normals get the mean of the triangles round them that meet at 60 degrees or
//!   less.
//! - The mesh is placed as [`super::rig_file`] says: by default its bounding box is centred on
//!   the screen, its longest side 80 % of the screen's smaller one, lit by [`Lighting::default`].

use super::error::{InputError, SceneError};
use super::mesh::Colours;
use super::obj_check::{check, TextureName};
use super::place::{place, Placement};
use super::vector::{scale, unit, Vec3};
use super::{Lighting, Material, Mesh, Rig, Scene, DEFAULT_SIZE};
use crate::formats::Rgba;
use crate::texture::Texture;
use std::collections::HashMap;
use std::path::Path;

/// Cosine of the largest angle at which triangles are shaded as one smooth surface.
const CREASE: f64 = 0.5;
/// Largest width and height of a texture.
pub const TEXTURE_LIMIT: u32 = 4096;

/// What a mesh is put into: the default rig and light, dark grey background.
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
pub fn load(file: &Path, mut scene: Scene, placement: &Placement) -> Result<Scene, SceneError> {
    let checked = check(file)?;
    let options = tobj::LoadOptions { single_index: true, ..tobj::LoadOptions::default() };
    let (models, materials) = tobj::load_obj_buf(&mut checked.text.as_bytes(), &options, |name| {
        let library = checked.libraries.get(name.to_string_lossy().as_ref());
        tobj::load_mtl_buf(&mut library.map(String::as_bytes).unwrap_or_default())
    })
    // Checked beforehand; but should anything be left, it is an error like any other.
    .and_then(|(models, materials)| Ok((models, materials?)))
    .map_err(|e| InputError::new(file, None, "file", "a well-formed mesh", e.to_string()))?;

    let mut textures = TextureStore::default();
    let mut known = HashMap::new();
    for model in models.iter().filter(|m| !m.mesh.indices.is_empty()) {
        let mut mesh = convert(&model.mesh);
        mesh.material = match known.get(&model.mesh.material_id) {
            Some(&index) => index,
            None => {
                let material = match model.mesh.material_id.and_then(|n| materials.get(n)) {
                    Some(m) => material(m, checked.textures.get(&m.name), &mut textures)?,
                    None => Material::default(),
                };
                let index = scene.materials.len() as u32;
                scene.materials.push(material);
                known.insert(model.mesh.material_id, index);
                index
            }
        };
        scene.meshes.push(mesh);
    }
    scene.textures = textures.textures;
    place(&mut scene, placement);
    Ok(scene)
}

/// A mesh in its own coordinates but left-handed, with normals.
fn convert(mesh: &tobj::Mesh) -> Mesh {
    let flipped = |n: &[f64]| [n[0], n[1], -n[2]];
    let mut triangles = Vec::new();
    let mut triangle_ids = Vec::new();
    let mut first = 0;
    let arities = mesh.face_arities.iter().map(|&n| n as usize);
    let all_triangles = std::iter::repeat_n(3, mesh.indices.len() / 3);
    let arities: Vec<usize> =
        if mesh.face_arities.is_empty() { all_triangles.collect() } else { arities.collect() };
    for (id, arity) in arities.into_iter().enumerate() {
        let face = &mesh.indices[first..first + arity];
        first += arity;
        for pair in face[1..].windows(2) {
            triangles.push([face[0], pair[0], pair[1]]);
            triangle_ids.push(id as u32);
        }
    }
    let mut result = Mesh {
        positions: mesh.positions.chunks_exact(3).map(flipped).collect(),
        normals: mesh.normals.chunks_exact(3).map(|n| unit(flipped(n))).collect(),
        // v goes upward in OBJ files.
        texture_coordinates: mesh.texcoords.chunks_exact(2).map(|t| [t[0], 1.0 - t[1]]).collect(),
        triangles,
        triangle_ids,
        ..Mesh::default()
    };
    if !mesh.vertex_color.is_empty() {
        let colour = |c: &[f64]| [c[0], c[1], c[2]].map(|n| (n * 255.0).round_ties_even() as u8);
        result.colours = Colours::Vertex(mesh.vertex_color.chunks_exact(3).map(colour).collect());
    }
    if result.normals.is_empty() {
        result.crease_normals(CREASE);
    }
    result
}

fn material(
    mtl: &tobj::Material,
    texture: Option<&TextureName>,
    textures: &mut TextureStore,
) -> Result<Material, SceneError> {
    let illumination = mtl.illumination_model.unwrap_or(2);
    let clamped = |c: Option<Vec3>, default: f64| c.unwrap_or([default; 3]).map(|n| n.min(1.0));
    let texture = texture.map(|name| textures.index(name)).transpose()?;
    let mut diffuse = clamped(mtl.diffuse, 0.8);
    if texture.is_some() && diffuse == [0.0; 3] {
        // Some programs write this and mean the texture alone.
        diffuse = [1.0; 3];
    }
    let specular = if illumination < 2 { [0.0; 3] } else { clamped(mtl.specular, 0.0) };
    Ok(Material {
        diffuse,
        specular,
        exponent: mtl.shininess.unwrap_or(32.0).clamp(1.0, 10_000.0).round() as u32,
        emission: clamped(mtl.emissive, 0.0),
        reflection: if illumination < 3 { [0.0; 3] } else { scale(specular, 0.5) },
        alpha: mtl.dissolve.unwrap_or(1.0),
        texture,
    })
}

/// Textures that have been loaded, each once.
#[derive(Default)]
struct TextureStore {
    textures: Vec<Texture>,
    known: HashMap<std::path::PathBuf, u32>,
}

impl TextureStore {
    fn index(&mut self, name: &TextureName) -> Result<u32, InputError> {
        if let Some(&index) = self.known.get(&name.picture) {
            return Ok(index);
        }
        let index = self.textures.len() as u32;
        self.textures.push(load_texture(name)?);
        self.known.insert(name.picture.clone(), index);
        Ok(index)
    }
}

fn load_texture(name: &TextureName) -> Result<Texture, InputError> {
    let picture = || -> Result<image::RgbaImage, image::ImageError> {
        let mut reader = image::ImageReader::open(&name.picture)?.with_guessed_format()?;
        let mut limits = image::Limits::default();
        limits.max_image_width = Some(TEXTURE_LIMIT);
        limits.max_image_height = Some(TEXTURE_LIMIT);
        reader.limits(limits);
        Ok(reader.decode()?.into_rgba8())
    };
    let picture = picture().map_err(|error| {
        let expected = format!("a PNG or JPEG picture of at most {TEXTURE_LIMIT} pixels a side");
        let found = format!("{}: {error}", name.picture.display());
        InputError::new(&name.library, name.line, "map_Kd", expected, found)
    })?;
    Ok(Texture {
        width: picture.width(),
        height: picture.height(),
        texels: picture.pixels().map(|p| Rgba(p.0)).collect(),
    })
}
