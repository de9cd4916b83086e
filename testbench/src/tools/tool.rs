//! A tool: how it is found, and the errors where it cannot be used.

use super::ask::first_line;
use super::path::search_path;
use std::ffi::OsStr;
use std::path::PathBuf;
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

/// A tool, as the test bench knows it before it has looked for it.
#[derive(Debug, PartialEq, Eq)]
pub struct Tool {
    /// Name of the program.
    pub program: &'static str,
    /// The purpose for which it is needed.
    pub purpose: &'static str,
    /// True if co-simulation works without it.
    pub optional: bool,
    /// The oldest version that works.
    pub oldest: Option<Version>,
    /// The Debian packages that have it, or the script that installs it from PyPI.
    pub package: &'static str,
    /// The arguments that make it print its version.
    pub(super) version_arguments: &'static [&'static str],
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

/// A program that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Its path.
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
        /// Its path.
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
        /// Its path.
        program: PathBuf,
    },
    /// It does not answer what it is asked.
    #[error(
        "{} {call}: {why}; install it again with: {}", .program.display(), .tool.install_command()
    )]
    Call {
        /// The tool.
        tool: &'static Tool,
        /// Its path.
        program: PathBuf,
        /// The arguments with which it was called.
        call: String,
        /// The reason why that is no answer.
        why: String,
    },
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
}
