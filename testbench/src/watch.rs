//! Models at work: told by a supervisor if this process vanishes, and watched by a thread of its own,
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
use wheatstone_process::{Activity, PATIENCE};

/// Exit status of a run that ended before its work was done.
pub(crate) const UNFINISHED: u8 = 4;

/// Processor time that a clock of a model may take, unless `--timeout` says otherwise: a million times what the
/// largest one needs.
const LIMIT: Duration = Duration::from_secs(20);
/// Time that the thread of a model may sleep on one clock, unless `--timeout` says otherwise: longer than a slow disk
/// keeps it.
const ASLEEP: Duration = Duration::from_secs(120);
/// Time between two looks at the models.
const LOOK: Duration = Duration::from_millis(500);

/// A model at work.
struct Entry {
    thread: i32,
    what: String,
    clock: AtomicU64,
    stay: Mutex<Stay>,
}

/// Time that a model may stay on one clock.
#[derive(Clone, Copy, Debug)]
struct Limits {
    processor: Duration,
    asleep: Duration,
}

impl Limits {
    fn set() -> Limits {
        let set = wheatstone_process::set();
        Limits { processor: set.unwrap_or(LIMIT), asleep: set.unwrap_or(ASLEEP) }
    }
}

/// A model's stay on a clock. Its times are counted in looks: while the whole process is stopped, or the machine is
/// asleep, nobody waits.
#[derive(Debug, Default)]
struct Stay {
    clock: Option<u64>,
    /// Processor time of the thread when the clock was first seen, and at the last look.
    from: Duration,
    last: Duration,
    /// Time since then, and the end of it in which the thread slept.
    time: Duration,
    asleep: Duration,
    /// The time when it is told next.
    told: Duration,
}

/// The consequence of a stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Finding {
    /// It lasts: tell.
    Long(Duration),
    /// It used up its processor time: end.
    Loops,
    /// The thread sleeps: end.
    Sleeps,
}

impl Stay {
    /// Takes in what is seen at a look. One that is about to run but gets no processor is not asleep.
    fn look(&mut self, clock: u64, seen: Activity, limits: Limits) -> Option<Finding> {
        if self.clock != Some(clock) {
            let (from, last, told) = (seen.processor, seen.processor, PATIENCE);
            *self = Stay { clock: Some(clock), from, last, told, ..Stay::default() };
            return None;
        }
        self.time += LOOK;
        let used = seen.processor.saturating_sub(self.last);
        let sleeps = seen.sleeps && used < LOOK / 10;
        self.asleep = if sleeps { self.asleep + LOOK } else { Duration::ZERO };
        self.last = seen.processor;
        if seen.processor.saturating_sub(self.from) >= limits.processor {
            return Some(Finding::Loops);
        }
        if self.asleep >= limits.asleep {
            return Some(Finding::Sleeps);
        }
        (self.time >= self.told).then(|| {
            self.told *= 4;
            Finding::Long(self.time)
        })
    }
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
            Arc::new(Entry { thread, what, clock: AtomicU64::new(0), stay: Mutex::default() });
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

/// Tells of models that stay on the same clock, and ends the process if one does for too long.
fn watch() {
    loop {
        thread::sleep(LOOK);
        let limits = Limits::set();
        let found = |entry: &Arc<Entry>| Some((entry.clone(), entry.look(limits)?));
        let found: Vec<(Arc<Entry>, Finding)> = running().iter().filter_map(found).collect();
        for (entry, finding) in found {
            let text = told(&entry.what, finding, limits);
            let shown = wheatstone_process::tell(&text);
            if let Finding::Loops | Finding::Sleeps = finding {
                if !shown {
                    eprintln!("{text}");
                }
                end(UNFINISHED);
            }
        }
    }
}

/// The message about a model.
fn told(what: &str, finding: Finding, limits: Limits) -> String {
    let [processor, asleep] = [limits.processor, limits.asleep].map(|limit| limit.as_secs());
    let end = match finding {
        Finding::Long(time) => {
            return format!(
                "waiting for {what}: {} s on one clock of the model so far; it is stopped after {processor} s of \
                 processor time or {asleep} s of sleep, see --timeout",
                time.as_secs()
            )
        }
        Finding::Loops => format!(
            "did not come to the end of a clock within {processor} s of processor time, and was stopped: is there a \
             loop in which no time passes, such as `forever` without a delay?"
        ),
        Finding::Sleeps => format!(
            "has been asleep for {asleep} s on one clock, and was stopped: does it wait for a pipe, a device or \
             another program, as $readmemh of a pipe does?"
        ),
    };
    format!(
        "error: {what}: the model {end} Where a clock needs longer, say so with --timeout SECONDS"
    )
}

impl Entry {
    fn look(&self, limits: Limits) -> Option<Finding> {
        let seen = wheatstone_process::of_thread(self.thread).ok()?;
        let clock = self.clock.load(Ordering::Relaxed);
        self.stay.lock().unwrap_or_else(PoisonError::into_inner).look(clock, seen, limits)
    }
}

/// File in which a supervisor reads what this process is at.
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

/// Ends what models and tools have left behind, and tells a supervisor that the work is done, with this exit status.
pub(crate) fn finish(status: u8) {
    // Without a supervisor there are children that this process has not started: those of a shell that became it.
    if RECORD.get().is_some() {
        wheatstone_process::end_orphans();
    }
    put(format!("{status:3}\n").as_bytes(), 0);
}

/// Ends this process at once, as it is told to, with its children and all that is temporary.
pub(crate) fn end(status: u8) -> ! {
    wheatstone_process::end_now(status, || {
        finish(status);
        remove_temporary();
    })
}

/// Reads a record: the exit status, and what is simulated.
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

