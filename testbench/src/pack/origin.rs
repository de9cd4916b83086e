//! The origin of the vectors of a pack.

use super::text::plain;
use super::{SceneOrigin, Setting};
use crate::cases::Head;
use crate::settings::Settings;
use wheatstone_golden::scene::Rig;
use wheatstone_golden::stereo::Job;

/// Numbers of a rig: those of its file, with `near` and `far` where it has none, and distance between the
/// eyes and distance of the screen on the viewer's side of the projection.
pub(super) const RIG: [&str; 8] = [
    "pixels_per_unit",
    "eye_separation",
    "viewing_distance",
    "near",
    "far",
    "head_tilt",
    "eye_distance",
    "screen_distance",
];

/// The origin of a case, which it does not say of itself.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// Seed of random vectors; none of directed ones and of scenes.
    pub seed: Option<u64>,
    /// Named set of build parameters that the case's are changes of; empty: `default`.
    pub config: String,
    /// The scene.
    pub scene: Option<SceneOrigin>,
    /// Text that the name of the folder has behind the target's.
    pub suffix: &'static str,
}

impl Origin {
    /// Random vectors of a seed.
    pub fn random(seed: u64) -> Origin {
        Origin { seed: Some(seed), ..Origin::default() }
    }
}

/// A scene, and how it was drawn.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// Name of a built-in scene, or file.
    pub name: &'a str,
    /// Content of the file.
    pub file: Option<&'a [u8]>,
    /// Eyes and screen.
    pub rig: &'a Rig,
    /// Text of the rig file.
    pub rig_file: Option<&'a str>,
    /// Choices of the run.
    pub settings: &'a Settings,
    /// Faces turned away were left out.
    pub cull: bool,
    /// Edges were drawn.
    pub wire: bool,
    /// The job of the target.
    pub job: &'a Job<'a>,
}

impl SceneOrigin {
    /// The origin of a scene's beginning.
    pub fn new(drawn: &Drawn, head: &Head) -> SceneOrigin {
        let Drawn { rig, job, settings, .. } = drawn;
        let setting = |(name, value): (&str, String)| Setting { name: name.into(), value };
        let numbers = RIG.into_iter().zip(numbers(rig));
        let cull = if drawn.cull { "back" } else { "none" };
        let wire = if drawn.wire { "on" } else { "off" };
        let options = [("cull", cull), ("wire", wire)].into_iter().chain(settings.choices());
        let options = options.map(|(name, value)| (name, value.to_owned()));
        let ([polygons, polygons_of], [beats, beats_of]) = (head.polygons, head.beats);
        SceneOrigin {
            name: plain(drawn.name),
            file_blake3: drawn.file.map(|content| blake3::hash(content).to_hex().to_string()),
            polygons_blake3: polygons_hash(job),
            width: job.width,
            height: job.height,
            projection: rig.projection.kind().name().into(),
            rig: numbers.map(setting).collect(),
            rig_file: drawn.rig_file.map(compact),
            ranges: ranges(rig),
            options: options.map(setting).collect(),
            polygons,
            polygons_of,
            beats,
            beats_of,
        }
    }
}

/// The numbers of a rig, as [`RIG`] names them.
pub(super) fn numbers(rig: &Rig) -> [String; 8] {
    let viewer = rig.viewer();
    let numbers = [
        rig.pixels_per_unit,
        rig.eye_separation,
        rig.viewing_distance,
        rig.near(),
        rig.far(),
        rig.head_tilt,
        viewer.eye_distance,
        viewer.screen_distance,
    ];
    numbers.map(told)
}

/// Ranges of distances of a rig that are drawn: from and to in the scene, perceived from and to.
pub(super) fn ranges(rig: &Rig) -> Vec<[String; 4]> {
    let ranges = rig.ranges().into_iter().map(|range| {
        let [from, to] = range.perceived();
        [range.near, range.far, from, to].map(told)
    });
    ranges.collect()
}

/// A JSON text without the blanks between its parts; no digit of it changes.
pub(super) fn compact(text: &str) -> String {
    let (mut within, mut escaped) = (false, false);
    let mut is_part = |c: &char| {
        let is_part = within || !c.is_ascii_whitespace();
        within ^= *c == '"' && !escaped;
        escaped = within && *c == '\\' && !escaped;
        is_part
    };
    text.chars().filter(|c| is_part(c)).collect()
}

/// A number that reads back as the same, short where it is very large or small.
fn told(number: f64) -> String {
    let plain = number == 0.0 || !number.is_finite() || (1e-9..1e15).contains(&number.abs());
    if plain {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}

/// Hash of all that is drawn: the polygons, snapped, and their textures.
fn polygons_hash(job: &Job) -> String {
    let mut hasher = blake3::Hasher::new();
    for polygon in job.polygons {
        // Of integers and names alone, in the order of the fields.
        hasher.update(format!("{polygon:?}\n").as_bytes());
    }
    for texture in job.textures {
        hasher.update(format!("{} {}\n", texture.width, texture.height).as_bytes());
        for texel in &texture.texels {
            hasher.update(&texel.0);
        }
    }
    hasher.finalize().to_hex().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rig_file_keeps_all_but_its_blanks() {
        let text = "{ \"a b\" :\n[0.10, -1e-7],\t\"\\\" \\\\\" : \"\" }\n";
        assert_eq!(compact(text), r#"{"a b":[0.10,-1e-7],"\" \\":""}"#);
    }
}
