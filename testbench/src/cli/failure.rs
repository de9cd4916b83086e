//! Failures of commands, and the exit statuses.

use crate::baseline::BaselineError;
use crate::cover::CoverError;
use crate::generated::GenerateError;
use crate::mutation::MutationError;
use crate::pack::PackError;
use crate::record::RecordError;
use crate::regression::RegressionError;
use crate::replay::ReplayError;
use crate::room::is_full;
use crate::settings::SettingError;
use crate::synth::SynthError;
use crate::tools::ToolError;
use crate::BuildError;
use rustix::io::Errno;
use std::error::Error;
use std::io;
use wheatstone_golden::files::WriteError;
use wheatstone_golden::scene::SceneError;
use wheatstone_process::ProcessError;
use wheatstone_studies::StudyError;

/// Everything worked and was equal.
pub(super) const OK: u8 = 0;
/// Something was compared and differs.
pub(super) const MISMATCH: u8 = 1;
/// The input is wrong.
pub(super) const BAD_INPUT: u8 = 2;
/// A tool is missing, or does not run.
pub(super) const MISSING_TOOL: u8 = 3;
/// The run ended before its work was done: a tool or a model did not end, or ended the program.
pub(super) use crate::watch::UNFINISHED;

/// Their meaning, for the help of the program.
pub(super) const STATUSES: &str = "Exit status:
  0    all compared and equal, or done
  1    a mismatch, or worse than recorded
  2    bad input, or it cannot be read or written
  3    a tool is missing, too old, or does not run
  4    the run ended before its work was done: a tool, a model or another run that holds a lock
       did not end in time, or a model ended or crashed the program
  129, 130, 143
       ended by SIGHUP, SIGINT or SIGTERM; programs that it had started are ended too, and nothing
       half done is left";

/// The reason why a command could not do its work.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error(transparent)]
    Setting(#[from] SettingError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Pack(#[from] PackError),
    #[error(transparent)]
    Tool(#[from] ToolError),
    #[error(transparent)]
    Regression(#[from] RegressionError),
    /// Waveforms of a case that was named.
    #[error("waveforms of {0}: {1}")]
    Waves(String, #[source] RegressionError),
    #[error(transparent)]
    Generate(#[from] GenerateError),
    #[error(transparent)]
    Synth(#[from] SynthError),
    #[error(transparent)]
    Replay(#[from] ReplayError),
    #[error(transparent)]
    Cover(#[from] CoverError),
    #[error(transparent)]
    Mutation(#[from] MutationError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error(transparent)]
    Baseline(#[from] BaselineError),
    #[error("{0}")]
    Input(String),
}

impl Failure {
    /// Its message, with a remedy if only the system gives the cause.
    pub(super) fn told(&self) -> String {
        let remedy = system_error(self).and_then(remedy);
        remedy.map_or_else(|| self.to_string(), |remedy| format!("{self}; {remedy}"))
    }

    pub(super) fn status(&self) -> u8 {
        match self {
            _ if has_waited(self) => UNFINISHED,
            Failure::Baseline(BaselineError::Differs { .. }) => MISMATCH,
            Failure::Tool(_)
            | Failure::Replay(ReplayError::Tool(_))
            | Failure::Mutation(MutationError::Tool(_)) => MISSING_TOOL,
            Failure::Synth(error)
            | Failure::Replay(ReplayError::Synth(error))
            | Failure::Mutation(MutationError::Synth(error)) => match error {
                SynthError::Tool(_) => MISSING_TOOL,
                SynthError::Process(error) => of_process(error),
                _ => BAD_INPUT,
            },
            Failure::Regression(error)
            | Failure::Waves(_, error)
            | Failure::Cover(CoverError::Regression(error))
            | Failure::Baseline(BaselineError::Regression(error))
            | Failure::Mutation(MutationError::Regression(error)) => match error {
                RegressionError::Build(error) => of_build(error),
                _ => BAD_INPUT,
            },
            Failure::Replay(ReplayError::Process(error)) => of_process(error),
            _ => BAD_INPUT,
        }
    }
}

/// The error of the system that is the cause, if one is.
fn system_error<'a>(error: &'a (dyn Error + 'static)) -> Option<&'a io::Error> {
    error.downcast_ref().or_else(|| error.source().and_then(system_error))
}

/// The remedy for an error of the system, if one is known.
fn remedy(error: &io::Error) -> Option<&'static str> {
    match error.kind() {
        _ if is_full(error) => Some("make room on that disk and try again"),
        io::ErrorKind::ReadOnlyFilesystem => Some("name a place on a disk that can be written to"),
        io::ErrorKind::NotADirectory => Some("a part of its path is no folder; name another place"),
        _ => match Errno::from_io_error(error)? {
            Errno::FBIG => Some("raise the limit of the size of files (ulimit -f) and try again"),
            Errno::LOOP => Some("a link leads to itself; delete it"),
            Errno::MFILE => Some("raise the limit of open files (ulimit -n) and try again"),
            _ => None,
        },
    }
}

/// True if another process was waited for, for too long.
fn has_waited(error: &(dyn Error + 'static)) -> bool {
    let is_own = |error: &io::Error| error.kind() == io::ErrorKind::TimedOut;
    error.downcast_ref().is_some_and(is_own) || error.source().is_some_and(has_waited)
}

fn of_build(error: &BuildError) -> u8 {
    match error {
        BuildError::Tool(_) => MISSING_TOOL,
        BuildError::Process(error) => of_process(error),
        _ => BAD_INPUT,
    }
}

fn of_process(error: &ProcessError) -> u8 {
    match error {
        ProcessError::Start { .. } => MISSING_TOOL,
        ProcessError::Hung { .. } | ProcessError::Flood { .. } => UNFINISHED,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_system_says_has_a_remedy() {
        let failure = |code: Errno| {
            // As whoever makes temporary files says it.
            let source: io::Error = code.into();
            let source = io::Error::new(source.kind(), format!("{source} at a path"));
            Failure::Synth(SynthError::Write(WriteError { file: "cache".into(), source }))
        };
        let told = failure(Errno::NOSPC).told();
        assert!(told.starts_with("cache: cannot be written: No space left"), "{told}");
        assert!(told.ends_with("; make room on that disk and try again"), "{told}");
        assert_eq!(failure(Errno::NOSPC).status(), BAD_INPUT);
        assert_eq!(failure(Errno::IO).told(), failure(Errno::IO).to_string());
        assert_eq!(Failure::Input("x".into()).told(), "x");
    }
}
