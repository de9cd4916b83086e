//! Time limits of programs, and the receiver of lines about a wait.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::OnceLock;
use std::time::Duration;

/// Time that a program may take unless [`set_limit`] says otherwise.
pub const LIMIT: Duration = Duration::from_secs(3600);
/// Time that a program may take to say its version.
pub const ANSWER: Duration = Duration::from_secs(300);
/// Time after which the first message tells what is waited for; each further one after four times as long.
pub const PATIENCE: Duration = Duration::from_secs(10);

/// Milliseconds; 0 for [`LIMIT`].
static SET: AtomicU64 = AtomicU64::new(0);

/// Sets the time that each program may take from now on.
pub fn set_limit(limit: Duration) {
    let milliseconds = u64::try_from(limit.as_millis()).unwrap_or(u64::MAX).max(1);
    SET.store(milliseconds, Ordering::Relaxed);
}

/// The time that a program may take, if one was set.
pub fn set() -> Option<Duration> {
    match SET.load(Ordering::Relaxed) {
        0 => None,
        milliseconds => Some(Duration::from_millis(milliseconds)),
    }
}

/// The time that a program may take.
pub fn limit() -> Duration {
    set().unwrap_or(LIMIT)
}

static TELL: OnceLock<fn(&str)> = OnceLock::new();

/// Sets what shows the user a line; without it, none is shown. The first one counts.
pub fn on_tell(tell: fn(&str)) {
    let _ = TELL.set(tell);
}

/// Shows the user a line, such as what is waited for; tells whether there is a way to.
pub fn tell(text: &str) -> bool {
    TELL.get().map(|tell| tell(text)).is_some()
}
