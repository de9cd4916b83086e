//! The end of this process before its work is done: nothing that it has started is left.

use crate::group::end_all;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;

/// Ends this process at once: kills all children, then cleans up. Another thread that is about to do the same waits
/// for the end.
pub fn end_now(status: u8, clean: impl FnOnce()) -> ! {
    static ENDING: Mutex<()> = Mutex::new(());
    std::mem::forget(ENDING.lock());
    end_all();
    clean();
    signal_hook::low_level::exit(status.into())
}

static IS_SET: AtomicBool = AtomicBool::new(false);

/// Ends the children of this process on a signal, unless [`on_signal`] says what else is to be done: they are in groups
/// of their own, which Ctrl-C does not reach.
pub(crate) fn guard() {
    if !IS_SET.load(Ordering::Relaxed) {
        on_signal(|signal| end_now(signal_status(signal), || ()));
    }
}

/// Calls `end` on the first signal that asks this process to end: SIGINT, SIGTERM or SIGHUP, those that were not
/// ignored when it began, as SIGHUP is under `nohup`. A write beyond the largest size of a file (`ulimit -f`) is from
/// then on an error of that write, not the end of this process.
pub fn on_signal(end: impl FnOnce(i32) + Send + 'static) {
    IS_SET.store(true, Ordering::Relaxed);
    // Of a handler nothing is left in the programs that are started; what is ignored, they ignore too.
    let _ = flag::register(SIGXFSZ, Arc::default());
    let ignored = ignored();
    let asked = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|n| ignored >> (n - 1) & 1 == 0);
    let Ok(mut signals) = Signals::new(asked) else { return };
    thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            end(signal);
        }
    });
}

/// The exit status that tells of a signal, as a shell does.
pub fn signal_status(signal: i32) -> u8 {
    128u8.wrapping_add(signal as u8)
}

/// The signals that this process ignores, a bit each.
fn ignored() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
