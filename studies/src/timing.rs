//! Time as a ratio: two pieces of code side by side in one run.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Time of one piece of code beside that of another.
#[derive(Clone, Copy, Debug)]
pub struct Ratio {
    /// Median of the ratios of neighbouring runs, first : second.
    pub median: f64,
    /// Shortest run of the first.
    pub first: Duration,
    /// Shortest run of the second.
    pub second: Duration,
}

/// Runs two pieces of code in turns, `rounds` times each, and compares their times. Neighbouring
/// runs share what else the machine does, and the median drops the rounds that were disturbed.
pub fn ratio<A, B>(
    rounds: usize,
    mut first: impl FnMut() -> A,
    mut second: impl FnMut() -> B,
) -> Ratio {
    // Once for caches and branch predictors.
    time(&mut first);
    time(&mut second);
    let mut ratios = Vec::new();
    let mut least = [Duration::MAX; 2];
    for round in 0..rounds.max(1) {
        let times = if round % 2 == 0 {
            let one = time(&mut first);
            [one, time(&mut second)]
        } else {
            let two = time(&mut second);
            [time(&mut first), two]
        };
        least = [least[0].min(times[0]), least[1].min(times[1])];
        ratios.push(times[0].as_secs_f64() / times[1].as_secs_f64());
    }
    ratios.sort_by(f64::total_cmp);
    Ratio { median: ratios[ratios.len() / 2], first: least[0], second: least[1] }
}

/// The shortest of some runs of a piece of code.
pub fn shortest<T>(runs: usize, mut code: impl FnMut() -> T) -> Duration {
    (0..runs).map(|_| time(&mut code)).min().unwrap_or_default()
}

fn time<T>(code: &mut impl FnMut() -> T) -> Duration {
    let start = Instant::now();
    black_box(code());
    start.elapsed().max(Duration::from_nanos(1))
}
