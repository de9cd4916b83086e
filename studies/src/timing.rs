//! Time as a ratio: two pieces of code side by side in one run.

use crate::Check;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Least speed-up of a form that is never slower by more than 2 %.
const NOT_SLOWER: f64 = 0.981;
/// Part of the work from which saving it must show in time.
const CONSIDERABLE: f64 = 0.1;

/// Time of one piece of code beside that of another.
#[derive(Clone, Copy, Debug)]
pub struct Ratio {
    /// Shortest run of the first.
    pub first: Duration,
    /// Shortest run of the second.
    pub second: Duration,
}

impl Ratio {
    /// The shortest run of the first by that of the second. Of many short runs some are undisturbed even
    /// on a machine that does other things at the same time, so this is what speed-ups are held to.
    pub fn of_shortest(&self) -> f64 {
        self.first.as_secs_f64() / self.second.as_secs_f64()
    }
}

/// Requirement on a speed-up, in a release build: range checks of a debug build are no part of the algorithms.
pub fn at_least(least: f64) -> Check {
    if cfg!(debug_assertions) {
        Check::Trend
    } else {
        Check::AtLeast(least)
    }
}

/// The same of a ratio of times that is the better the smaller it is.
pub fn at_most(most: f64) -> Check {
    if cfg!(debug_assertions) {
        Check::Trend
    } else {
        Check::AtMost(most)
    }
}

/// The least speed-up of a form that saves this part of the work: never slower by more than 2 %, and
/// faster where it saves more than 10 %.
pub fn least_speed_up(saving: f64) -> f64 {
    if saving > CONSIDERABLE {
        1.0
    } else {
        NOT_SLOWER
    }
}

/// Runs two pieces of code in turns, `rounds` times each, and compares their times. Neighbouring
/// runs share what else the machine does.
pub fn ratio<A, B>(
    rounds: usize,
    mut first: impl FnMut() -> A,
    mut second: impl FnMut() -> B,
) -> Ratio {
    let [first, second] =
        turns(rounds, [&mut || drop(black_box(first())), &mut || drop(black_box(second()))]);
    Ratio { first: first.shortest, second: second.shortest }
}

/// Time that a piece of code takes.
#[derive(Clone, Copy, Debug)]
pub struct Spell {
    /// Its shortest run.
    pub shortest: Duration,
    /// By how much the shortest of its even runs differs from that of its odd ones: how well the
    /// shortest is known.
    pub noise: Duration,
}

/// Runs pieces of code in turns, `rounds` times each.
pub fn turns<const N: usize>(rounds: usize, mut codes: [&mut dyn FnMut(); N]) -> [Spell; N] {
    // Once for caches and branch predictors.
    codes.iter_mut().for_each(|code| code());
    let mut least = [[Duration::MAX; 2]; N];
    for round in 0..rounds_in_this_build(rounds) {
        // Another one begins each round, so that none always follows the same one.
        for n in (0..N).map(|n| (n + round) % N) {
            let least = &mut least[n][round % 2];
            *least = time(&mut codes[n]).min(*least);
        }
    }
    least.map(|[even, odd]| {
        // In a single round there is nothing to compare.
        let noise = if odd == Duration::MAX { Duration::ZERO } else { even.abs_diff(odd) };
        Spell { shortest: even.min(odd), noise }
    })
}

/// Times of a debug build are not judged: one round shows that it can be measured.
fn rounds_in_this_build(rounds: usize) -> usize {
    if cfg!(debug_assertions) {
        1
    } else {
        rounds.max(1)
    }
}

/// The shortest of some runs of a piece of code.
pub fn shortest<T>(runs: usize, mut code: impl FnMut() -> T) -> Duration {
    (0..rounds_in_this_build(runs)).map(|_| time(&mut code)).min().unwrap_or_default()
}

fn time<T>(code: &mut impl FnMut() -> T) -> Duration {
    let start = Instant::now();
    black_box(code());
    start.elapsed().max(Duration::from_nanos(1))
}
