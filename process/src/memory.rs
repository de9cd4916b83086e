//! Memory limit of this process, its children left out.

use rustix::process::{getrlimit, prlimit, setrlimit, Pid, Resource, Rlimit};
use std::fs;
use std::sync::OnceLock;

/// The limit before, which children have.
static BEFORE: OnceLock<Rlimit> = OnceLock::new();

/// Limits the memory of this process from now on to three quarters of the machine's: what is asked for beyond is
/// refused, instead of taken from everybody else. Memory that is only reserved does not count. A lower limit
/// stays.
pub fn limit_memory() {
    let Some(limit) = machine().map(|bytes| bytes / 4 * 3) else { return };
    let before = getrlimit(Resource::Data);
    if [before.current, before.maximum].into_iter().flatten().all(|there| there > limit) {
        let set = setrlimit(Resource::Data, Rlimit { current: Some(limit), ..before });
        if set.is_ok() {
            let _ = BEFORE.set(before);
        }
    }
}

/// Lifts the limit of a child that was just started.
pub(crate) fn free(child: Pid) {
    if let Some(before) = BEFORE.get() {
        // One that has ended already needs none.
        let _ = prlimit(Some(child), Resource::Data, *before);
    }
}

/// Bytes of memory of this machine.
fn machine() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let kilobytes = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kilobytes: u64 = kilobytes.split_whitespace().next()?.parse().ok()?;
    kilobytes.checked_mul(1024)
}
