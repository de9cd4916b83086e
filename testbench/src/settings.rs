//! Choices of the command line: build parameters of the hardware and choices of a run.

use thiserror::Error;
use wheatstone_golden::config::{Config, Parameter, ParameterError, PARAMETERS};
use wheatstone_golden::scene::{self, Geometry};
use wheatstone_golden::setup::{Arrangement, Options, Sampling, Specular};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// Choices of a run that are not built into the hardware, as the command line names them.
pub const RUN_PARAMETERS: [Parameter; 8] = [
    run(
        "cost_rule",
        &["on", "off"],
        "draw monocular where deriving takes more beats; off: derive wherever possible",
    ),
    run(
        "specular",
        &["exception", "approximation", "integrated"],
        "highlights that the eyes see differently",
    ),
    run(
        "specular_threshold",
        &["2", "0", "1", "4", "8", "16", "32", "64"],
        "largest difference between the eyes' colours of a corner that is no highlight",
    ),
    run(
        "sampling",
        &["automatic", "nearest", "average"],
        "colour of a secondary pixel; automatic averages textures only",
    ),
    run(
        "display",
        &["normal", "flipped", "interleaved", "above-below", "rotated"],
        "arrangement of the views",
    ),
    run("displays", &["2", "1"], "both eyes to a display each, or to one"),
    run("texture", &["nearest", "bilinear"], "lookup of texels in the primary pipeline"),
    run(
        "latency",
        &["random", "1", "2", "4", "8", "16", "32"],
        "clocks from a background read to its answer",
    ),
];

/// Values of `specular_threshold`, in the order of the command line.
const THRESHOLDS: [u8; 8] = [2, 0, 1, 4, 8, 16, 32, 64];

const fn run(name: &'static str, values: &'static [&'static str], help: &'static str) -> Parameter {
    Parameter { name, verilog: "", values, help }
}

/// A configuration and the choices of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Build parameters.
    pub config: Config,
    /// Choices of setup.
    pub options: Options,
    /// Largest difference between the eyes' colours of a corner that is no highlight.
    pub specular_threshold: u8,
    /// Lookup of texels.
    pub lookup: Lookup,
    /// Clocks from a background read to its answer; random where none is fixed.
    pub latency: Option<u64>,
}

/// A setting that does not exist or is not possible.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum SettingError {
    /// No such configuration.
    #[error("--config {0}: no such configuration; there are: {list}", list = Config::NAMES.join(", "))]
    Config(String),
    /// Not of the form NAME=VALUE.
    #[error("--param {0}: expected NAME=VALUE")]
    Form(String),
    /// No such parameter.
    #[error("--param {name}={value}: no parameter has this name; there are: {list}", list = names())]
    Unknown {
        /// Name that was given.
        name: String,
        /// Value that was given.
        value: String,
    },
    /// The parameter takes other values.
    #[error("--param {name}={value}: {name} takes one of: {values}")]
    Value {
        /// Name that was given.
        name: String,
        /// Value that was given.
        value: String,
        /// Legal values.
        values: String,
    },
    /// A choice needs hardware that is not built in.
    #[error("--param specular=integrated needs colour interpolators: add --param integrated=on or --config full")]
    NotIntegrated,
}

fn names() -> String {
    let all = PARAMETERS.iter().chain(&RUN_PARAMETERS);
    all.map(|p| p.name).collect::<Vec<_>>().join(", ")
}