    const LIMITS: Limits =
        Limits { processor: Duration::from_secs(20), asleep: Duration::from_secs(120) };

    /// The findings about a stay on one clock, a look after another: the number of the look, from 1, and the finding.
    fn findings(looks: impl IntoIterator<Item = (u64, bool)>) -> Vec<(usize, Finding)> {
        let mut stay = Stay::default();
        let mut found = Vec::new();
        for (n, (milliseconds, sleeps)) in looks.into_iter().enumerate() {
            let seen = Activity { processor: Duration::from_millis(milliseconds), sleeps };
            if let Some(finding) = stay.look(7, seen, LIMITS) {
                found.push((n, finding));
                if !matches!(finding, Finding::Long(_)) {
                    break;
                }
            }
        }
        found
    }

    fn long(looks: usize) -> (usize, Finding) {
        (looks, Finding::Long(LOOK * looks as u32))
    }

    #[test]
    fn a_model_that_loops_or_sleeps_is_told_and_ended() {
        // It has used time before this clock.
        let loops = (0..).map(|n| (5_000 + 500 * n, false));
        assert_eq!(findings(loops), [long(20), (40, Finding::Loops)]);
        // With half a processor it takes twice as long.
        let shared = (0..).map(|n| (250 * n, n % 2 == 0));
        assert_eq!(findings(shared), [long(20), (80, Finding::Loops)]);
        let sleeps = (0..).map(|_| (300, true));
        assert_eq!(findings(sleeps), [long(20), long(80), (240, Finding::Sleeps)]);
        // One that wakes up to sleep on sleeps too.
        let naps = (0..).map(|n| (10 * n, true));
        assert_eq!(findings(naps), [long(20), long(80), (240, Finding::Sleeps)]);
    }

    #[test]
    fn one_that_gets_no_processor_is_told_and_not_ended() {
        let starved = (0..2_000).map(|_| (300, false));
        assert_eq!(findings(starved), [long(20), long(80), long(320), long(1280)]);
        // Nor one that sleeps between its work.
        let works = (0..400).map(|n| (300, n % 100 != 0));
        assert_eq!(findings(works), [long(20), long(80), long(320)]);
    }

    #[test]
    fn another_clock_is_another_stay() {
        let mut stay = Stay::default();
        for clock in 0..10_000 {
            let seen = Activity { processor: Duration::from_millis(500 * clock), sleeps: true };
            assert_eq!(stay.look(clock, seen, LIMITS), None);
        }
    }

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
