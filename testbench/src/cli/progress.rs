//! Spinners and bars in the terminal while something is waited for, and lines beside them.

use super::print::{clean, printed};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use wheatstone_golden::progress;
use wheatstone_process::PATIENCE;

/// Time between two looks at the number of printed lines.
const LOOK: Duration = Duration::from_secs(1);

/// True if progress can be drawn over.
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

/// From now on, who hears nothing for long is told how far the work is, where that is known.
pub(super) fn break_silence() {
    let start = Instant::now();
    let mut silence = Silence::new(start.elapsed(), printed());
    let listen = move || loop {
        thread::sleep(LOOK);
        if silence.is_long(start.elapsed(), printed()) {
            if let Some(text) = progress::now() {
                tell_line(&text);
                silence.broken(printed());
            }
        }
    };
    // Without the thread nothing is told, and all else is the same.
    let _ = thread::Builder::new().name("progress".into()).spawn(listen);
}

/// Time in which nothing is printed but by what breaks the silence.
struct Silence {
    /// Number of lines that were printed before.
    lines: u64,
    since: Duration,
    /// Length at which it is broken.
    next: Duration,
}

impl Silence {
    fn new(since: Duration, lines: u64) -> Silence {
        Silence { lines, since, next: PATIENCE }
    }

    /// True if it is so long that something should be told.
    fn is_long(&mut self, now: Duration, lines: u64) -> bool {
        if lines != self.lines {
            *self = Silence::new(now, lines);
        }
        now.saturating_sub(self.since) >= self.next
    }

    /// Something was told: the next time after four times as long.
    fn broken(&mut self, lines: u64) {
        self.lines = lines;
        self.next *= 4;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn silence_is_broken_after_10_and_40_and_160_seconds() {
        let mut silence = Silence::new(Duration::from_secs(1), 5);
        let mut lines = 5;
        let mut told_at = Vec::new();
        for second in 1..=400 {
            // Something else is printed now and then at first, and once later on.
            lines += u64::from([4, 12, 200].contains(&second));
            if silence.is_long(Duration::from_secs(second), lines) {
                lines += 1;
                silence.broken(lines);
                told_at.push(second);
            }
        }
        assert_eq!(told_at, [12 + 10, 12 + 40, 12 + 160, 200 + 10, 200 + 40, 200 + 160]);
    }
}
