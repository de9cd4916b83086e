//! The one way in which the workspace runs other programs.
//!
//! A [`Process`] runs in a process group of its own, with nothing on its standard input but what it is given.
//! It ends: after a limit of time its whole group is killed, and what it has started and left behind goes with
//! it. What it prints is kept up to a bound. Who waits for long is told what for, see [`on_tell`].

mod ending;
mod error;
mod event;
mod group;
mod kept;
mod limits;
mod memory;
mod output;
mod process;
mod usage;

pub use ending::{end_now, on_signal, signal_status};
pub use error::{Call, ProcessError};
pub use limits::{limit, on_tell, set, set_limit, tell, ANSWER, LIMIT, PATIENCE};
pub use memory::limit_memory;
pub use output::Output;
pub use process::{Process, KEPT};
pub use usage::{adopt_orphans, end_orphans, of_thread, Activity};
