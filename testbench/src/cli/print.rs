//! Output of the program: on one line each, without what moves a cursor or hides text, whoever wrote it.
//!
//! A result that could not be printed is an error at the end. A reader that has gone away, as after `head`, is
//! none, and whatever comes on standard error is not worth one.

use super::failure::{BAD_INPUT, OK};
use std::fmt::Arguments;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use wheatstone_golden::text::printable_within;

/// Most characters of a line: more than any table has, less than a file of one line.
const LINE: usize = 5000;

/// Prints a line, or some, on standard output.
macro_rules! say {
    ($($argument:tt)*) => { $crate::cli::print::out(format_args!($($argument)*)) };
}

/// Prints a line of progress or an error, or some, on standard error.
macro_rules! tell {
    ($($argument:tt)*) => { $crate::cli::print::err(format_args!($($argument)*)) };
}

/// True if standard output was closed when the program began: before `main`, the null device takes its place.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Before `main` there is little that may be called; asking the system is.
#[ctor::ctor]
fn look() {
    CLOSED.store(rustix::io::fcntl_getfd(rustix::stdio::stdout()).is_err(), Ordering::Relaxed);
}

/// Says that standard output is closed, if it is.
pub(super) fn closed() -> Option<&'static str> {
    let why =
        "standard output is closed: nothing can be printed; lead it to a file, or to /dev/null";
    CLOSED.load(Ordering::Relaxed).then_some(why)
}

/// The first thing that went wrong with standard output.
static WRONG: Mutex<Option<io::Error>> = Mutex::new(None);

fn wrong() -> MutexGuard<'static, Option<io::Error>> {
    WRONG.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Number of times that something was printed.
static PRINTED: AtomicU64 = AtomicU64::new(0);

/// Number of times that something was printed so far, on either stream.
pub(super) fn printed() -> u64 {
    PRINTED.load(Ordering::Relaxed)
}

pub(super) fn out(text: Arguments<'_>) {
    PRINTED.fetch_add(1, Ordering::Relaxed);
    check(writeln!(io::stdout(), "{}", clean(&text.to_string())));
}

pub(super) fn err(text: Arguments<'_>) {
    PRINTED.fetch_add(1, Ordering::Relaxed);
    let _ = writeln!(io::stderr(), "{}", clean(&text.to_string()));
}

/// Text for a terminal; a tabulator becomes a blank.
pub(super) fn clean(text: &str) -> String {
    let lines = text.split('\n').map(|line| printable_within(&line.replace('\t', " "), LINE));
    lines.collect::<Vec<_>>().join("\n")
}

/// Notes that something could not be printed.
pub(super) fn check(result: io::Result<()>) {
    if let Err(error) = result {
        wrong().get_or_insert(error);
    }
}

/// The exit status of a run that would have this one: if somebody would have read what could not be printed, it is
/// none that went well.
pub(super) fn finish(status: u8) -> u8 {
    check(io::stdout().flush());
    match wrong().take().filter(|error| error.kind() != io::ErrorKind::BrokenPipe) {
        Some(error) => {
            tell!("error: standard output: cannot be written: {error}");
            if status == OK {
                BAD_INPUT
            } else {
                status
            }
        }
        None => status,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cleaned_and_cut() {
        assert_eq!(clean("a\tb\n\u{1b}[2Jc\rd\u{202e}"), "a b\n\u{fffd}[2Jc\u{fffd}d\u{fffd}");
        assert_eq!(clean(&"x".repeat(LINE + 7)).chars().count(), LINE + 1);
    }
}
