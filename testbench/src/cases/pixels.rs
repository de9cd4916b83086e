//! Cases of the units that gather a secondary pixel: sampler and filter.

use super::case::Case;
use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::filter::{Filter, FilterBeat};
use wheatstone_golden::pipeline::sampler::{Sampler, SamplerBeat};
use wheatstone_golden::targets::Target;

/// The case of a pack: random pixels, then every pixel of up to four beats.
pub fn sampler_for_pack(config: &Config, seed: u64, beats: usize) -> Case {
    let mut case = sampler(config, seed, beats);
    case.append(sampler_corners(config));
    case
}

/// The case of a pack: random pixels, then pixels of every count, past the limit too, with channels that are full
/// (the sum of two or three terms may exceed 255), nearly full, half full and nearly empty.
pub fn filter_for_pack(config: &Config, seed: u64, beats: usize) -> Case {
    let mut case = filter(config, seed, beats);
    let mut model = Filter::new(config);
    for count in 0..=33 {
        for n in 0..count.max(1) {
            let (first, end, include) = (n == 0, n + 1 == count.max(1), count > 0);
            let beat = FilterBeat { first, end, include, rgba: Rgba([255, 254, 128, 1]) };
            case.give(&beat);
            if let Some(pixel) = model.step(&beat) {
                case.expect(&pixel);
            }
        }
    }
    case
}

/// Calls `beat(n, first, end)` for random runs of beats that share a pixel, `beats` in all.
fn runs(rng: &mut Rng, beats: usize, mut beat: impl FnMut(&mut Rng, bool, bool)) {
    let mut left = beats;
    while left > 0 {
        let longest = if rng.u32(..8) == 0 { 34 } else { 4 };
        let run = rng.usize(1..=longest).min(left);
        for n in 0..run {
            beat(rng, n == 0, n + 1 == run);
        }
        left -= run;
    }
}

pub fn sampler(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let mut case = Case::empty(Target::Sampler, config, "random");
    let mut model = Sampler::default();
    runs(&mut Rng::with_seed(seed), beats, |rng, first, end| {
        let (near, take) = (rng.bool(), rng.u32(..4) > 0);
        let beat = SamplerBeat { first, end, near, take, data: SampleData::wrap(rng.i64(..), f) };
        case.give(&beat);
        if let Some(sample) = model.step(&beat) {
            case.expect(&sample);
        }
    });
    case
}

/// Every pixel of up to four beats: each beat may be near, taken, both or neither.
pub fn sampler_corners(config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut case = Case::empty(Target::Sampler, config, "every pixel of up to four beats");
    let mut model = Sampler::default();
    for length in 1..=4 {
        for kinds in 0..1 << (2 * length) {
            for n in 0..length {
                let kind = kinds >> (2 * n);
                let beat = SamplerBeat {
                    first: n == 0,
                    end: n + 1 == length,
                    near: kind & 1 == 1,
                    take: kind & 2 == 2,
                    data: SampleData::wrap(!(kinds << 4 | n) * 0x0101_0101_0101, f),
                };
                case.give(&beat);
                if let Some(sample) = model.step(&beat) {
                    case.expect(&sample);
                }
            }
        }
    }
    case
}

/// A channel value, often an end of the range.
fn channel(rng: &mut Rng) -> u8 {
    match rng.u32(..4) {
        0 => 255,
        1 => 0,
        _ => rng.u8(..),
    }
}

pub fn filter(config: &Config, seed: u64, beats: usize) -> Case {
    let mut case = Case::empty(Target::Filter, config, "random");
    let mut model = Filter::new(config);
    let always = &mut false;
    runs(&mut Rng::with_seed(seed), beats, |rng, first, end| {
        if first {
            *always = rng.bool();
        }
        let include = *always || rng.bool();
        let rgba = Rgba([(); 4].map(|()| channel(rng)));
        let beat = FilterBeat { first, end, include, rgba };
        case.give(&beat);
        if let Some(pixel) = model.step(&beat) {
            case.expect(&pixel);
        }
    });
    case
}

/// Every count, past the limit too, with every uniform channel value: every entry of the tables and
/// every overflow of the published ones.
pub fn filter_corners(config: &Config) -> Case {
    let mut case = Case::empty(Target::Filter, config, "every count with every value");
    let mut model = Filter::new(config);
    for count in 0..=32 {
        for value in 0..=255u8 {
            for n in 0..count.max(1) {
                let beat = FilterBeat {
                    first: n == 0,
                    end: n + 1 == count.max(1),
                    include: count > 0,
                    rgba: Rgba([value, 255 - value, value / 2 + n as u8, 255]),
                };
                case.give(&beat);
                if let Some(pixel) = model.step(&beat) {
                    case.expect(&pixel);
                }
            }
        }
    }
    case
}
