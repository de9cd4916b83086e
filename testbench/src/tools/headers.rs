//! Questions to tools about the files that come with them.

use super::ask::first_line;
use super::known::VERILATOR;
use super::tool::{Found, Tool, ToolError};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use wheatstone_process::{Process, ANSWER};

/// Verilator's folder with the C++ headers and sources that every model uses.
pub(crate) fn include(verilator: &Found, path: &OsStr) -> Result<PathBuf, ToolError> {
    let call = ["--getenv", "VERILATOR_ROOT"];
    let answer = first_line(&verilator.program, &call, path).map_err(|error| error.to_string());
    let root = answer.and_then(|(root, status)| {
        let root = root.ok_or(format!("it printed nothing ({status})"))?;
        let include = Path::new(&root).join("include");
        let is_there = include.join("verilated.cpp").is_file();
        is_there
            .then_some(include)
            .ok_or(format!("it printed “{root}”, where no include/verilated.cpp is"))
    });
    root.map_err(|why| ToolError::Call {
        tool: &VERILATOR,
        program: verilator.program.clone(),
        call: call.join(" "),
        why,
    })
}

/// Asks a compiler for the header that a tool stands for.
pub(crate) fn header(
    compiler: &'static Tool,
    found: &Found,
    path: &OsStr,
    header: &'static Tool,
) -> Result<PathBuf, ToolError> {
    let call = ["-E", "-M", "-x", "c++", "-include", header.program, "/dev/null"];
    let refused = |why| ToolError::Call {
        tool: compiler,
        program: found.program.clone(),
        call: call.join(" "),
        why,
    };
    let mut command = Command::new(&found.program);
    // What it says is to be understood here.
    command.args(call).env("PATH", path).env("LC_ALL", "C");
    let process = Process::new(compiler.program, &mut command).on(header.program).within(ANSWER);
    let output = process.run().map_err(|error| refused(error.to_string()))?;
    let said = output.said();
    if !output.succeeded() {
        // The words of GCC and those of Clang.
        let says_so = |line: &str| {
            let missing = line.contains("No such file") || line.contains("file not found");
            missing && line.contains(header.program)
        };
        return Err(match said.lines().any(says_so) {
            true => ToolError::Missing(header),
            false => refused(said.lines().next().unwrap_or_default().to_owned()),
        });
    }
    let end = format!("/{}", header.program);
    let file = said.split_whitespace().find(|word| word.ends_with(&end));
    file.map(PathBuf::from).ok_or_else(|| refused(format!("it did not say where {end} is")))
}
