//! Options that a command would ignore: they are errors, as whoever gave them expects something.

use super::failure::Failure;
use super::options::{Common, CullChoice, View};
use crate::settings::RUN_PARAMETERS;
use wheatstone_golden::config::{Config, Parameter, PARAMETERS};
use wheatstone_golden::targets::Target;

impl Common {
    /// Refuses the options of a scene where none is drawn.
    pub(super) fn refuse_scene_options(&self) -> Result<(), Failure> {
        let View { size, rig, projection, strict, .. } = &self.view;
        let options = [
            ("--rig", rig.is_some()),
            ("--projection", projection.is_some()),
            ("--size", size.is_some()),
            ("--cull", self.cull != CullChoice::None),
            ("--wire", self.wire),
            ("--strict", *strict),
        ];
        if let Some((option, _)) = options.into_iter().find(|(_, given)| *given) {
            return Err(Failure::Input(format!(
                "{option}: no scene is drawn; name one with --scene"
            )));
        }
        // Random polygons have random choices; the latency is one of every run.
        let of_scene = RUN_PARAMETERS.iter().filter(|p| p.name != "latency");
        let of_scene: Vec<&str> = of_scene.map(|p| p.name).collect();
        match self.named().find(|name| of_scene.contains(name)) {
            Some(name) => Err(Failure::Input(format!(
                "--param {name}: no scene is drawn; name one with --scene"
            ))),
            None => Ok(()),
        }
    }

    /// Refuses parameters that make no difference to any of the targets: build parameters that change none of
    /// them, where a scene is not made other polygons by them, textures that none shows, the latency of reads
    /// where nothing is read, and the displays and the sampling of secondaries where there are none.
    pub(super) fn refuse_foreign(&self, targets: &[Target]) -> Result<(), Failure> {
        let config = self.settings()?.config;
        let has_scene = self.view.scene.is_some();
        let foreign = |name: &str| match PARAMETERS.iter().find(|p| p.name == name) {
            Some(parameter) => {
                (!has_scene || PARTS.contains(&name)) && !changes(parameter, &config, targets)
            }
            // As [`Target::job`] says.
            None if name == "texture" => targets.iter().all(|t| {
                matches!(t, Target::Traversal | Target::Primary | Target::Mono | Target::Stereo)
            }),
            None if name == "latency" => targets.iter().all(|t| {
                t.interface(&config).streams.iter().all(|stream| stream.answers.is_none())
            }),
            // Nothing is derived there, and each eye's pixels go to the eye's own stream.
            None => {
                ["displays", "sampling"].contains(&name)
                    && targets
                        .iter()
                        .all(|t| matches!(t, Target::Traversal | Target::Primary | Target::Mono))
            }
        };
        refuse_parameters(&self.parameters, foreign, &listed(targets))
    }

    /// Refuses some parameters, which make no difference to what is named.
    pub(super) fn refuse_parameters(&self, ignored: &[&str], what: &str) -> Result<(), Failure> {
        refuse_parameters(&self.parameters, |name| ignored.contains(&name), what)
    }

    /// Names of the parameters that were given.
    pub(super) fn named(&self) -> impl Iterator<Item = &str> {
        names(&self.parameters)
    }
}

/// Build parameters of parts that work on what was planned already.
const PARTS: [&str; 3] = ["filter", "depth_test", "slots"];

/// Refuses parameters that do not change what is built of targets.
pub(super) fn refuse_unbuilt(
    parameters: &[String],
    config: &Config,
    targets: &[Target],
) -> Result<(), Failure> {
    let unbuilt = |name: &str| {
        let parameter = PARAMETERS.iter().find(|p| p.name == name);
        parameter.is_none_or(|parameter| !changes(parameter, config, targets))
    };
    refuse_parameters(parameters, unbuilt, &format!("what is built of {}", listed(targets)))
}

/// True if a build parameter changes the Verilog parameters or the ports of any of these.
fn changes(parameter: &Parameter, config: &Config, targets: &[Target]) -> bool {
    let mut configs = parameter.values.iter().filter_map(|value| {
        let mut other = *config;
        other.set(parameter.name, value).ok().map(|()| other)
    });
    configs.any(|other| targets.iter().any(|t| t.interface(&other) != t.interface(config)))
}

fn refuse_parameters(
    parameters: &[String],
    ignored: impl Fn(&str) -> bool,
    what: &str,
) -> Result<(), Failure> {
    match names(parameters).find(|name| ignored(name)) {
        Some(name) => Err(Failure::Input(format!(
            "--param {name}: makes no difference to {what}; leave it out"
        ))),
        None => Ok(()),
    }
}

fn names(parameters: &[String]) -> impl Iterator<Item = &str> {
    parameters.iter().filter_map(|text| text.split_once('=')).map(|(name, _)| name)
}

fn listed(targets: &[Target]) -> String {
    targets.iter().map(|t| t.name()).collect::<Vec<_>>().join(", ")
}

/// Refuses an option that was given, and says why it would be ignored.
pub(super) fn refuse(option: &str, given: bool, why: &str) -> Result<(), Failure> {
    match given {
        true => Err(Failure::Input(format!("{option}: {why}; leave it out"))),
        false => Ok(()),
    }
}
