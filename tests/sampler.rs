//! Sampler: against a search for the nearest primary pixel in exact fractions.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::sampler::{Sampler, SamplerBeat};
use wheatstone_golden::pipeline::x_interpolator::{XBeat, XInterpolator};
use wheatstone_golden::pipeline::{Lookahead, Op};

#[test]
fn the_sample_is_the_primary_pixel_nearest_the_centre() {
    let f = &Formats::minimal(&Config::DEFAULT);
    for scale in [SCALE_ONE, SCALE_ONE - 1, 12_000, 8192, 5461, 3000, 1000, SCALE_MIN] {
        for start in [0, 1, 5000, 8192, 16_383, 100_000] {
            let mut x = XInterpolator::new(*f, 2048);
            let mut waiting = None;
            let mut sampler = Sampler::default();
            let mut positions = Vec::new();
            let mut beats = Vec::new();
            for n in 0..400i64 {
                let op = if n == 0 { Op::Load } else { Op::Step };
                let beat = XBeat {
                    op,
                    save: false,
                    last: n == 399,
                    start: SecondaryX::new(start, f),
                    step: Scale::new(scale, f),
                    row: SecondaryX::default(),
                };
                positions.push(start + n * scale);
                beats.extend(x.step(&beat).follow(&mut waiting).into_iter().flatten());
            }
            let mut pixels = 0;
            for (n, pixel) in beats.iter().enumerate() {
                let sample = sampler.step(&SamplerBeat {
                    first: pixel.opens_pixel(),
                    end: pixel.end,
                    near: pixel.near,
                    take: true,
                    data: SampleData::new(n as i64, f),
                });
                let Some(sample) = sample else { continue };
                pixels += 1;
                let column = pixel.x.raw();
                let distance =
                    |n: usize| (2 * (positions[n] - column * SCALE_ONE) - SCALE_ONE).abs();
                let inside = (0..400).filter(|&n| positions[n] >> FRACTION_BITS == column);
                let nearest = inside.clone().map(distance).min();
                let chosen = sample.data.raw() as usize;
                // The rule asks whether this beat is nearer than the one before: positions rise, so
                // the last beat of which that is true is the nearest.
                assert_eq!(
                    Some(distance(chosen)),
                    nearest,
                    "scale {scale} start {start} column {column}"
                );
                assert!(inside.clone().any(|n| n == chosen));
            }
            let columns: std::collections::BTreeSet<i64> =
                positions.iter().map(|p| p >> FRACTION_BITS).collect();
            assert_eq!(pixels, columns.len(), "one sample a secondary pixel");
        }
    }
}
