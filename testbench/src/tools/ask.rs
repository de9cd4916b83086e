//! A question to a tool that answers with a line.

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, ExitStatus};
use wheatstone_process::{Process, ProcessError, ANSWER};

/// First non-empty line that a program prints on its standard output, or else on standard error, and how it
/// ended.
pub(crate) fn first_line(
    program: &Path,
    arguments: &[&str],
    path: &OsStr,
) -> Result<(Option<String>, ExitStatus), ProcessError> {
    let name = program.file_name().unwrap_or_default().to_string_lossy();
    let mut command = Command::new(program);
    command.args(arguments).env("PATH", path);
    let call = Process::new(name, &mut command).on(arguments.join(" ")).within(ANSWER);
    let output = call.run()?;
    let line = [output.stdout, output.stderr].iter().find_map(|text| {
        let text = String::from_utf8_lossy(text);
        text.lines().map(str::trim).find(|line| !line.is_empty()).map(str::to_owned)
    });
    Ok((line, output.status))
}
