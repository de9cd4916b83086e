//! The result of a program that ended.

use std::process::ExitStatus;
use std::time::Duration;

/// Output and end of a program.
#[derive(Clone, Debug)]
pub struct Output {
    /// Exit status, or the signal that ended it.
    pub status: ExitStatus,
    /// Its standard output: all of it, or its beginning and end with a line between them.
    pub stdout: Vec<u8>,
    /// Its standard error, likewise.
    pub stderr: Vec<u8>,
    /// True if it was stopped because it had used up its processor time.
    pub is_stopped: bool,
    /// Processor time that it and what it has started have used, where that is limited.
    pub processor: Duration,
}

impl Output {
    /// True if it ended by itself, and well.
    pub fn succeeded(&self) -> bool {
        self.status.success() && !self.is_stopped
    }

    /// Both streams as text; how it ended where it said nothing.
    pub fn said(&self) -> String {
        let text = [&self.stdout[..], &self.stderr[..]].concat();
        let text = String::from_utf8_lossy(&text).trim_end().to_owned();
        match text.trim().is_empty() {
            true => format!("it printed nothing ({})", self.status),
            false => text,
        }
    }
}
