//! The words of the command line: read, and repeated in reports.

use super::{print, Cli, BAD_INPUT};
use clap::Parser;
use std::ffi::OsString;
use wheatstone_golden::text::printable;

/// Reads the command line; where there is nothing to run, says so and gives the exit status.
pub(super) fn parse() -> Result<Cli, u8> {
    let words: Vec<OsString> = std::env::args_os().collect();
    let error = match Cli::try_parse_from(&words) {
        Ok(cli) => return Ok(cli),
        Err(error) => error,
    };
    // The message repeats what it is about: it is made of words that can be shown.
    let shown = words.iter().map(|word| printable(&word.to_string_lossy()));
    match Cli::try_parse_from(shown) {
        Err(shown) if shown.use_stderr() => drop(shown.print()),
        Err(help) => print::check(help.print()),
        Ok(_) => tell!("{error}"),
    }
    Err(u8::try_from(error.exit_code()).unwrap_or(BAD_INPUT))
}

/// The command line, for reports.
pub(super) fn called() -> String {
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    words.collect::<Vec<_>>().join(" ")
}
