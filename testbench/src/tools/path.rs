//! The folders in which programs are looked for.

use crate::workspace;
use std::ffi::OsString;
use std::path::PathBuf;

/// Folder in which the scripts put what comes from PyPI, seen from the workspace's folder.
pub const PYTHON_TOOLS: &str = "target/wheatstone/python";

/// Folder in which the scripts put what cargo installs, seen from the workspace's folder.
const CARGO_TOOLS: &str = "target/wheatstone/cargo";

/// Folder in which tools from PyPI keep what they compile.
pub(crate) fn python_cache() -> Option<PathBuf> {
    Some(workspace::find()?.join(PYTHON_TOOLS).join("cache"))
}

/// The folders in which programs are looked for: those of the variable `PATH`, then the project's own.
pub(crate) fn search_path() -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let bin = |tools| Some(workspace::find()?.join(tools).join("bin"));
    let own = [PYTHON_TOOLS, CARGO_TOOLS].into_iter().filter_map(bin);
    std::env::join_paths(std::env::split_paths(&path).chain(own)).unwrap_or(path)
}
