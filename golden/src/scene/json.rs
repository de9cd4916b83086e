//! Scene files: triangles with colours, drawn as they stand.
//!
//! A scene file is a JSON object with exactly these fields:
//!
//! | field | value |
//! | --- | --- |
//! | `format` | `"stereo-scene/1"` |
//! | `width`, `height` | size of each view in pixels, 1 to 2048 |
//! | `pixels_per_unit` | pixels to a unit of length on the screen |
//! | `eye_separation` | e; the eyes are at (∓e/2, 0, −d) |
//! | `viewing_distance` | d, from the eyes to the screen z = 0 |
//! | `background` | `[red, green, blue]`, integers 0 to 255, as all colours |
//! | `vertices` | `[[x, y, z], …]`: x right, y up, z away |
//! | `colors` | `[[red, green, blue], …]`, one a vertex |
//! | `triangles` | `[[a, b, c], …]`, indices of vertices from 0, counter-clockwise as seen in front |
//! | `triangle_colors` | optional: one a triangle, for the whole of it |
//! | `near`, `far` | optional: distances from the eyes to the planes that cut the scene, d/100 and 100 d |
//!
//! Nothing is lit. Triangles without area are legal and draw nothing.

use super::error::{
    read_text, reading, InputError, SceneError, COORDINATE_LIMIT, CORNER_LIMIT, SIZE_LIMIT,
};
use super::locate::Locator;
use super::{Colours, Material, Mesh, Rig, Scene};
use serde::de::{DeserializeOwned, Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::path::Path;

/// Content of the field `format`.
pub const FORMAT: &str = "stereo-scene/1";

/// A colour channel: an integer from 0 to 255.
#[derive(Clone, Copy, Debug)]
pub(super) struct Channel(pub u8);

impl<'de> Deserialize<'de> for Channel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Channel, D::Error> {
        struct Byte;
        impl Visitor<'_> for Byte {
            type Value = Channel;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an integer from 0 to 255")
            }
            fn visit_u64<E: Error>(self, n: u64) -> Result<Channel, E> {
                let wrong = |_| E::invalid_value(Unexpected::Unsigned(n), &self);
                u8::try_from(n).map(Channel).map_err(wrong)
            }
            fn visit_i64<E: Error>(self, n: i64) -> Result<Channel, E> {
                Err(E::invalid_value(Unexpected::Signed(n), &self))
            }
        }
        deserializer.deserialize_u8(Byte)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneFile {
    #[allow(dead_code)] // checked beforehand
    format: String,
    width: u32,
    height: u32,
    pixels_per_unit: f64,
    eye_separation: f64,
    viewing_distance: f64,
    background: [Channel; 3],
    vertices: Vec<[f64; 3]>,
    colors: Vec<[Channel; 3]>,
    triangles: Vec<[u32; 3]>,
    triangle_colors: Option<Vec<[Channel; 3]>>,
    near: Option<f64>,
    far: Option<f64>,
}

/// Reads a JSON text; an error names the line and the field.
pub(super) fn parse<T: DeserializeOwned>(file: &Path, text: &str) -> Result<T, InputError> {
    // A list would be taken for the fields in their order.
    let begin = text.trim_start();
    if begin.starts_with('[') {
        let line = text[..text.len() - begin.len()].matches('\n').count() + 1;
        return Err(InputError::new(file, line, "file", "an object in braces", "a list"));
    }
    let first = match serde_json::from_str(text) {
        Ok(value) => return Ok(value),
        Err(error) => error,
    };
    // Once more, slower, for the path to the value.
    let mut reader = serde_json::Deserializer::from_str(text);
    match serde_path_to_error::deserialize::<_, T>(&mut reader) {
        Ok(_) => Err(broken(file, &first, "")),
        Err(error) => {
            let path = error.path().to_string();
            Err(broken(file, &error.into_inner(), path.trim_end_matches(['.', '?'])))
        }
    }
}

/// An error of serde_json, in our form.
fn broken(file: &Path, error: &serde_json::Error, path: &str) -> InputError {
    let message = error.to_string();
    // The line is said in front.
    let message = message.split(" at line ").next().unwrap_or_default();
    let quoted = message.split('`').nth(1).unwrap_or_default();
    let line = (error.line() > 0).then_some(error.line());
    let new = |field: &str, expected: &str, found: &str| {
        InputError::new(file, line, field, expected, found)
    };
    if error.is_data() {
        if let Some((found, expected)) = message.split_once(", expected ") {
            let found = found.replace("invalid type: ", "").replace("invalid value: ", "");
            let found = found.replace("invalid length ", "length ");
            let field = if path.is_empty() { "file" } else { path };
            return new(field, in_words(expected), &found);
        }
        if message.starts_with("missing field") {
            let field = [path, quoted].join(if path.is_empty() { "" } else { "." });
            return new(&field, "a value", "nothing: the field is missing");
        }
        return new(if path.is_empty() { quoted } else { path }, "one value", message);
    }
    if message == "trailing characters" && !path.is_empty() {
        // All arrays of a fixed length here are of this one.
        return new(path, "3 elements", "more");
    }
    let field = if path.is_empty() { "file" } else { path };
    match message.strip_prefix("expected ") {
        Some("value") => new(field, "a value", "something else: not well-formed JSON"),
        Some(expected) => new(field, expected, "something else: not well-formed JSON"),
        None => new(field, "well-formed JSON", message),
    }
}

