//! The tools that build a model.

use super::headers::{header, include};
use super::known::{GXX, VERILATOR, ZLIB};
use super::path::search_path;
use super::tool::{Found, ToolError};
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;
use std::process::Command;

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

    /// Checks that the compiler finds zlib, which waveform files need.
    pub(crate) fn check_zlib(&self) -> Result<(), ToolError> {
        header(&GXX, &self.gxx, &self.path, &ZLIB).map(drop)
    }
}
