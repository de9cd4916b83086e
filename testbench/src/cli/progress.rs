//! What turns in the terminal while something is waited for, and lines beside it.

use super::print::clean;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Whether progress can be drawn over.
pub(super) fn is_terminal() -> bool {
    std::io::stderr().is_terminal()
}

/// The bar or spinner that turns in the terminal, if one does.
static TURNING: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Notes what turns from now on.
pub(super) fn turn(bar: Option<ProgressBar>) {
    *TURNING.lock().unwrap_or_else(PoisonError::into_inner) = bar;
}

/// Leaves no bar on the terminal.
pub(super) fn clear_line() {
    // The thread that turns it may be at it.
    if let Ok(Some(bar)) = TURNING.try_lock().as_deref() {
        bar.finish_and_clear();
    }
}

/// Prints a line without tearing what turns.
pub(super) fn tell_line(text: &str) {
    match &*TURNING.lock().unwrap_or_else(PoisonError::into_inner) {
        Some(bar) => bar.suspend(|| tell!("{text}")),
        None => tell!("{text}"),
    }
}

/// Tells what is being worked on: beside a spinner in a terminal, a line each elsewhere.
pub(super) struct Spinner(Option<ProgressBar>);

impl Spinner {
    pub fn new() -> Spinner {
        let style = ProgressStyle::with_template("{spinner} {wide_msg} {elapsed}");
        let bar = is_terminal().then(ProgressBar::new_spinner);
        if let (Some(bar), Ok(style)) = (&bar, style) {
            bar.set_style(style);
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        turn(bar.clone());
        Spinner(bar)
    }

    pub fn tell(&self, name: &str, description: &str) {
        match &self.0 {
            Some(bar) => bar.set_message(clean(&format!("{name}: {description}"))),
            None => tell!("{name}: {description}"),
        }
    }

    /// Prints without tearing the spinner.
    pub fn print(&self, print: impl FnOnce()) {
        match &self.0 {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
        turn(None);
    }
}
