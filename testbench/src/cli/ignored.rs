//! Options that a command would ignore: they are errors, as whoever gave them expects something.

use super::*;
use crate::settings::RUN_PARAMETERS;
use wheatstone_golden::config::PARAMETERS;

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

    /// Refuses parameters that make no difference to any of the targets: build parameters that the Verilog
    /// of none has, where no scene is drawn for them, and textures that none shows.
    pub(super) fn refuse_foreign(&self, targets: &[Target]) -> Result<(), Failure> {
        let config = self.settings()?.config;
        let names = || targets.iter().map(|t| t.name()).collect::<Vec<_>>().join(", ");
        let has = |verilog: &str| {
            let parameters = |t: &Target| t.interface(&config).parameters;
            targets.iter().flat_map(parameters).any(|(name, _)| name == verilog)
        };
        let foreign = |name: &&str| match PARAMETERS.iter().find(|p| p.name == *name) {
            Some(parameter) => self.view.scene.is_none() && !has(parameter.verilog),
            // As [`Target::job`] says.
            None if *name == "texture" => targets.iter().all(|t| {
                matches!(t, Target::Traversal | Target::Primary | Target::Mono | Target::Stereo)
            }),
            None => *name == "displays" && targets.iter().all(|t| *t == Target::Mono),
        };
        match self.named().find(foreign) {
            Some(name) => Err(Failure::Input(format!(
                "--param {name}: makes no difference to {}; leave it out",
                names()
            ))),
            None => Ok(()),
        }
    }

    /// Names of the parameters that were given.
    pub(super) fn named(&self) -> impl Iterator<Item = &str> {
        self.parameters.iter().filter_map(|text| text.split_once('=')).map(|(name, _)| name)
    }
}

/// Refuses an option that was given, and says why it would be ignored.
pub(super) fn refuse(option: &str, given: bool, why: &str) -> Result<(), Failure> {
    match given {
        true => Err(Failure::Input(format!("{option}: {why}; leave it out"))),
        false => Ok(()),
    }
}
