//! Waiting for other processes: it is told, and it ends.

use std::io;
use std::sync::OnceLock;
use std::time::Duration;

/// After this time it is told what is waited for.
const PATIENCE: Duration = Duration::from_secs(3);
/// The limit of a program that sets none.
const LIMIT: Duration = Duration::from_secs(60);

static LIMIT_OF_PROGRAM: OnceLock<fn() -> Duration> = OnceLock::new();
static TELL: OnceLock<fn(&str)> = OnceLock::new();

/// Sets how long files and folders that others hold are waited for, and what shows the user a line about it. The first
/// call counts; without one it is a minute, and nothing is shown.
pub fn on_wait(limit: fn() -> Duration, tell: fn(&str)) {
    let _ = LIMIT_OF_PROGRAM.set(limit);
    let _ = TELL.set(tell);
}

/// Time limits of a wait, and the receiver of the line about it.
pub(super) struct Waiting<'a> {
    pub patience: Duration,
    pub limit: Duration,
    pub tell: &'a dyn Fn(&str),
}

impl Waiting<'_> {
    /// As the program has set it.
    pub fn usual() -> Waiting<'static> {
        let limit = LIMIT_OF_PROGRAM.get().map_or(LIMIT, |limit| limit());
        let tell: &dyn Fn(&str) = match TELL.get() {
            Some(tell) => tell,
            None => &|_| (),
        };
        Waiting { patience: PATIENCE, limit, tell }
    }

    /// Waits by `within`, which says whether the wait was over in a time. `whom` says who is waited for and why.
    ///
    /// # Errors
    /// The errors of `within`, and [`io::ErrorKind::TimedOut`] at the limit.
    pub fn wait(
        &self,
        mut within: impl FnMut(Duration) -> io::Result<bool>,
        mut whom: impl FnMut() -> String,
    ) -> io::Result<()> {
        let patience = self.patience.min(self.limit);
        if within(patience)? {
            return Ok(());
        }
        if patience < self.limit {
            (self.tell)(&format!("waiting for {}", whom()));
            if within(self.limit - patience)? {
                return Ok(());
            }
        }
        let message = format!(
            "waited {} s for {}; end it, or say with --timeout SECONDS how long to wait",
            self.limit.as_secs(),
            whom()
        );
        Err(io::Error::new(io::ErrorKind::TimedOut, message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn what_is_waited_for_is_told_once_and_given_up_at_the_limit() {
        let told = RefCell::new(Vec::new());
        let tell = |line: &str| told.borrow_mut().push(line.to_owned());
        let [patience, limit] = [3, 10].map(Duration::from_secs);
        let waiting = Waiting { patience, limit, tell: &tell };
        let mut waits = Vec::new();
        let mut wait = |over_after: usize| {
            waits.clear();
            let within = |time: Duration| {
                waits.push(time.as_secs());
                Ok(waits.len() > over_after)
            };
            (waiting.wait(within, || "x, which has y".into()), waits.clone(), told.take())
        };
        let (at_once, waits, told) = wait(0);
        assert!(at_once.is_ok() && waits == [3] && told.is_empty(), "{waits:?} {told:?}");
        let (in_time, waits, told) = wait(1);
        assert!(in_time.is_ok() && waits == [3, 7], "{waits:?}");
        assert_eq!(told, ["waiting for x, which has y"]);
        let (never, waits, told) = wait(2);
        let error = never.unwrap_err();
        assert_eq!((error.kind(), waits, told.len()), (io::ErrorKind::TimedOut, vec![3, 7], 1));
        assert!(error.to_string().starts_with("waited 10 s for x, which has y; "), "{error}");

        let waiting = Waiting { limit: Duration::from_secs(2), ..waiting };
        assert!(waiting.wait(|time| Ok(time.as_secs() > 2), String::new).is_err());
    }
}
