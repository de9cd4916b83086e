//! Errors of running a program.

use std::fmt;
use std::io;
use std::path::PathBuf;
use std::time::Duration;
use thiserror::Error;

/// The reason why a program gave no result.
#[derive(Debug, Error)]
pub enum ProcessError {
    /// It could not be started.
    #[error("cannot run {tool} ({}): {source}", .program.display())]
    Start {
        /// The tool.
        tool: String,
        /// Its program.
        program: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// It did not end.
    #[error(
        "{call} did not end within {} s; it was stopped, with all that it had started; where it needs longer, \
         say so with --timeout SECONDS", .after.as_secs()
    )]
    Hung {
        /// The tool and what it worked on.
        call: Call,
        /// The limit.
        after: Duration,
    },
    /// It printed without end.
    #[error("{call} printed more than {} MiB and was stopped; it began:\n{said}", .bytes >> 20)]
    Flood {
        /// The tool and what it worked on.
        call: Call,
        /// The limit.
        bytes: u64,
        /// Its first lines.
        said: String,
    },
}

/// A tool and what it works on, in words: `g++ on sam_filter`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The tool.
    pub tool: String,
    /// Name of the object that it works on, or empty.
    pub subject: String,
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.subject.as_str() {
            "" => write!(f, "{}", self.tool),
            subject => write!(f, "{} on {subject}", self.tool),
        }
    }
}
