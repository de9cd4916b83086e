//! The one way in which the workspace runs other programs.
//!
//! A [`Process`] runs in a process group of its own, with nothing on its standard input but what it is given.
//! It ends: after a limit of time its whole group is killed, and what it has started and left behind goes with
//! it. What it prints is kept up to a bound. Who waits for long is told what for, see [`on_tell`].

mod ending;
mod kept;
mod memory;
mod patience;
mod usage;

pub use ending::{end_now, on_signal, signal_status};
pub use memory::limit_memory;
pub use patience::Patience;
pub use usage::{adopt_orphans, end_orphans, of_thread, Activity};

use kept::Kept;
use rustix::process::{kill_process_group, waitid, Pid, Signal, WaitId, WaitIdOptions};
use std::fmt;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use thiserror::Error;

/// Time that a program may take unless [`set_limit`] says otherwise.
pub const LIMIT: Duration = Duration::from_secs(3600);
/// Time that a program may take to say its version.
pub const ANSWER: Duration = Duration::from_secs(300);
/// Bytes that are kept of each stream of a program unless it is given another number.
pub const KEPT: usize = 2 << 20;
/// Bytes that a program may print beyond what is kept.
const FLOOD: u64 = 256 << 20;
/// Time after which the first message tells what is waited for; each further one after four times as long.
pub const PATIENCE: Duration = Duration::from_secs(10);
/// How often the processor time of a limited program is looked up.
const LOOK: Duration = Duration::from_millis(200);
/// Time that the streams of a program may stay open after its group was killed; a busy machine needs some of it.
const DRAIN: Duration = Duration::from_secs(10);

/// Why a program gave no result.
#[derive(Debug, Error)]
pub enum ProcessError {
    /// It could not be started.
    #[error("cannot run {tool} ({}): {source}", .program.display())]
    Start {
        /// The tool.
        tool: String,
        /// Its program.
        program: PathBuf,
        /// Why.
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
    /// What it works on, or empty.
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

/// What a program said and how it ended.
#[derive(Clone, Debug)]
pub struct Output {
    /// How it ended.
    pub status: ExitStatus,
    /// Its standard output: all of it, or its beginning and end with a line between them.
    pub stdout: Vec<u8>,
    /// Its standard error, likewise.
    pub stderr: Vec<u8>,
    /// Whether it was stopped as it had used up its processor time.
    pub is_stopped: bool,
    /// Processor time that it and what it has started have used, where that is limited.
    pub processor: Duration,
}

impl Output {
    /// Whether it ended by itself, and well.
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

/// A program about to run.
#[derive(Debug)]
pub struct Process<'a> {
    command: &'a mut Command,
    call: Call,
    limit: Limit,
    processor: Option<Duration>,
    input: Option<Vec<u8>>,
    kept: usize,
    patience: Duration,
}

impl<'a> Process<'a> {
    /// The command that runs `tool`, as messages name it.
    pub fn new(tool: impl Into<String>, command: &'a mut Command) -> Process<'a> {
        let call = Call { tool: tool.into(), subject: String::new() };
        Process {
            command,
            call,
            limit: Limit::Common,
            processor: None,
            input: None,
            kept: KEPT,
            patience: PATIENCE,
        }
    }

    /// What it works on, as messages name it.
    pub fn on(mut self, subject: impl Into<String>) -> Process<'a> {
        self.call.subject = subject.into();
        self
    }

    /// Ends with an error after this time or the one of [`set_limit`], whichever is shorter.
    pub fn within(mut self, limit: Duration) -> Process<'a> {
        self.limit = Limit::Own(limit);
        self
    }

    /// Without a limit of time and without messages: for one that limits itself and tells what it does.
    pub fn without_limit(mut self) -> Process<'a> {
        self.limit = Limit::None;
        self
    }

