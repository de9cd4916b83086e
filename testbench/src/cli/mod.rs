//! The program `wheatstone`.
//!
//! Its exit statuses are in `failure.rs` and in its help.

#[macro_use]
mod print;

mod baseline;
mod builder;
mod command;
mod compare;
mod cosim;
mod cover;
mod failure;
mod folders;
mod generate;
mod ignored;
mod info;
mod mutate;
mod options;
mod places;
mod progress;
mod prove;
mod records;
mod render;
mod replay;
mod reproduce;
mod rig;
mod supervise;
mod synth;
mod vectors;
mod waves;
mod words;

use crate::watch;
use failure::BAD_INPUT;
use progress::{break_silence, clear_line, tell_line};
use std::process::ExitCode;
use std::time::Duration;
use wheatstone_golden::files;
use wheatstone_golden::progress::Stage;

/// Runs the program.
pub fn main() -> ExitCode {
    if let Some(why) = print::closed() {
        tell!("error: {why}");
        return ExitCode::from(BAD_INPUT);
    }
    let cli = match command::parse() {
        Ok(cli) => cli,
        Err(status) => return ExitCode::from(print::finish(status)),
    };
    let is_child = supervise::is_child();
    if cli.command.is_supervised() && !is_child {
        return ExitCode::from(supervise::supervise());
    }
    wheatstone_process::on_tell(tell_line);
    files::on_wait(wheatstone_process::limit, tell_line);
    wheatstone_process::on_signal(|signal| {
        clear_line();
        watch::end(wheatstone_process::signal_status(signal))
    });
    break_silence();
    // Those that call tools tell what they wait for themselves.
    let _stage = (!is_child).then(|| Stage::new("at work"));
    if let Some(seconds) = cli.timeout {
        wheatstone_process::set_limit(Duration::from_secs(seconds.into()));
    }
    let status = cli.command.run().unwrap_or_else(|failure| {
        tell!("error: {}", failure.told());
        failure.status()
    });
    let status = print::finish(status);
    watch::finish(status);
    ExitCode::from(status)
}
