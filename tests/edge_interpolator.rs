//! Edge interpolator: against the linear function evaluated directly, along random walks.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::edge_interpolator::*;
use wheatstone_golden::pipeline::Op;

/// A walk over pixels: what each beat does, and where it is then.
struct Step {
    op: Op,
    save: bool,
    right: bool,
    down: i64,
    /// Whole-pixel part of the row shear and of the row rise.
    row: [i64; 2],
    at: [i64; 2],
}

fn walk(rng: &mut Rng, tilt: bool, beats: usize) -> Vec<Step> {
    let mut at = [0; 2];
    let mut saved = [0; 2];
    let mut row = [0; 2];
    let steps = (0..beats).map(|n| {
        let op = match rng.u32(..20) {
            _ if n == 0 => Op::Load,
            0 => Op::Load,
            1..4 => Op::Row,
            4 => Op::Reserved,
            _ => Op::Step,
        };
        let (right, mut down) = (rng.bool(), 0);
        if tilt {
            down = rng.i64(-1..=1);
        }
        let [x, y] = match op {
            Op::Load => {
                row = [rng.i64(-40..40), if tilt { rng.i64(-3..=3) } else { 1 }];
                [rng.i64(-3000..3000), rng.i64(0..2048)]
            }
            Op::Row => [saved[0] + row[0] + i64::from(right), saved[1] + row[1] + down],
            Op::Step | Op::Reserved => [at[0] + i64::from(right), at[1] + down],
        };
        at = [x, y];
        // A row start of another plane means nothing.
        let save = op == Op::Load || rng.u32(..5) == 0;
        if save {
            saved = at;
        }
        Step { op, save, right, down, row, at }
    });
    steps.collect()
}

/// a·x + b·y + c modulo the width of a quantity.
fn at<Q: Quantity>([a, b, c]: [i64; 3], [x, y]: [i64; 2], f: &Formats) -> Q {
    let value = a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c);
    Q::wrap(value, f)
}

macro_rules! compare {
    ($rng:ident, $f:ident, $tilt:ident, $beat:ident, $value:ty, $slope:ty) => {{
        let mut model = EdgeInterpolator::<$beat>::new(*$f, $tilt);
        let mut plane = [0; 3];
        let mut low = LowBits::default();
        for (n, step) in walk($rng, $tilt, 4000).iter().enumerate() {
            let [x, y] = step.at;
            if step.op == Op::Load {
                let bits = <$slope>::bits($f).min(22);
                plane = [(); 3].map(|()| reduce($rng.i64(..), bits, true));
                plane[2] = $rng.i64(..);
                low = LowBits::new($rng.i64(0..8), $f);
            }
            let [a, b, _] = plane;
            let beat = $beat {
                op: step.op,
                save: step.save,
                r#move: step.right,
                y_move: Move::new(step.down, $f),
                start: at(plane, [x, y], $f),
                a: <$slope>::new(a, $f),
                b: <$slope>::new(b, $f),
                row: <$value>::wrap(a * step.row[0] + b * step.row[1], $f),
                low,
            };
            let output = model.step(&beat);
            let expected: $value = at(plane, [x, y], $f);
            assert_eq!(
                output.value, expected,
                "beat {n} at ({x}, {y}) of {plane:?}, tilt {}",
                $tilt
            );
            assert_eq!((output.a.raw(), output.b.raw(), output.low), (a, b, low));
        }
    }};
}

#[test]
fn values_are_those_of_the_linear_function() {
    let rng = &mut Rng::with_seed(8);
    for config in [Config::DEFAULT, Config::PAPER] {
        let f = &Formats::new(&config);
        for _ in 0..50 {
            for tilt in [false, true] {
                compare!(rng, f, tilt, EdgeBeat, EdgeValue, Slope);
                compare!(rng, f, tilt, DepthBeat, DepthPlane, DepthPlane);
                compare!(rng, f, tilt, ColourBeat, ColourPlane, ColourPlane);
            }
        }
    }
}

#[test]
fn without_tilt_the_y_movement_is_ignored() {
    let f = Formats::new(&Config::DEFAULT);
    let mut model = EdgeInterpolator::<EdgeBeat>::new(f, false);
    let load = EdgeBeat { op: Op::Load, b: Slope::new(5, &f), ..EdgeBeat::default() };
    model.step(&load);
    let output = model.step(&EdgeBeat { op: Op::Step, y_move: Move::new(1, &f), ..load });
    assert_eq!((output.value.raw(), output.b.raw()), (0, 5));
}