/// A Rust type as those know it who write the file.
fn in_words(expected: &str) -> &str {
    match expected {
        "u32" | "u64" | "usize" => "a whole number from 0",
        "f64" => "a number",
        "a boolean" => "true or false",
        _ if expected.starts_with("struct ") => "an object in braces",
        _ if expected.starts_with("a sequence") => "a list in brackets",
        _ => expected,
    }
}

/// Reads a scene file.
pub fn load(file: &Path) -> Result<Scene, SceneError> {
    let _reading = reading(file);
    scene(file, &read_text(file)?)
}

/// Makes a scene of a scene file's text; `file` is its name in messages.
pub fn scene(file: &Path, text: &str) -> Result<Scene, SceneError> {
    check_format(file, text)?;
    let content: SceneFile = parse(file, text)?;
    let rig = Rig {
        pixels_per_unit: content.pixels_per_unit,
        eye_separation: content.eye_separation,
        viewing_distance: content.viewing_distance,
        near: content.near,
        far: content.far,
        ..Rig::default()
    };
    check(&content, &rig, file, text)?;
    let rgb = |colours: Vec<[Channel; 3]>| colours.into_iter().map(|c| c.map(|n| n.0)).collect();
    let mesh = Mesh {
        positions: content.vertices,
        colours: match content.triangle_colors {
            Some(colours) => Colours::Face(rgb(colours)),
            None => Colours::Vertex(rgb(content.colors)),
        },
        triangles: content.triangles,
        ..Mesh::default()
    };
    Ok(Scene {
        width: content.width,
        height: content.height,
        rig,
        background: content.background.map(|c| c.0),
        materials: vec![Material::default()],
        meshes: vec![mesh],
        ..Scene::default()
    })
}

/// Refuses files of another format before any complaint about their fields.
fn check_format(file: &Path, text: &str) -> Result<(), InputError> {
    #[derive(Deserialize)]
    struct Head {
        format: Option<serde_json::Value>,
    }
    if let Ok(Head { format: Some(format) }) = serde_json::from_str(text) {
        if format != FORMAT {
            let line = Locator::new(text).line(&["format"], None);
            let expected = format!("\"{FORMAT}\"");
            return Err(InputError::new(file, line, "format", expected, format.to_string()));
        }
    }
    Ok(())
}

/// Checks that the types do not make.
fn check(content: &SceneFile, rig: &Rig, file: &Path, text: &str) -> Result<(), InputError> {
    let wrong = |field: &str, index: Option<usize>, expected: String, found: String| {
        let line = Locator::new(text).line(&[field], index);
        let field = index.map_or(field.to_string(), |n| format!("{field}[{n}]"));
        Err(InputError::new(file, line, field, expected, found))
    };
    for (field, size) in [("width", content.width), ("height", content.height)] {
        if size == 0 || size > SIZE_LIMIT {
            return wrong(field, None, format!("1 to {SIZE_LIMIT} pixels"), size.to_string());
        }
    }
    rig.check().map_err(|error| error.within(file, text))?;
    let vertices = content.vertices.len();
    let far = |p: &[f64; 3]| !p.iter().all(|n| n.abs() <= COORDINATE_LIMIT);
    if let Some(at) = content.vertices.iter().position(far) {
        let expected = format!("finite coordinates of at most {COORDINATE_LIMIT:e}");
        return wrong("vertices", Some(at), expected, format!("{:?}", content.vertices[at]));
    }
    if content.colors.len() != vertices {
        let expected = format!("one a vertex, {vertices}");
        return wrong("colors", None, expected, content.colors.len().to_string());
    }
    let outside = |t: &[u32; 3]| t.iter().any(|&n| n as usize >= vertices);
    if let Some(at) = content.triangles.iter().position(outside) {
        let expected = format!("indices of {vertices} vertices, counted from 0");
        return wrong("triangles", Some(at), expected, format!("{:?}", content.triangles[at]));
    }
    let triangles = content.triangles.len();
    let most = CORNER_LIMIT / 3;
    if triangles > most {
        return wrong("triangles", None, format!("at most {most}"), triangles.to_string());
    }
    match &content.triangle_colors {
        Some(colours) if colours.len() != triangles => {
            let expected = format!("one a triangle, {triangles}");
            wrong("triangle_colors", None, expected, colours.len().to_string())
        }
        _ => Ok(()),
    }
}
