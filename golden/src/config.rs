//! Build parameters of the hardware and the named configurations.
//!
//! A [`Config`] is what a Verilog instance is parameterised with. [`PARAMETERS`] is the one
//! list of them: command line, Verilog parameters, vector manifests and documentation all
//! read it.

use core::fmt;

/// Division of the sum of n pixels by n in the box filter (paper, section 5.6.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Division {
    /// 1/n as two powers of two, as published.
    TwoTerm,
    /// 1/n as three powers of two.
    ThreeTerm,
    /// Exact rounded division by a multiplication with the reciprocal.
    Exact,
}

/// Build parameters of the secondary pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// Fraction bits of a snapped vertex: 8 or 4.
    pub subpixel_bits: u32,
    /// Division of the box filter.
    pub division: Division,
    /// Sixteen coverage samples a pixel instead of one.
    pub antialias: bool,
    /// A second set of R, G, B interpolators for view-dependent colour (paper, section 5.5).
    pub integrated: bool,
    /// Depth of the secondary interpolated like an edge function instead of sampled.
    pub interpolated_depth: bool,
    /// Depth tested by the memory instead of by the hybrid system.
    pub external_depth: bool,
    /// Secondary y affine too, for a tilted head (paper, section 5.2).
    pub tilt: bool,
    /// Slots in flight between a background read and the pixel's output: a power of two, 2 to 32.
    pub slots: u32,
}

impl Config {
    /// The configuration for an FPGA: 8 subpixel bits, exact filter, interpolated depth.
    pub const DEFAULT: Config = Config {
        subpixel_bits: 8,
        division: Division::Exact,
        antialias: false,
        integrated: false,
        interpolated_depth: true,
        external_depth: false,
        tilt: false,
        slots: 16,
    };
    /// Configuration of McCann and Lister: 11.14 coordinates, two-term filter, subpixel coverage.
    pub const PAPER: Config = Config {
        subpixel_bits: 4,
        division: Division::TwoTerm,
        antialias: true,
        integrated: false,
        interpolated_depth: false,
        external_depth: false,
        tilt: false,
        slots: 4,
    };
    /// Every option built in.
    pub const FULL: Config = Config {
        subpixel_bits: 8,
        division: Division::Exact,
        antialias: true,
        integrated: true,
        interpolated_depth: true,
        external_depth: false,
        tilt: true,
        slots: 16,
    };

    /// Names of the configurations, in the order they are listed and tested.
    pub const NAMES: [&'static str; 3] = ["default", "paper", "full"];

    /// The configuration of that name.
    pub fn named(name: &str) -> Option<Config> {
        match name {
            "default" => Some(Config::DEFAULT),
            "paper" => Some(Config::PAPER),
            "full" => Some(Config::FULL),
            _ => None,
        }
    }

    /// Value of a Verilog parameter, by its Verilog name.
    pub fn get(&self, verilog: &str) -> Option<u32> {
        Some(match verilog {
            "SUBPIXEL_BITS" => self.subpixel_bits,
            "FILTER_TERMS" => match self.division {
                Division::Exact => 0,
                Division::TwoTerm => 2,
                Division::ThreeTerm => 3,
            },
            "ANTIALIAS" => self.antialias.into(),
            "INTEGRATED" => self.integrated.into(),
            "DEPTH_INTERPOLATED" => self.interpolated_depth.into(),
            "DEPTH_EXTERNAL" => self.external_depth.into(),
            "TILT" => self.tilt.into(),
            "SLOTS" => self.slots,
            _ => return None,
        })
    }

    /// Sets one parameter from its command-line name and value.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), ParameterError> {
        let Some(parameter) = PARAMETERS.iter().find(|p| p.name == name) else {
            return Err(ParameterError::Unknown);
        };
        let index = parameter.values.iter().position(|v| *v == value);
        let Some(index) = index else {
            return Err(ParameterError::Value(parameter));
        };
        match name {
            "subpixel_bits" => self.subpixel_bits = [8, 4][index],
            "filter" => {
                self.division = [Division::Exact, Division::TwoTerm, Division::ThreeTerm][index];
            }
            "antialias" => self.antialias = index == 1,
            "integrated" => self.integrated = index == 1,
            "depth" => self.interpolated_depth = index == 0,
            "depth_test" => self.external_depth = index == 1,
            "tilt" => self.tilt = index == 1,
            _ => self.slots = 2 << index,
        }
        Ok(())
    }

    /// The value of a parameter as the command line spells it.
    pub fn value(&self, parameter: &Parameter) -> &'static str {
        let index = match parameter.name {
            "subpixel_bits" => usize::from(self.subpixel_bits == 4),
            "filter" => match self.division {
                Division::Exact => 0,
                Division::TwoTerm => 1,
                Division::ThreeTerm => 2,
            },
            "antialias" => self.antialias.into(),
            "integrated" => self.integrated.into(),
            "depth" => (!self.interpolated_depth).into(),
            "depth_test" => self.external_depth.into(),
            "tilt" => self.tilt.into(),
            _ => self.slots.trailing_zeros() as usize - 1,
        };
        parameter.values[index]
    }
}

/// One build parameter, as users see it.
#[derive(Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Name on the command line.
    pub name: &'static str,
    /// Name of the Verilog parameter.
    pub verilog: &'static str,
    /// Legal values on the command line.
    pub values: &'static [&'static str],
    /// One line of help.
    pub help: &'static str,
}

/// All build parameters.
pub const PARAMETERS: [Parameter; 8] = [
    Parameter {
        name: "subpixel_bits",
        verilog: "SUBPIXEL_BITS",
        values: &["8", "4"],
        help: "fraction bits of a snapped vertex; sets the width of every coordinate",
    },
    Parameter {
        name: "filter",
        verilog: "FILTER_TERMS",
        values: &["exact", "2", "3"],
        help: "division of the box filter: exact, or 1/n as two or three powers of two",
    },
    Parameter {
        name: "antialias",
        verilog: "ANTIALIAS",
        values: &["off", "on"],
        help: "16 coverage samples a pixel",
    },
    Parameter {
        name: "integrated",
        verilog: "INTEGRATED",
        values: &["off", "on"],
        help: "second set of colour interpolators for view-dependent highlights",
    },
    Parameter {
        name: "depth",
        verilog: "DEPTH_INTERPOLATED",
        values: &["interpolated", "sampled"],
        help: "where the secondary's depth comes from",
    },
    Parameter {
        name: "depth_test",
        verilog: "DEPTH_EXTERNAL",
        values: &["internal", "external"],
        help: "who tests the secondary's depth, the hybrid or the memory",
    },
    Parameter {
        name: "tilt",
        verilog: "TILT",
        values: &["off", "on"],
        help: "affine secondary y, for a tilted head",
    },
    Parameter {
        name: "slots",
        verilog: "SLOTS",
        values: &["2", "4", "8", "16", "32"],
        help: "pixels in flight between background read and output",
    },
];

/// The reason why a parameter was not accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterError {
    /// No parameter has that name.
    Unknown,
    /// The parameter does not take that value.
    Value(&'static Parameter),
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParameterError::Unknown => write!(f, "no build parameter has that name"),
            ParameterError::Value(p) => {
                write!(f, "parameter {} takes one of:", p.name)?;
                p.values.iter().try_for_each(|v| write!(f, " {v}"))
            }
        }
    }
}
