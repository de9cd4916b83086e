//! Words for who waits.

use crate::{tell, PATIENCE};
use std::time::{Duration, Instant};

/// Tells now and then how far a piece of work is: after ten seconds, and then after four times as long.
#[derive(Debug)]
pub struct Patience {
    start: Instant,
    next: Duration,
}

impl Patience {
    /// The work begins.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Patience {
        Patience { start: Instant::now(), next: PATIENCE }
    }

    /// The work is as far as `text` says, which is told if it is time to.
    pub fn tell(&mut self, text: impl FnOnce() -> String) {
        if self.start.elapsed() >= self.next {
            self.next *= 4;
            tell(&text());
        }
    }
}
