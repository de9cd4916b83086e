//! Options that several commands take.

use super::failure::Failure;
use super::folders::rtl_folder;
use super::words::{choice, option};
use crate::settings::Settings;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use wheatstone_golden::formats::Formats;
use wheatstone_golden::projection::Kind;
use wheatstone_golden::scene::wires::wire_frame;
use wheatstone_golden::scene::{self, builtin, Cull, Geometry, Scene, SIZE_LIMIT};
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::printable_path;
use wheatstone_studies::volume::Volume;

/// Options that several commands take.
#[derive(Clone, Debug, Args)]
pub(super) struct Common {
    /// Named set of build parameters
    #[arg(long, default_value = "default", value_name = "default|paper|full")]
    pub config: String,
    /// Change one parameter (see `wheatstone list`); may be repeated
    #[arg(long = "param", value_name = "NAME=VALUE")]
    pub parameters: Vec<String>,
    #[command(flatten)]
    pub view: View,
    /// Which faces to leave out
    #[arg(long, value_enum, default_value = "none")]
    pub cull: CullChoice,
    /// Draw the edges of the polygons, one pixel thick, instead of the polygons
    #[arg(long)]
    pub wire: bool,
}

/// The scene, and the eyes that look at it.
#[derive(Clone, Debug, Args)]
pub(super) struct View {
    /// Built-in scene, or a file ending in .obj, .json, .png, .txt or .grid
    #[arg(long, value_name = "NAME|FILE")]
    pub scene: Option<String>,
    /// Size of each view in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Rig file: eyes, screen, placement and light (JSON)
    #[arg(long, value_name = "FILE")]
    pub rig: Option<PathBuf>,
    /// Projection of the scene to the screen (see `wheatstone list`) [default: what the rig file says, or two-centres]
    #[arg(long, value_name = "NAME", value_parser = parse_projection)]
    pub projection: Option<Kind>,
    /// Refuse a scene of which the files say what is not followed, instead of warning
    #[arg(long)]
    pub strict: bool,
}

/// Options of the commands that simulate or make vectors.
#[derive(Clone, Debug, Args)]
pub(super) struct Stimulus {
    /// Seed of random beats, stalls and initial state [default: 1]
    #[arg(long)]
    pub seed: Option<u64>,
    /// Number of random beats of each target
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    pub beats: Option<u64>,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    pub rtl: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum CullChoice {
    /// None
    None,
    /// Faces that an eye sees clockwise
    Back,
}

impl Common {
    pub fn settings(&self) -> Result<Settings, Failure> {
        Ok(Settings::new(&self.config, &self.parameters)?)
    }

    /// A scene from the eyes that the command line chose; tells what the projection leaves out of it.
    pub fn open(&self, name: &str, size: Option<[u32; 2]>) -> Result<Scene, Failure> {
        let scene = self.view.open(name, size)?;
        for warning in Volume::of(&scene, None)?.warnings() {
            tell!("warning: {name}: {warning} (see wheatstone rig)");
        }
        Ok(if self.wire { wire_frame(&scene)? } else { scene })
    }

    /// The polygons of the scene of that name; an error if there are none.
    pub fn geometry(
        &self,
        name: &str,
        size: Option<[u32; 2]>,
        settings: &Settings,
    ) -> Result<Geometry, Failure> {
        drawn(name, self.geometry_of(&self.open(name, size)?, settings)?)
    }

    /// The polygons of a scene for these settings.
    pub fn geometry_of(&self, scene: &Scene, settings: &Settings) -> Result<Geometry, Failure> {
        let cull = match self.cull {
            CullChoice::None => Cull::None,
            CullChoice::Back => Cull::Back,
        };
        let options = scene::Options { cull, specular_threshold: settings.specular_threshold };
        Ok(scene.geometry(&Formats::new(&settings.config), &options)?)
    }

    /// The options as words of a command line.
    pub fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        if self.config != "default" {
            words.extend(option("--config", &self.config));
        }
        words.extend(self.parameters.iter().flat_map(|p| option("--param", p)));
        words.extend(self.view.words());
        words.extend(choice("--cull", self.cull, CullChoice::None));
        if self.wire {
            words.push("--wire".into());
        }
        words
    }
}

impl View {
    /// A scene from these eyes; tells what of its files is not followed.
    pub fn open(&self, name: &str, size: Option<[u32; 2]>) -> Result<Scene, Failure> {
        let scene = scene::open_projected(name, size, self.rig.as_deref(), self.projection)?;
        for warning in scene.warnings.lines() {
            tell!("warning: {warning}");
        }
        let count = scene.warnings.count();
        if self.strict && count > 0 {
            let warnings = if count == 1 { "a warning" } else { "warnings" };
            let name = printable_path(Path::new(name));
            return Err(Failure::Input(format!(
                "{name}: {warnings}, which --strict makes an error; mend the files or leave out --strict"
            )));
        }
        Ok(scene)
    }

    /// The options as words of a command line.
    pub fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        words.extend(self.scene.iter().flat_map(|scene| option("--scene", scene)));
        if let Some([width, height]) = self.size {
            words.extend(option("--size", format!("{width}x{height}")));
        }
        words.extend(self.rig.iter().flat_map(|rig| option("--rig", rig.display())));
        words.extend(self.projection.iter().flat_map(|kind| option("--projection", kind.name())));
        if self.strict {
            words.push("--strict".into());
        }
        words
    }
}

impl Stimulus {
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    /// The folder of the Verilog.
    pub fn rtl(&self) -> Result<PathBuf, Failure> {
        rtl_folder(&self.rtl)
    }
}

pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let legal = parsed.filter(|size| size.iter().all(|n| (1..=SIZE_LIMIT).contains(n)));
    legal.ok_or_else(|| {
        format!("expected WIDTHxHEIGHT in pixels, each from 1 to {SIZE_LIMIT}, for example 640x480")
    })
}

pub(super) fn parse_projection(text: &str) -> Result<Kind, String> {
    let names = Kind::ALL.map(Kind::name).join(", ");
    Kind::named(text).ok_or_else(|| format!("there are: {names}"))
}

pub(super) fn parse_target(text: &str) -> Result<Target, String> {
    let names: Vec<&str> = Target::ALL.iter().map(|t| t.name()).collect();
    let text = text.strip_prefix("sam_").unwrap_or(text);
    Target::named(text).ok_or_else(|| format!("no such target; there are: {}", names.join(", ")))
}

/// The polygons of the scene of that name, for commands to which nothing is no result.
pub(super) fn drawn(name: &str, geometry: Geometry) -> Result<Geometry, Failure> {
    match geometry.counts.nothing() {
        Some(reason) => Err(Failure::Input(format!("{name}: nothing to draw: {reason}"))),
        None => Ok(geometry),
    }
}

/// Names of the built-in scenes.
pub(super) fn builtin_names() -> impl Iterator<Item = &'static str> {
    builtin::SCENES.iter().map(|scene| scene.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_repeated_with_its_projection() {
        use clap::Parser;

        #[derive(Parser)]
        struct Line {
            #[command(flatten)]
            common: Common,
        }
        let words = "x --scene room --rig eyes.json --projection piecewise";
        let line = Line::parse_from(words.split(' '));
        assert_eq!(line.common.words().join(" "), words.trim_start_matches("x "));
        let error = Line::try_parse_from("x --projection none".split(' ')).err();
        assert!(error.is_some_and(|e| e.to_string().contains("two-centres, shear")));
    }
}