impl Settings {
    /// The job that draws the polygons of a scene.
    pub fn job<'a>(&self, geometry: &'a Geometry) -> Job<'a> {
        Job::of(geometry, self.config, self.options, self.lookup)
    }

    /// The settings of a named configuration with parameters changed, each `NAME=VALUE`.
    pub fn new<S: AsRef<str>>(config: &str, parameters: &[S]) -> Result<Settings, SettingError> {
        let mut built = Config::named(config).ok_or_else(|| SettingError::Config(config.into()))?;
        let mut choices = Vec::new();
        for parameter in parameters {
            let text = parameter.as_ref();
            let (name, value) =
                text.split_once('=').ok_or_else(|| SettingError::Form(text.into()))?;
            let refused = |values: &[&str]| SettingError::Value {
                name: name.into(),
                value: value.into(),
                values: values.join(", "),
            };
            match built.set(name, value) {
                Ok(()) => continue,
                Err(ParameterError::Value(parameter)) => return Err(refused(parameter.values)),
                Err(ParameterError::Unknown) => {}
            }
            let Some(parameter) = RUN_PARAMETERS.iter().find(|p| p.name == name) else {
                return Err(SettingError::Unknown { name: name.into(), value: value.into() });
            };
            let index = parameter.values.iter().position(|v| *v == value);
            choices.push((name.to_owned(), index.ok_or_else(|| refused(parameter.values))?));
        }
        let mut settings = Settings {
            config: built,
            options: Options::new(&built),
            specular_threshold: scene::Options::default().specular_threshold,
            lookup: Lookup::Nearest,
            latency: None,
        };
        for (name, index) in choices {
            settings.choose(&name, index);
        }
        if settings.options.specular == Specular::Integrated && !built.integrated {
            return Err(SettingError::NotIntegrated);
        }
        Ok(settings)
    }

    /// The choices of a run that have a name and a value on the command line, but for the latency, in the order
    /// of [`RUN_PARAMETERS`].
    pub fn choices(&self) -> Vec<(&'static str, &'static str)> {
        let options = &self.options;
        let index = |name: &str| match name {
            "cost_rule" => usize::from(!options.cost_rule),
            "specular" => match options.specular {
                Specular::Exception => 0,
                Specular::Approximation => 1,
                Specular::Integrated => 2,
            },
            "specular_threshold" => {
                THRESHOLDS.iter().position(|&n| n == self.specular_threshold).unwrap_or_default()
            }
            "sampling" => options.sampling as usize,
            "display" => options.arrangement as usize,
            "displays" => usize::from(options.single),
            _ => usize::from(self.lookup == Lookup::Bilinear),
        };
        let all = RUN_PARAMETERS.iter().filter(|p| p.name != "latency");
        all.map(|p| (p.name, p.values[index(p.name)])).collect()
    }

    fn choose(&mut self, name: &str, index: usize) {
        let options = &mut self.options;
        match name {
            "cost_rule" => options.cost_rule = index == 0,
            "specular" => {
                options.specular =
                    [Specular::Exception, Specular::Approximation, Specular::Integrated][index];
            }
            "specular_threshold" => {
                self.specular_threshold = THRESHOLDS[index];
            }
            "sampling" => {
                options.sampling =
                    [Sampling::Automatic, Sampling::Nearest, Sampling::Average][index];
            }
            "display" => {
                options.arrangement = [
                    Arrangement::Normal,
                    Arrangement::Flipped,
                    Arrangement::Interleaved,
                    Arrangement::AboveBelow,
                    Arrangement::Rotated,
                ][index];
            }
            "displays" => options.single = index == 1,
            "texture" => self.lookup = [Lookup::Nearest, Lookup::Bilinear][index],
            _ => self.latency = (index > 0).then(|| 1 << (index - 1)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_applied_and_refused_by_name() {
        let message =
            |parameter: &str| Settings::new("default", &[parameter]).unwrap_err().to_string();
        assert!(message("slots").contains("expected NAME=VALUE"));
        assert!(message("slot=4").contains("there are: subpixel_bits, filter"));
        assert!(message("slots=5").contains("takes one of: 2, 4, 8, 16, 32"));
        assert!(message("specular=integrated").contains("integrated=on"));
        assert!(Settings::new("fast", &["a=b"])
            .unwrap_err()
            .to_string()
            .contains("default, paper, full"));
        let settings = Settings::new("paper", &["slots=32", "cost_rule=off", "latency=8"]).unwrap();
        assert_eq!((settings.config.slots, settings.latency), (32, Some(8)));
        assert!(!settings.options.cost_rule);
        for parameter in PARAMETERS.iter().chain(&RUN_PARAMETERS) {
            for value in parameter.values {
                let text = [format!("{}={value}", parameter.name)];
                let settings = Settings::new("full", &text);
                let clash = (parameter.name, *value) == ("integrated", "off");
                assert!(settings.is_ok() || clash, "{text:?}");
                let chosen =
                    settings.is_ok_and(|s| s.choices().contains(&(parameter.name, *value)));
                let run = RUN_PARAMETERS.contains(parameter) && parameter.name != "latency";
                assert_eq!(chosen, run, "{text:?}");
            }
        }
        for parameter in &PARAMETERS {
            for value in parameter.values {
                let mut config = Config::DEFAULT;
                config.set(parameter.name, value).unwrap();
                assert_eq!(config.value(parameter), *value);
            }
        }
    }
}
