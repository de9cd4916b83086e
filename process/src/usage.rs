//! Processes as the system knows them: their parents and groups, and the processor time that they have used.

use crate::group::left;
use rustix::process::{
    getpgrp, getpid, kill_process, kill_process_group, set_child_subreaper, wait, Pid, Signal,
    WaitOptions,
};
use std::fs;
use std::io;
use std::thread;
use std::time::{Duration, Instant};

/// Time in which killed processes must have ended.
const PATIENCE: Duration = Duration::from_secs(1);

/// Processor time and state of a thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Activity {
    /// Processor time that it has used.
    pub processor: Duration,
    /// True if it waits for something other than a processor.
    pub sleeps: bool,
}

/// A line of `/proc/*/stat`.
struct Stat {
    sleeps: bool,
    parent: i32,
    group: i32,
    /// Ticks of user and system time, its own and those of the children that it has waited for.
    ticks: [u64; 4],
}

impl Stat {
    fn parse(line: &str) -> Option<Stat> {
        // The name before it may have spaces and brackets in it. Then: state, parent, group ...
        let (_, rest) = line.rsplit_once(") ")?;
        let fields: Vec<&str> = rest.split(' ').collect();
        let mut ticks = [0; 4];
        for (ticks, field) in ticks.iter_mut().zip(fields.get(11..15)?) {
            *ticks = field.parse().ok()?;
        }
        let id = |n: usize| fields.get(n)?.parse().ok();
        let sleeps = ["S", "D"].contains(fields.first()?);
        Some(Stat { sleeps, parent: id(1)?, group: id(2)?, ticks })
    }
}

/// All processes.
fn all() -> impl Iterator<Item = (i32, Stat)> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    entries.filter_map(|entry| {
        let id = entry.file_name().to_str()?.parse().ok()?;
        Some((id, Stat::parse(&fs::read_to_string(entry.path().join("stat")).ok()?)?))
    })
}

fn time(ticks: u64) -> Duration {
    Duration::from_millis(ticks * 1000 / rustix::param::clock_ticks_per_second().max(1))
}

/// Processor time that the processes of a group have used, with those that they have started and waited for.
pub(crate) fn of_group(group: Pid) -> Duration {
    let group = group.as_raw_nonzero().get();
    let members = all().filter(|(_, stat)| stat.group == group);
    time(members.flat_map(|(_, stat)| stat.ticks).sum())
}

/// Processor time and state of a thread of this process.
pub fn of_thread(id: i32) -> io::Result<Activity> {
    let line = fs::read_to_string(format!("/proc/self/task/{id}/stat"))?;
    let stat = Stat::parse(&line).ok_or(io::ErrorKind::InvalidData)?;
    Ok(Activity { processor: time(stat.ticks[0] + stat.ticks[1]), sleeps: stat.sleeps })
}

/// Makes this process the parent, from now on, of all that a child leaves behind when it ends, whatever group it is in.
pub fn adopt_orphans() {
    // An old kernel cannot: then nothing comes.
    let _ = set_child_subreaper(Some(getpid()));
}

/// Kills all children of this process and what they have started, those too that a child which died has left to it.
/// They are those of the group of this process and of groups of their own. Programs that were launched to stay do.
pub fn end_orphans() {
    let (own, group) = (getpid().as_raw_nonzero().get(), getpgrp().as_raw_nonzero().get());
    let start = Instant::now();
    // Those whose parent was killed come to this process a moment later.
    while start.elapsed() < PATIENCE {
        let stays = |group| Pid::from_raw(group).is_some_and(|group| left().contains(&group));
        let is_to_end = |stat: &Stat| stat.parent == own && !stays(stat.group);
        let children: Vec<(i32, Stat)> = all().filter(|(_, stat)| is_to_end(stat)).collect();
        for (id, stat) in &children {
            let _ = match Pid::from_raw(stat.group).filter(|_| stat.group != group) {
                Some(group) => kill_process_group(group, Signal::KILL),
                None => Pid::from_raw(*id).map_or(Ok(()), |id| kill_process(id, Signal::KILL)),
            };
        }
        if children.is_empty() {
            break;
        }
        while wait(WaitOptions::NOHANG).is_ok_and(|ended| ended.is_some()) {}
        thread::sleep(Duration::from_millis(2));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_of_a_process_is_read() {
        let line = "12 (a) b (c) R 1 77 77 0 -1 4194304 100 0 0 0 3 4 50 600 20 0 1 0 1 1 1";
        let stat = Stat::parse(line).unwrap();
        assert_eq!((stat.parent, stat.group, stat.ticks), (1, 77, [3, 4, 50, 600]));
        assert!(!stat.sleeps, "it runs");
        let sleeps = |state: &str| Stat::parse(&line.replace(" R ", state)).unwrap().sleeps;
        assert_eq!([" S ", " D ", " T ", " Z "].map(sleeps), [true, true, false, false]);
        assert!(Stat::parse("12 (a) R").is_none());
    }
}
