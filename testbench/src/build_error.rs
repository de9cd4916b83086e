//! Errors of building, loading and tracing a model.

use crate::ports::PortError;
use crate::sources;
use crate::tools::ToolError;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;
use wheatstone_golden::files::LockError;
use wheatstone_golden::text::printable_path;
use wheatstone_process::ProcessError;

/// A model could not be built.
#[derive(Debug, Error)]
pub enum BuildError {
    /// A tool is missing or too old.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// A Verilog file could not be read.
    #[error("cannot read {}: {source}", printable_path(.path))]
    Source {
        /// The file or folder.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The cache could not be written.
    #[error("cannot write {}: {source}", printable_path(.path))]
    Cache {
        /// The file or folder.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The module's ports are not those of its interface.
    #[error("{}: {source}", printable_path(.file))]
    Port {
        /// Its Verilog.
        file: PathBuf,
        /// Which port.
        source: PortError,
    },
    /// A tool did not run, or not to its end.
    #[error(transparent)]
    Process(#[from] ProcessError),
    /// A tool refused the module.
    #[error("{tool} failed on {module}:\n{lines}\n(all of it: {})", printable_path(.log))]
    Failed {
        /// Which tool.
        tool: &'static str,
        /// Which module.
        module: String,
        /// The first lines of what it said.
        lines: String,
        /// The file with all of it.
        log: PathBuf,
    },
    /// Another process builds the same and does not come to an end.
    #[error(transparent)]
    Lock(LockError),
    /// The finished model could not be loaded.
    #[error(transparent)]
    Load(#[from] LoadError),
}

/// The file of a module.
pub(crate) fn verilog(rtl: &Path, module: &str) -> PathBuf {
    rtl.join(module).with_extension("v")
}

impl BuildError {
    /// The same in the names of the folder that the Verilog was copied from.
    pub(crate) fn named_from(self, rtl: &Path) -> BuildError {
        match self {
            BuildError::Failed { tool, module, lines, log } => {
                let mut lines = sources::named_from(rtl, &lines);
                let file = verilog(rtl, &module).display().to_string();
                if !lines.contains(&file) {
                    // Where a module is missing, Verilator names no file.
                    lines += &format!("\n(its Verilog: {file})");
                }
                BuildError::Failed { tool, module, lines, log }
            }
            other => other,
        }
    }
}

/// A model could not be loaded or created.
#[derive(Debug, Error)]
pub enum LoadError {
    /// The dynamic linker refused the shared object.
    #[error("cannot load {}: {source}", printable_path(.path))]
    Object {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: libloading::Error,
    },
    /// There is no room for a copy of it.
    #[error("cannot copy {}: {source}", printable_path(.path))]
    Copy {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// The file is not the one that was built.
    #[error("{} is not the model it should be; delete it", printable_path(.path))]
    Stale {
        /// The file.
        path: PathBuf,
    },
    /// The masks of a cycle have 31 bits for the module's streams and 64 for those watched.
    #[error("module {0} has more than 31 streams, or more than 64 that are watched")]
    TooManyStreams(String),
    /// The module stopped before the first clock, or a probe was not found in it.
    #[error("module {module} does not start: {message}")]
    Start {
        /// The module.
        module: String,
        /// The message of the model.
        message: String,
    },
}

/// A trace file could not be opened.
#[derive(Debug, Error)]
#[error("cannot write the waveform {}", printable_path(.path))]
pub struct TraceError {
    /// The file.
    pub path: PathBuf,
    /// The cause, where the system gave one.
    pub source: Option<std::io::Error>,
}
