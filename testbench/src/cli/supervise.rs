//! Runs the work of the program in a child process, so that a model which ends or crashes the process that it runs
//! in cannot look like one that passed: without a word of the child that it is done, the run has failed.

use crate::watch::{self, RECORD_SIZE, UNFINISHED};
use rustix::fs::{memfd_create, MemfdFlags};
use rustix::process::{getppid, kill_process, Pid, Signal};
use std::fs::File;
use std::io::{self, IsTerminal};
use std::os::fd::AsRawFd;
use std::os::unix::fs::FileExt;
use std::os::unix::process::CommandExt;
use std::process::{Command, ExitStatus};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;
use wheatstone_process::{adopt_orphans, end_orphans, limit_memory, on_signal, signal_status};

/// Names the record in which a child tells what it is at: a file without a name that the parent has open.
const VARIABLE: &str = "WHEATSTONE_RECORD";
/// Time in which a child that was sent a signal must have ended.
const PATIENCE: Duration = Duration::from_millis(1500);

/// Begins as a child of a supervisor, if this process is one. It dies with its parent.
pub(super) fn is_child() -> bool {
    let Some(path) = std::env::var_os(VARIABLE) else { return false };
    // No tool is a child of this kind.
    std::env::remove_var(VARIABLE);
    let parent = getppid().map_or(0, |parent| parent.as_raw_nonzero().get());
    let is_own = path.to_string_lossy().starts_with(&format!("/proc/{parent}/fd/"));
    let Some(file) = File::options().write(true).open(&path).ok().filter(|_| is_own) else {
        return false;
    };
    let _ = rustix::process::set_parent_process_death_signal(Some(Signal::TERM));
    if getppid().is_none_or(|now| now.as_raw_nonzero().get() != parent) {
        std::process::exit(UNFINISHED.into());
    }
    watch::record_to(file);
    // Models are loaded here: what they start, and take of memory, is theirs alone to have.
    adopt_orphans();
    limit_memory();
    true
}

/// An event that a supervisor waits for.
enum Event {
    Ended(io::Result<ExitStatus>),
    Signal(i32),
}

/// Runs this program again as a child that does the work; gives its exit status.
pub(super) fn supervise() -> u8 {
    match run() {
        Ok(status) => status,
        Err(error) => {
            tell!("error: cannot run this program as a child of itself: {error}");
            UNFINISHED
        }
    }
}

fn run() -> io::Result<u8> {
    let record = File::from(memfd_create("wheatstone", MemfdFlags::CLOEXEC)?);
    // What a child that was killed leaves behind comes to this process.
    adopt_orphans();
    let (sender, events) = mpsc::channel();
    let signals = sender.clone();
    on_signal(move |signal| drop(signals.send(Event::Signal(signal))));
    let own = std::env::current_exe().ok().filter(|own| own.exists());
    let mut command = Command::new(own.unwrap_or_else(|| "/proc/self/exe".into()));
    let mut words = std::env::args_os();
    command.arg0(words.next().unwrap_or_default()).args(words);
    let descriptor = record.as_raw_fd();
    command.env(VARIABLE, format!("/proc/{}/fd/{descriptor}", std::process::id()));
    let mut child = command.spawn()?;
    let id = Pid::from_child(&child);
    thread::spawn(move || drop(sender.send(Event::Ended(child.wait()))));
    let ended = match events.recv() {
        Ok(Event::Ended(ended)) => ended?,
        Ok(Event::Signal(signal)) => {
            if let Some(signal) = Signal::from_named_raw(signal) {
                let _ = kill_process(id, signal);
            }
            // It ends its own children; what it does not end is ended here.
            let _ = events.recv_timeout(PATIENCE);
            end_orphans();
            return Ok(signal_status(signal));
        }
        Err(error) => return Err(io::Error::other(error)),
    };
    let mut text = vec![0; RECORD_SIZE];
    let length = record.read_at(&mut text, 0)?;
    let (status, running) = watch::parse(&text[..length]);
    if let Some(status) = status {
        return Ok(status);
    }
    end_orphans();
    if io::stderr().is_terminal() {
        // The bar of the child may stand on this line.
        tell!("");
    }
    tell!("{}", vanished(ended, &running));
    Ok(UNFINISHED)
}

/// The error of a child that ended before it had done its work.
fn vanished(ended: ExitStatus, running: &[String]) -> String {
    let (when, hint) = match running {
        [] => ("when nothing was simulated".to_owned(), ""),
        [one] => (format!("while this was simulated: {one}"), ""),
        some => (
            format!("while one of these was simulated: {}", some.join(", ")),
            " To find which, run them one at a time, with --jobs 1.",
        ),
    };
    format!(
        "error: the run ended before its work was done ({ended}), {when}\n  Nothing was compared to the end. A \
         model ends the program by calling exit, or by breaking memory in $c or DPI code; the system does \
         for want of memory.{hint}"
    )
}
