//! Common parts of the programs of this crate: options, the program under test, exit statuses.

use std::io;
use std::path::PathBuf;
use std::process::{Command, ExitCode};
use std::time::Duration;
use wheatstone_process::{Output, Process};

/// Time on the clock after which a run counts as one that waits for something that never comes.
pub(crate) const PATIENCE: Duration = Duration::from_secs(600);

/// Options of each of them.
#[derive(Debug, clap::Args)]
pub struct Options {
    /// Seed of what is random
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The program [default: wheatstone beside this one]
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
}

impl Options {
    /// The program under test.
    ///
    /// # Errors
    /// If there is none.
    pub fn program(&self) -> io::Result<PathBuf> {
        let beside = std::env::current_exe()?.with_file_name("wheatstone");
        let program = std::path::absolute(self.program.as_ref().unwrap_or(&beside))?;
        if !program.is_file() {
            let program = program.display();
            let why = format!(
                "{program}: no such program; build it with cargo build, or name one with --program"
            );
            return Err(io::Error::new(io::ErrorKind::NotFound, why));
        }
        Ok(program)
    }
}

/// The workspace, whose Verilog the program reads.
pub fn workspace() -> io::Result<PathBuf> {
    std::path::absolute(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The known names that are wanted; none means all. `what` is the word for such a name in messages.
///
/// # Errors
/// Of a name that is none of them.
pub fn chosen<'a>(wanted: &[String], known: &[&'a str], what: &str) -> io::Result<Vec<&'a str>> {
    if let Some(unknown) = wanted.iter().find(|name| !known.contains(&&name[..])) {
        let why = format!("no {what} “{unknown}”; there are: {}", known.join(", "));
        return Err(io::Error::other(why));
    }
    let is_chosen = |name: &&&str| wanted.is_empty() || wanted.iter().any(|wanted| wanted == *name);
    Ok(known.iter().filter(is_chosen).copied().collect())
}

/// Does the work of a program: exit status 0 if nothing was found, 1 if something was, 2 if it could not be looked for.
pub fn main(work: impl FnOnce() -> io::Result<bool>) -> ExitCode {
    wheatstone_process::on_tell(|line| eprintln!("{line}"));
    match work() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Runs a command to its end.
pub(crate) fn run(name: &str, command: &mut Command) -> io::Result<Output> {
    Process::new(name, command).within(PATIENCE).run().map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_there_is_named() {
        let options = Options { seed: 1, program: Some("/no/wheatstone".into()) };
        let error = options.program().unwrap_err().to_string();
        assert!(error.starts_with("/no/wheatstone: no such program; build it"), "{error}");
        let error = run("strace", &mut Command::new("/no/strace")).unwrap_err().to_string();
        assert!(error.starts_with("cannot run strace (/no/strace): "), "{error}");
        let known = ["obj", "mtl"];
        assert_eq!(chosen(&[], &known, "kind").unwrap(), known);
        assert_eq!(chosen(&["mtl".into()], &known, "kind").unwrap(), ["mtl"]);
        let error = chosen(&["x".into()], &known, "kind").unwrap_err().to_string();
        assert_eq!(error, "no kind “x”; there are: obj, mtl");
    }
}
