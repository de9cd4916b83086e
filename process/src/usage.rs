//! Processor time that processes have used.

use rustix::process::Pid;
use std::fs;
use std::time::Duration;

/// Processor time that the processes of a group have used, with those that they have started and waited for.
pub(crate) fn of_group(group: Pid) -> Duration {
    let group = group.as_raw_nonzero().get().to_string();
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let ids = entries.filter(|entry| entry.file_name().as_encoded_bytes()[0].is_ascii_digit());
    let stats = ids.filter_map(|entry| fs::read_to_string(entry.path().join("stat")).ok());
    let ticks: u64 = stats.filter_map(|stat| ticks(&stat, &group)).sum();
    Duration::from_millis(ticks * 1000 / rustix::param::clock_ticks_per_second().max(1))
}

/// The time in a line of `/proc/*/stat`, in ticks, if the process is in the group.
fn ticks(stat: &str, group: &str) -> Option<u64> {
    // The name before it may have spaces and brackets in it. Then: state, parent, group ...
    let (_, rest) = stat.rsplit_once(") ")?;
    let fields: Vec<&str> = rest.split(' ').collect();
    if fields.get(2) != Some(&group) {
        return None;
    }
    // User and system time, of itself and of the children that it has waited for.
    fields.get(11..15)?.iter().map(|field| field.parse::<u64>().ok()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_of_a_group() {
        let stat = "12 (a) b (c) R 1 77 77 0 -1 4194304 100 0 0 0 3 4 50 600 20 0 1 0 1 1 1";
        assert_eq!(ticks(stat, "77"), Some(657));
        assert_eq!(ticks(stat, "1"), None);
    }
}
