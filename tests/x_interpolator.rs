//! X interpolator: against positions added up at once, and against exact fractions of the map.

mod walk;

use walk::{each_derived, exact, walk};
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::x_interpolator::{XBeat, XInterpolator, XPixel};
use wheatstone_golden::pipeline::{Lookahead, Op};
use wheatstone_golden::random::Class;
use wheatstone_golden::setup::Options;

/// Runs the model over a stream.
fn run(formats: Formats, width: u32, beats: &[XBeat]) -> Vec<XPixel> {
    let mut model = XInterpolator::new(formats, width);
    let mut waiting = None;
    beats.iter().flat_map(|b| model.step(b).follow(&mut waiting)).flatten().collect()
}

/// Pixels in the integer part, and the distance of twice the fraction from the centre.
fn split(position: i64, raw_fraction: i64) -> (i64, i64) {
    (position >> FRACTION_BITS, (2 * raw_fraction - SCALE_ONE).abs())
}

#[test]
fn positions_follow_the_map_within_the_error_bound() {
    let mut largest: f64 = 0.0;
    let mut beats = 0;
    let mut check = |config: &Config, size: [u32; 2], classes: &[Class], count| {
        let options = Options::new(config);
        each_derived(config, options, size, classes, count, |planner, polygon, derived| {
            let f = &planner.formats;
            let walk = walk(planner, polygon, derived);
            let given: Vec<XBeat> = walk
                .beats
                .iter()
                .map(|b| {
                    let (setup, _) = &walk.records[b.part];
                    let (start, step, row) = (setup.x_start, setup.x_step, setup.x_row);
                    XBeat { op: b.op, save: b.save, last: b.last, start, step, row }
                })
                .collect();
            let pixels = run(*f, planner.width, &given);
            assert_eq!(pixels.len(), given.len(), "one pixel a beat");
            // The register, all additions at once.
            let position = |n: usize| {
                let (beat, b) = (&given[n], &walk.beats[n]);
                beat.start.raw() + b.rows * beat.row.raw() + b.steps * beat.step.raw()
            };
            let mut row_start = 0;
            for (n, (pixel, b)) in pixels.iter().zip(&walk.beats).enumerate() {
                let raw = position(n);
                let step = given[n].step.raw();
                let fraction = raw & (SCALE_ONE - 1);
                let (x, distance) = split(raw, fraction);
                let context = || format!("beat {n} {b:?} of {polygon:?}");
                assert_eq!(pixel.x.raw(), x, "{}", context());
                let movement = match b.op {
                    Op::Load => 0,
                    Op::Row => x - row_start - (given[n].row.raw() >> FRACTION_BITS),
                    _ => x - (position(n - 1) >> FRACTION_BITS),
                };
                assert!((0..=1).contains(&movement), "a hole at {}", context());
                assert_eq!(i64::from(pixel.r#move), movement, "{}", context());
                let (_, before) = split(raw, fraction - step);
                assert_eq!(pixel.near, distance < before, "{}", context());
                assert_eq!(pixel.inside, (0..i64::from(planner.width)).contains(&x));
                let goes_on = walk.beats.get(n + 1).is_some_and(|next| {
                    next.op == Op::Step && position(n + 1) >> FRACTION_BITS == x
                });
                assert_eq!(pixel.end, !goes_on, "{}", context());
                if b.save {
                    row_start = x;
                }
                let [exact, _] = exact(polygon, derived.primary, b.at, f);
                let additions = 1 + b.rows + b.steps;
                assert!(exact.is_near(raw, additions), "{} of {exact:?}", context());
                largest = largest.max((raw as f64 / SCALE_ONE as f64 - exact.value()).abs());
                beats += 1;
            }
        });
    };
    for config in [Config::DEFAULT, Config { antialias: false, ..Config::PAPER }, Config::PAPER] {
        check(&config, [320, 240], &Class::ALL, 40);
    }
    let large = [Class::Generic, Class::VerticalSliver, Class::SteepShear];
    check(&Config::DEFAULT, [2048, 2048], &large, 12);
    println!("{beats} beats, largest error {largest:.4} pixels");
    assert!(largest < 0.1875, "beyond the bound of 2048 rows, creeping steps and steps");
}

#[test]
fn no_scale_leaves_a_hole() {
    let f = Formats::new(&Config::DEFAULT);
    let mut random = fastrand::Rng::with_seed(3);
    for scale in 0..=SCALE_ONE {
        let start = SecondaryX::wrap(random.i64(-(1 << 20)..1 << 20), &f);
        let beat = |n: i64| XBeat {
            op: if n == 0 { Op::Load } else { Op::Step },
            last: n == 40,
            start,
            step: Scale::new(scale, &f),
            ..XBeat::default()
        };
        let beats: Vec<XBeat> = (0..=40).map(beat).collect();
        let pixels = run(f, 2048, &beats);
        for pair in pixels.windows(2) {
            let movement = pair[1].x.raw() - pair[0].x.raw();
            assert!((0..=1).contains(&movement), "scale {scale}");
            assert_eq!(i64::from(pair[1].r#move), movement, "scale {scale}");
        }
    }
}

#[test]
fn the_accumulator_wraps() {
    for config in [Config::DEFAULT, Config::PAPER] {
        let f = Formats::new(&config);
        let end = 1 << (SecondaryX::bits(&f) - 1);
        let beat = |op| XBeat {
            op,
            last: op != Op::Load,
            start: SecondaryX::new(end - 1, &f),
            step: Scale::new(SCALE_ONE, &f),
            ..XBeat::default()
        };
        let pixels = run(f, 100, &[beat(Op::Load), beat(Op::Step)]);
        assert_eq!(pixels[0].x.raw(), (end >> FRACTION_BITS) - 1);
        assert_eq!(pixels[1].x.raw(), -(end >> FRACTION_BITS));
        assert!(pixels[1].r#move && !pixels[1].inside);
    }
}