    /// Stops it when it and what it has started have used so much processor time together; that is
    /// no error, see [`Output::is_stopped`].
    pub fn processor(mut self, limit: Duration) -> Process<'a> {
        self.processor = Some(limit);
        self
    }

    /// Its standard input.
    pub fn input(mut self, input: Vec<u8>) -> Process<'a> {
        self.input = Some(input);
        self
    }

    /// Bytes of each stream that are kept in place of [`KEPT`].
    pub fn keep(mut self, bytes: usize) -> Process<'a> {
        self.kept = bytes;
        self
    }

    /// Runs it and keeps what it prints.
    pub fn run(mut self) -> Result<Output, ProcessError> {
        self.command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let (group, events, sender) = self.begin()?;
        let mut group = group;
        let stdout = Kept::drain(group.child.stdout.take(), self.kept, FLOOD, &sender);
        let stderr = Kept::drain(group.child.stderr.take(), self.kept, FLOOD, &sender);
        if let (Some(mut pipe), Some(input)) = (group.child.stdin.take(), self.input.take()) {
            // A program that ends early says why itself.
            thread::spawn(move || drop(pipe.write_all(&input)));
        }
        let end = self.watch(&group, &events);
        let used = self.processor.map(|_| usage::of_group(group.id)).unwrap_or_default();
        let status = group.end();
        let drained = Instant::now() + DRAIN;
        while !(stdout.is_drained() && stderr.is_drained()) {
            let left = drained.saturating_duration_since(Instant::now());
            if left.is_zero() || events.recv_timeout(left).is_err() {
                break;
            }
        }
        let (stdout, stderr) = (stdout.take(), stderr.take());
        let call = self.call.clone();
        match end {
            End::Hung(after) => Err(ProcessError::Hung { call, after }),
            End::Flood => {
                let text = [&stdout[..stdout.len().min(1000)], &stderr[..stderr.len().min(1000)]];
                let text = text.concat();
                let text = String::from_utf8_lossy(&text);
                let lines: Vec<&str> =
                    text.lines().filter(|line| !line.trim().is_empty()).take(4).collect();
                let bytes = FLOOD + self.kept as u64;
                Err(ProcessError::Flood { call, bytes, said: lines.join("\n") })
            }
            End::Ended | End::Stopped => {
                let (status, is_stopped) = (self.ended(status)?, matches!(end, End::Stopped));
                Ok(Output { status, stdout, stderr, is_stopped, processor: used })
            }
        }
    }

    /// Runs it with both streams on the standard error of this process.
    pub fn show(mut self) -> Result<ExitStatus, ProcessError> {
        self.command.stdout(io::stderr()).stderr(Stdio::inherit());
        let (group, events, _sender) = self.begin()?;
        let mut group = group;
        let end = self.watch(&group, &events);
        let status = group.end();
        match end {
            End::Hung(after) => Err(ProcessError::Hung { call: self.call.clone(), after }),
            End::Ended | End::Stopped | End::Flood => self.ended(status),
        }
    }

    /// Starts a program that stays when this one ends, such as a viewer. Tells how it ended if it did so within
    /// `patience`. Its streams are those of the command.
    pub fn launch(mut self, patience: Duration) -> Result<Option<ExitStatus>, ProcessError> {
        let (mut group, events, _sender) = self.begin()?;
        match events.recv_timeout(patience) {
            Ok(_) => self.ended(group.end()).map(Some),
            Err(_) => {
                group.leave(&mut live());
                left().push(group.id);
                Ok(None)
            }
        }
    }

    fn begin(&mut self) -> Result<(Group, Receiver<Event>, Sender<Event>), ProcessError> {
        let stdin = if self.input.is_some() { Stdio::piped() } else { Stdio::null() };
        self.command.stdin(stdin);
        let group = Group::start(self.command).map_err(|source| self.refused(source))?;
        let (sender, events) = mpsc::channel();
        let (id, ended) = (group.id, sender.clone());
        thread::spawn(move || {
            // It is left to be waited for: until then its number belongs to nobody else.
            let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
            while let Err(rustix::io::Errno::INTR) = waitid(WaitId::Pid(id), options) {}
            let _ = ended.send(Event::Ended);
        });
        Ok((group, events, sender))
    }

    fn refused(&self, source: io::Error) -> ProcessError {
        let program = PathBuf::from(self.command.get_program());
        ProcessError::Start { tool: self.call.tool.clone(), program, source }
    }

    fn ended(&self, status: io::Result<ExitStatus>) -> Result<ExitStatus, ProcessError> {
        status.map_err(|source| self.refused(source))
    }

    /// Waits until it is over, one way or another.
    fn watch(&self, group: &Group, events: &Receiver<Event>) -> End {
        let limit = match self.limit {
            Limit::Common => limit(),
            Limit::Own(own) => own.min(limit()),
            Limit::None => Duration::MAX,
        };
        let quiet = matches!(self.limit, Limit::None);
        let (start, mut told) = (Instant::now(), if quiet { Duration::MAX } else { self.patience });
        loop {
            let time = start.elapsed();
            if time >= limit {
                return End::Hung(limit);
            }
            if time >= told {
                told *= 4;
                tell(&self.waiting(time, limit));
            }
            let mut wait = limit.min(told).saturating_sub(time);
            if let Some(processor) = self.processor {
                if usage::of_group(group.id) >= processor {
                    return End::Stopped;
                }
                wait = wait.min(LOOK);
            }
            match events.recv_timeout(wait) {
                Ok(Event::Ended) | Err(RecvTimeoutError::Disconnected) => return End::Ended,
                Ok(Event::Flood) => return End::Flood,
                Ok(Event::Drained) | Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    fn waiting(&self, time: Duration, limit: Duration) -> String {
        let end = match self.processor {
            Some(processor) => format!("{} s of processor time", processor.as_secs()),
            None => format!("{} s, see --timeout", limit.as_secs()),
        };
        format!("waiting for {}: {} s so far; it is stopped after {end}", self.call, time.as_secs())
    }
}

/// How long a program may take.
#[derive(Clone, Copy, Debug)]
enum Limit {
    /// As all do.
    Common,
    /// So long, and no longer than others.
    Own(Duration),
    /// It limits itself.
    None,
}

/// How the wait for a program ended.
enum End {
    Ended,
    Stopped,
    Hung(Duration),
    Flood,
}

/// What is told to who waits for a program.
enum Event {
    /// It ended.
    Ended,
    /// One of its streams did.
    Drained,
    /// It prints without end.
    Flood,
}

/// The groups of all children that run.
static LIVE: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

fn live() -> MutexGuard<'static, Vec<Pid>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The groups of those that stay when this process ends.
static LEFT: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

fn left() -> MutexGuard<'static, Vec<Pid>> {
    LEFT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Kills all children, with all that they have started, for good: whoever starts another one or waits for one
/// then waits until this process ends, which must follow.
fn end_all() {
    let live = live();
    for group in live.iter() {
        let _ = kill_process_group(*group, Signal::KILL);
    }
    std::mem::forget(live);
}

/// A child that leads its own process group. It is killed when this is dropped.
struct Group {
    child: Child,
    id: Pid,
    is_over: bool,
}

impl Group {
    fn start(command: &mut Command) -> io::Result<Group> {
        use std::os::unix::process::CommandExt;
        ending::guard();
        // None is started beside the list of those to be killed.
        let mut live = live();
        let child = command.process_group(0).spawn()?;
        let id = Pid::from_child(&child);
        memory::free(id);
        live.push(id);
        Ok(Group { child, id, is_over: false })
    }

    /// Kills what is left of it.
    fn end(&mut self) -> io::Result<ExitStatus> {
        // Its number is its own as long as nobody has waited for it.
        let mut live = live();
        let _ = kill_process_group(self.id, Signal::KILL);
        self.leave(&mut live);
        drop(live);
        self.child.wait()
    }

    /// Leaves it to itself.
    fn leave(&mut self, live: &mut Vec<Pid>) {
        self.is_over = true;
        live.retain(|group| *group != self.id);
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        if !self.is_over {
            let _ = self.end();
        }
    }
}

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

#[cfg(test)]
mod tests;
