//! Process groups of the children that run, and of those that stay.

use crate::memory;
use rustix::process::{kill_process_group, Pid, Signal};
use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The groups of all children that run.
static LIVE: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

pub(crate) fn live() -> MutexGuard<'static, Vec<Pid>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The groups of those that stay when this process ends.
static LEFT: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

pub(crate) fn left() -> MutexGuard<'static, Vec<Pid>> {
    LEFT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Kills all children, with all that they have started, for good: whoever starts another one or waits for one
/// then waits until this process ends, which must follow.
pub(crate) fn end_all() {
    let live = live();
    for group in live.iter() {
        let _ = kill_process_group(*group, Signal::KILL);
    }
    std::mem::forget(live);
}

/// A child that leads its own process group. It is killed when this is dropped.
pub(crate) struct Group {
    pub child: Child,
    pub id: Pid,
    is_over: bool,
}

impl Group {
    pub fn start(command: &mut Command) -> io::Result<Group> {
        use std::os::unix::process::CommandExt;
        // None is started beside the list of those to be killed.
        let mut live = live();
        let child = command.process_group(0).spawn()?;
        let id = Pid::from_child(&child);
        memory::free(id);
        live.push(id);
        Ok(Group { child, id, is_over: false })
    }

    /// Kills what is left of it.
    pub fn end(&mut self) -> io::Result<ExitStatus> {
        // Its number is its own as long as nobody has waited for it.
        let mut live = live();
        let _ = kill_process_group(self.id, Signal::KILL);
        self.leave(&mut live);
        drop(live);
        self.child.wait()
    }

    /// Leaves it to itself.
    pub fn leave(&mut self, live: &mut Vec<Pid>) {
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
