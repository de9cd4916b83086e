//! Stall patterns: on which clocks an input may begin to offer a beat, and on which an output
//! is ready. Generated before a run; a run only looks bits up.

use bitvec::prelude::{BitVec, Lsb0};
use fastrand::Rng;

/// Frequency with which the test bench holds a stream up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Pattern {
    /// Never.
    #[default]
    None,
    /// On a random quarter of the clocks.
    Random25,
    /// On a random half of the clocks.
    Random50,
    /// On a random three quarters of the clocks.
    Random75,
    /// In runs of up to 32 clocks, between runs of up to 32 clocks without.
    Bursts,
    /// On single clocks, up to 16 clocks apart.
    Gaps,
    /// Of outputs alone: until the beat was offered for a clock. `valid` must not wait for `ready`, so
    /// every beat comes none the less; what waits hangs.
    UntilValid,
}

impl Pattern {
    /// Patterns that inputs can have.
    pub const IDLE: [Pattern; 6] = [
        Pattern::None,
        Pattern::Random25,
        Pattern::Random50,
        Pattern::Random75,
        Pattern::Bursts,
        Pattern::Gaps,
    ];
    /// Patterns that outputs can have: all, the inputs' first.
    pub const BACK_PRESSURE: [Pattern; 7] = {
        let [a, b, c, d, e, f] = Pattern::IDLE;
        [a, b, c, d, e, f, Pattern::UntilValid]
    };

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Pattern::None => "none",
            Pattern::Random25 => "random25",
            Pattern::Random50 => "random50",
            Pattern::Random75 => "random75",
            Pattern::Bursts => "bursts",
            Pattern::Gaps => "gaps",
            Pattern::UntilValid => "until_valid",
        }
    }

    /// The pattern of that name.
    pub fn named(name: &str) -> Option<Pattern> {
        Pattern::BACK_PRESSURE.into_iter().find(|pattern| pattern.name() == name)
    }

    /// For every clock whether the stream may go on, as far as the clock tells; `clocks` is a multiple of 64.
    fn bits(self, clocks: usize, random: &mut Rng) -> BitVec<u64, Lsb0> {
        let words = |word: &mut dyn FnMut() -> u64| {
            BitVec::from_vec((0..clocks / 64).map(|_| word()).collect())
        };
        match self {
            Pattern::None | Pattern::UntilValid => words(&mut || u64::MAX),
            Pattern::Random25 => words(&mut || random.u64(..) | random.u64(..)),
            Pattern::Random50 => words(&mut || random.u64(..)),
            Pattern::Random75 => words(&mut || random.u64(..) & random.u64(..)),
            Pattern::Bursts => runs(clocks, || (random.usize(1..=32), random.usize(1..=32))),
            Pattern::Gaps => runs(clocks, || (random.usize(1..=16), 1)),
        }
    }
}

/// Runs of ones and of zeros, by turns.
fn runs(clocks: usize, mut lengths: impl FnMut() -> (usize, usize)) -> BitVec<u64, Lsb0> {
    let mut bits = BitVec::with_capacity(clocks + 64);
    while bits.len() < clocks {
        let (ones, zeros) = lengths();
        bits.resize(bits.len() + ones, true);
        bits.resize(bits.len() + zeros, false);
    }
    bits.truncate(clocks);
    bits
}

/// The stalls of one run: one pattern for all inputs, one for all outputs, different bits for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Stalls {
    /// When inputs do not begin to offer a beat.
    pub idle: Pattern,
    /// When outputs are not ready.
    pub back_pressure: Pattern,
    /// Chooses the bits.
    pub seed: u64,
}

impl Stalls {
    /// No stalls at all.
    pub const NONE: Stalls = Stalls { idle: Pattern::None, back_pressure: Pattern::None, seed: 0 };
    /// Pairs of an idle and a back-pressure pattern.
    pub const PAIRS: usize = Pattern::IDLE.len() * Pattern::BACK_PRESSURE.len();
    /// Clocks after which the bits repeat: a power of two.
    pub const PERIOD: usize = 1 << 14;

    /// The pair of that number, all back-pressure patterns of an idle pattern in a row.
    fn pair(number: usize) -> Stalls {
        let width = Pattern::BACK_PRESSURE.len();
        let (idle, back_pressure) =
            (Pattern::IDLE[number / width], Pattern::BACK_PRESSURE[number % width]);
        Stalls { idle, back_pressure, seed: 0 }
    }

    /// The stalls of a seed: each seed another pair, [`Stalls::PAIRS`] seeds all of them.
    pub fn of_seed(seed: u64) -> Stalls {
        Stalls { seed, ..Stalls::pair((seed % Stalls::PAIRS as u64) as usize) }
    }

    /// Every idle pattern with every back-pressure pattern.
    pub fn crossed(seed: u64) -> impl Iterator<Item = Stalls> {
        (0..Stalls::PAIRS).map(move |pair| Stalls { seed, ..Stalls::pair(pair) })
    }

    /// For every clock of a period, a mask of the streams that may go on; `inputs` has the bits
    /// of the inputs, all other bits of `streams` are outputs.
    pub(crate) fn gates(&self, streams: usize, inputs: u32) -> Vec<u32> {
        let mut gates = vec![0u32; Stalls::PERIOD];
        for stream in 0..streams {
            let pattern = if inputs >> stream & 1 == 1 { self.idle } else { self.back_pressure };
            let mut random = Rng::with_seed(self.seed.wrapping_mul(0x9e37_79b9) + stream as u64);
            let bits = pattern.bits(gates.len(), &mut random);
            for (gates, &word) in gates.chunks_mut(64).zip(bits.as_raw_slice()) {
                for (clock, gate) in gates.iter_mut().enumerate() {
                    *gate |= ((word >> clock & 1) as u32) << stream;
                }
            }
        }
        gates
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_have_the_density_they_promise() {
        for (pattern, share) in [
            (Pattern::None, 1.0..1.01),
            (Pattern::Random25, 0.72..0.78),
            (Pattern::Random50, 0.47..0.53),
            (Pattern::Random75, 0.22..0.28),
            (Pattern::Bursts, 0.42..0.58),
            (Pattern::Gaps, 0.85..0.93),
        ] {
            let stalls = Stalls { idle: pattern, back_pressure: Pattern::None, seed: 7 };
            let gates = stalls.gates(2, 1);
            let go = gates.iter().filter(|gate| **gate & 1 == 1).count();
            let found = go as f64 / gates.len() as f64;
            assert!(share.contains(&found), "{}: {found}", pattern.name());
            assert!(gates.iter().all(|gate| gate >> 1 == 1));
            assert_eq!(Pattern::named(pattern.name()), Some(pattern));
        }
        let crossed: Vec<Stalls> = Stalls::crossed(1).collect();
        assert_eq!(crossed.len(), 42);
        assert!((1..42).all(|n| !crossed[..n].contains(&crossed[n])));
    }
}
