//! Fields of a manifest that follow from others of it: of a scene as far as it is known without the scene.

use super::origin::{compact, numbers, ranges};
use super::{Manifest, SceneOrigin, Setting};
use crate::cases;
use crate::settings::Settings;
use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::projection::{Kind, Projection};
use wheatstone_golden::scene::{builtin, height_field, Rig, RigFile, Scene, SceneError};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;

/// A field that does not fit the others.
pub(super) struct Contradiction {
    /// Which one.
    pub field: String,
    /// Its value.
    pub found: String,
    /// The value that follows from the others.
    pub expected: String,
}

type Fits = Result<(), Contradiction>;

fn wrong(field: &str, found: impl ToString, expected: impl ToString) -> Contradiction {
    let (found, expected) = (found.to_string(), expected.to_string());
    Contradiction { field: field.into(), found, expected }
}

fn same<T: PartialEq + ToString>(field: &str, found: T, expected: T) -> Fits {
    match found == expected {
        true => Ok(()),
        false => Err(wrong(field, found, expected)),
    }
}

/// Compares what the fields of a manifest, each of them possible, say of each other. `path` names it in messages.
pub(super) fn check(path: &Path, manifest: &Manifest, target: Target, config: &Config) -> Fits {
    let Some(scene) = &manifest.scene else { return check_case(manifest, target, config) };
    same("seed", manifest.seed, 0)?;
    let is_builtin = builtin::SCENES.iter().any(|builtin| builtin.name == scene.name);
    match (is_builtin, &scene.file_blake3) {
        (false, None) => {
            return Err(wrong("scene.file_blake3", "nothing", "the hash of the scene's file"))
        }
        (true, Some(hash)) => {
            let expected = format!("nothing: {} is built in", scene.name);
            return Err(wrong("scene.file_blake3", hash, expected));
        }
        _ => {}
    }
    if scene.polygons == scene.polygons_of {
        same("scene.beats_of", scene.beats_of, scene.beats)?;
    }
    let options = scene.options.iter().filter(|o| !["cull", "wire"].contains(&&*o.name));
    let options = manifest.build.iter().chain(options);
    let options = options.map(|Setting { name, value }| format!("{name}={value}"));
    let settings = Settings::new(&manifest.config, &options.collect::<Vec<String>>())
        .map_err(|error| wrong("scene.options", error, "options that go together"))?;
    for setting in &manifest.statics {
        let expected = match &*setting.name {
            "width" => scene.width.into(),
            "height" => scene.height.into(),
            "single" => settings.options.single.into(),
            "eye" => Eye::Left as u64,
            _ => 0,
        };
        same(&format!("statics.{}", setting.name), setting.value, expected)?;
    }
    let drawn = check_rig(path, scene, manifest)?;
    check_frames(manifest, target, &settings, &drawn)
}

/// A random or directed case is one of those that there are.
fn check_case(manifest: &Manifest, target: Target, config: &Config) -> Fits {
    if manifest.stimulus == "random" {
        return Ok(());
    }
    same("seed", manifest.seed, 0)?;
    let names = cases::directed(target, config).into_iter().map(|case| case.name);
    let names: Vec<String> = names.collect();
    match names.contains(&manifest.case) {
        true => Ok(()),
        false => Err(wrong("case", &manifest.case, names.join(" or "))),
    }
}

/// The rig is what its file and the projection make of it; returns a scene with nothing in it that has this rig.
fn check_rig(
    path: &Path,
    origin: &SceneOrigin,
    manifest: &Manifest,
) -> Result<Scene, Contradiction> {
    let number = |index: usize| {
        origin.rig.get(index).and_then(|setting| setting.value.parse().ok()).unwrap_or(f64::NAN)
    };
    let mut scene = height_field::empty_scene(origin.width, origin.height);
    scene.rig = Rig {
        pixels_per_unit: number(0),
        eye_separation: number(1),
        viewing_distance: number(2),
        near: Some(number(3)),
        far: Some(number(4)),
        head_tilt: number(5),
        projection: Projection::TwoCentres,
    };
    scene.rig.check().map_err(|error| {
        wrong(&format!("scene.rig.{}", error.field), error.found, error.expected)
    })?;
    let colour = manifest.frames.as_ref().map(|frames| frames.colour);
    scene.background = colour.unwrap_or(scene.background);
    let (mut file, mut field) = (RigFile::empty(path), "scene.rig");
    let refused = |field: &str, error: SceneError| match error {
        SceneError::Input(error) => {
            wrong(&format!("{field}.{}", error.field), error.found, error.expected)
        }
        error => wrong(field, error, "what a scene can be drawn with"),
    };
    if let Some(text) = &origin.rig_file {
        field = "scene.rig_file";
        if !text.is_ascii() || compact(text) != *text || text.chars().any(char::is_control) {
            let found = "other characters, or blanks between the parts";
            return Err(wrong(field, found, "printable ASCII characters without blanks"));
        }
        file = RigFile::read(path, text.clone()).map_err(|error| refused(field, error))?;
    }
    // Applied to what it has made already it changes nothing.
    file.apply(&mut scene, None, Kind::named(&origin.projection))
        .map_err(|error| refused(field, error))?;
    for (setting, expected) in origin.rig.iter().zip(numbers(&scene.rig)) {
        same(&format!("scene.rig.{}", setting.name), setting.value.clone(), expected)?;
    }
    let expected = ranges(&scene.rig);
    same("scene.ranges", origin.ranges.len(), expected.len())?;
    for (index, (found, expected)) in origin.ranges.iter().zip(&expected).enumerate() {
        same(&format!("scene.ranges[{index}]"), found.join(", "), expected.join(", "))?;
    }
    if let Some(colour) = colour.filter(|colour| *colour != scene.background) {
        let expected = format!("{:?}, the background of the rig file", scene.background);
        return Err(wrong("frames.colour", format!("{colour:?}"), expected));
    }
    Ok(scene)
}

/// The frame buffers are those of the views and of their arrangement.
fn check_frames(manifest: &Manifest, target: Target, settings: &Settings, scene: &Scene) -> Fits {
    let Some(found) = &manifest.frames else { return Ok(()) };
    let scissor = scene.rig.scissor(scene.width).map_err(|error| {
        wrong(&format!("scene.rig.{}", error.field), error.found, error.expected)
    })?;
    let job = Job {
        config: settings.config,
        options: settings.options,
        width: scene.width,
        height: scene.height,
        background: scene.background,
        scissor,
        polygons: &[],
        textures: &[],
        lookup: settings.lookup,
    };
    let frames = job.frames(target == Target::Minimal);
    let [left, _] = &frames.eyes;
    same("frames.width", found.width, left.width)?;
    same("frames.height", found.height, left.height)?;
    let shown = |open: [[u32; 4]; 2]| format!("{open:?}");
    same("frames.open", shown(found.open), shown(Eye::BOTH.map(|eye| frames.open(eye))))?;
    same("frames.tested", found.tested, frames.is_tested())
}
