//! What is being simulated: told by a supervisor if this process vanishes, and watched by a thread of its own,
//! as a model that does not come to the end of a clock cannot be called off.

use rustix::thread::gettid;
use std::cell::RefCell;
use std::fs::File;
use std::os::unix::fs::FileExt;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, Once, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;
use wheatstone_golden::files::remove_temporary;

/// Exit status of a run that ended before its work was done.
pub(crate) const UNFINISHED: u8 = 4;

/// Processor time that a clock of a model may take, unless `--timeout` says otherwise: a million times what the
/// largest one needs.
const LIMIT: Duration = Duration::from_secs(20);
/// How often the models are looked at.
const LOOK: Duration = Duration::from_millis(500);

/// A model at work.
struct Entry {
    thread: i32,
    what: String,
    clock: AtomicU64,
    /// The clock that was seen last, and the processor time of the thread then.
    seen: Mutex<Option<(u64, Duration)>>,
}

static RUNNING: Mutex<Vec<Arc<Entry>>> = Mutex::new(Vec::new());

fn running() -> MutexGuard<'static, Vec<Arc<Entry>>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

thread_local! {
    static CASE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Names the case that this thread runs from now on.
pub(crate) fn case(target: &str, name: &str) {
    CASE.set(format!("{target} --case {name}"));
}

/// A model that is watched until this is dropped.
pub(crate) struct Watched(Arc<Entry>);

impl Watched {
    /// Watches a model that this thread runs.
    pub fn new(module: &str) -> Watched {
        static WATCH: Once = Once::new();
        WATCH.call_once(|| drop(thread::spawn(watch)));
        let case = CASE.with_borrow(Clone::clone);
        let what = if case.is_empty() { module.to_owned() } else { case };
        let thread = gettid().as_raw_nonzero().get();
        let entry =
            Arc::new(Entry { thread, what, clock: AtomicU64::new(0), seen: Mutex::new(None) });
        let mut running = running();
        running.push(entry.clone());
        note(&running);
        Watched(entry)
    }

    /// The model has come to another clock.
    #[inline]
    pub fn clock(&self, clock: u64) {
        self.0.clock.store(clock, Ordering::Relaxed);
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        let mut running = running();
        running.retain(|entry| !Arc::ptr_eq(entry, &self.0));
        note(&running);
    }
}

/// Ends the process if a model stays on the same clock.
fn watch() {
    loop {
        thread::sleep(LOOK);
        let limit = wheatstone_process::set().unwrap_or(LIMIT);
        let stuck = running().iter().find(|entry| entry.is_stuck(limit)).cloned();
        if let Some(entry) = stuck {
            let text = format!(
                "error: {}: the model did not come to the end of a clock within {} s of processor time, and was \
                 stopped: is there a loop in which no time passes, such as `forever` without a delay? Where a clock \
                 needs longer, say so with --timeout SECONDS",
                entry.what,
                limit.as_secs()
            );
            if !wheatstone_process::tell(&text) {
                eprintln!("{text}");
            }
            end(UNFINISHED);
        }
    }
}

impl Entry {
    fn is_stuck(&self, limit: Duration) -> bool {
        let Ok(now) = wheatstone_process::of_thread(self.thread) else { return false };
        let clock = self.clock.load(Ordering::Relaxed);
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        match *seen {
            Some((before, then)) if before == clock => now.saturating_sub(then) >= limit,
            _ => {
                *seen = Some((clock, now));
                false
            }
        }
    }
}

/// Where a supervisor reads what this process is at.
static RECORD: OnceLock<File> = OnceLock::new();

/// Bytes of a record: the exit status on a line, then a line for each model at work.
pub(crate) const RECORD_SIZE: usize = 4096;
/// Bytes of its first line, which has spaces in it until the work is done.
const STATUS_SIZE: usize = 4;

/// Keeps a record for a supervisor from now on.
pub(crate) fn record_to(file: File) {
    let _ = RECORD.set(file);
}

fn put(text: &[u8], offset: usize) {
    if let Some(file) = RECORD.get() {
        // Nothing can be done about it here; without a status the run counts as vanished.
        let _ = file.write_all_at(text, offset as u64);
    }
}

fn note(running: &[Arc<Entry>]) {
    if RECORD.get().is_some() {
        let mut text = running.iter().map(|entry| &*entry.what).collect::<Vec<_>>().join("\n");
        text.extend(std::iter::repeat_n(
            '\0',
            (RECORD_SIZE - STATUS_SIZE).saturating_sub(text.len()),
        ));
        put(&text.as_bytes()[..RECORD_SIZE - STATUS_SIZE], STATUS_SIZE);
    }
}

/// Tells a supervisor that the work is done, with this exit status.
pub(crate) fn finish(status: u8) {
    put(format!("{status:3}\n").as_bytes(), 0);
}

/// Ends this process at once, as it is told to, with its children and all that is temporary.
pub(crate) fn end(status: u8) -> ! {
    finish(status);
    wheatstone_process::end_now(status, remove_temporary)
}

/// What a record says: the exit status, and what is simulated.
pub(crate) fn parse(record: &[u8]) -> (Option<u8>, Vec<String>) {
    let (status, rest) = record.split_at(STATUS_SIZE.min(record.len()));
    let status = std::str::from_utf8(status).ok().and_then(|text| text.trim().parse().ok());
    let text = String::from_utf8_lossy(rest);
    let lines = text.trim_matches('\0').lines().map(|line| line.trim_matches('\0').to_owned());
    (status, lines.filter(|line| !line.is_empty()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_without_a_status_is_of_a_run_that_vanished() {
        assert_eq!(parse(b""), (None, vec![]));
        assert_eq!(
            parse(b"\0\0\0\0a --case b\nc\0\0"),
            (None, vec!["a --case b".into(), "c".into()])
        );
        assert_eq!(parse(b"  0\n\0"), (Some(0), vec![]));
        assert_eq!(parse(b"130\n"), (Some(130), vec![]));
    }
}
