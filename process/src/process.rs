//! A program that runs with limits.

use crate::ending;
use crate::error::{Call, ProcessError};
use crate::event::Event;
use crate::group::{left, live, Group};
use crate::kept::Kept;
use crate::limits::{limit, tell, PATIENCE};
use crate::output::Output;
use crate::usage;
use rustix::process::{waitid, WaitId, WaitIdOptions};
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// Bytes that are kept of each stream of a program unless it is given another number.
pub const KEPT: usize = 2 << 20;
/// Bytes that a program may print beyond what is kept.
const FLOOD: u64 = 256 << 20;
/// Time between two looks at the processor time of a limited program.
const LOOK: Duration = Duration::from_millis(200);
/// Time that the streams of a program may stay open after its group was killed; a busy machine needs some of it.
const DRAIN: Duration = Duration::from_secs(10);

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

    /// Names the object that it works on, for messages.
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
        ending::guard();
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

/// Time limit of a program.
#[derive(Clone, Copy, Debug)]
enum Limit {
    /// As all do.
    Common,
    /// So long, and no longer than others.
    Own(Duration),
    /// It limits itself.
    None,
}

/// End of the wait for a program.
enum End {
    Ended,
    Stopped,
    Hung(Duration),
    Flood,
}

#[cfg(test)]
mod tests;
