//! Cases of the three interpolators.

use super::case::Case;
use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::edge_interpolator::{EdgeBeat, EdgeInterpolator};
use wheatstone_golden::pipeline::x_interpolator::{XBeat, XInterpolator, XPixel};
use wheatstone_golden::pipeline::y_interpolator::{YBeat, YInterpolator, YState};
use wheatstone_golden::pipeline::{Lookahead, Op};
use wheatstone_golden::targets::Target;

/// Ops in the proportions of real polygons, with a few illegal ones. The first is a `LOAD`.
fn op(rng: &mut Rng, first: bool) -> Op {
    match rng.u32(..100) {
        _ if first => Op::Load,
        0..8 => Op::Load,
        8..24 => Op::Row,
        24..26 => Op::Reserved,
        _ => Op::Step,
    }
}

/// A raw value of a quantity: uniform, small, or at an end of the range.
fn raw<Q: Quantity>(rng: &mut Rng, f: &Formats) -> i64 {
    let bits = Q::bits(f);
    let value = match rng.u32(..10) {
        0 => [0, 1, -1, i64::MAX, i64::MIN][rng.usize(..5)],
        1 => (1 << (bits - 1)) - rng.i64(0..3),
        2..5 => rng.i64(-(1 << (bits / 2))..1 << (bits / 2)),
        _ => rng.i64(..),
    };
    reduce(value, bits, Q::SIGNED)
}

fn quantity<Q: Quantity>(rng: &mut Rng, f: &Formats) -> Q {
    Q::new(raw::<Q>(rng, f), f)
}

/// A start anywhere, or within a pixel of the end of the view.
fn start(rng: &mut Rng, size: u32, f: &Formats) -> SecondaryX {
    if rng.u32(..8) > 0 {
        return quantity(rng, f);
    }
    let end = i64::from(size) << FRACTION_BITS;
    SecondaryX::wrap(end + rng.i64(-SCALE_ONE..=SCALE_ONE), f)
}

/// A legal G1, the ends of its range more often than the rest.
fn scale(rng: &mut Rng, f: &Formats) -> Scale {
    let raw = match rng.u32(..8) {
        0 => SCALE_ONE,
        1 => SCALE_ONE - rng.i64(1..4),
        2 => SCALE_MIN,
        3 => SCALE_ONE / rng.i64(1..30),
        _ => rng.i64(SCALE_MIN..=SCALE_ONE),
    };
    Scale::new(raw, f)
}

/// Runs the x model over beats.
struct XRun {
    case: Case,
    model: XInterpolator,
    waiting: Option<XPixel>,
}

impl XRun {
    fn new(config: &Config, name: &str, width: u32) -> XRun {
        let mut case = Case::empty(Target::XInterpolator, config, name);
        case.statics = vec![width.into()];
        XRun { case, model: XInterpolator::new(Formats::new(config), width), waiting: None }
    }

    fn beat(&mut self, beat: &XBeat) {
        self.case.give(beat);
        let complete = self.model.step(beat).follow(&mut self.waiting);
        complete.iter().flatten().for_each(|pixel| self.case.expect(pixel));
    }
}

pub fn x(config: &Config, seed: u64, beats: usize) -> Case {
    x_run(config, seed, beats).case
}

/// The case of a pack: random beats, then starts on either side of where `near` and `inside` change.
pub fn x_for_pack(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let mut run = x_run(config, seed, beats);
    let width = (run.case.statics[0] as i64) << FRACTION_BITS;
    for step in [SCALE_MIN, SCALE_MIN + 1, 5_461, 8_192, 12_345, SCALE_ONE - 1, SCALE_ONE] {
        let half = (SCALE_ONE + step) / 2;
        for start in [-SCALE_ONE, -1, 0, half, SCALE_ONE / 2, width - 1, width] {
            for aside in -1..=1 {
                let start = SecondaryX::wrap(start + aside, f);
                let (step, row) = (Scale::new(step, f), SecondaryX::new(-1, f));
                for op in [Op::Load, Op::Step, Op::Row] {
                    let last = op == Op::Row;
                    run.beat(&XBeat { op, save: op == Op::Load, last, start, step, row });
                }
            }
        }
    }
    run.case
}

fn x_run(config: &Config, seed: u64, beats: usize) -> XRun {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let width = rng.u32(1..=f.max_size);
    let mut run = XRun::new(config, "random", width);
    for n in 0..beats {
        let beat = XBeat {
            op: op(rng, n == 0),
            save: n == 0 || rng.u32(..4) == 0,
            last: n + 1 == beats || rng.u32(..24) == 0,
            start: start(rng, width, f),
            step: scale(rng, f),
            row: quantity(rng, f),
        };
        run.beat(&beat);
    }
    run
}

/// Every ratio up to 29 and past it from many fractions, and both ends of the accumulator.
pub fn x_corners(config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut run = XRun::new(config, "every mapping ratio and accumulator end", f.max_size);
    let end = 1 << (SecondaryX::bits(f) - 1);
    let width = i64::from(f.max_size) << FRACTION_BITS;
    let starts = [
        0,
        1,
        SCALE_ONE / 2,
        SCALE_ONE - 1,
        -1,
        -SCALE_ONE,
        width - 1,
        width,
        end - 1,
        end - SCALE_ONE,
        -end,
    ];
    for ratio in 1..=33 {
        for start in starts {
            let step = Scale::new((2 * SCALE_ONE + ratio) / (2 * ratio), f);
            let [start, row] = [start, -start / 2].map(|x| SecondaryX::wrap(x, f));
            for n in 0..3 * ratio + 3 {
                let (op, save) = match n {
                    0 => (Op::Load, true),
                    _ if n == ratio => (Op::Row, true),
                    _ => (Op::Step, false),
                };
                let last = n == 3 * ratio + 2;
                run.beat(&XBeat { op, save, last, start, step, row });
            }
        }
    }
    run.case
}

/// Runs the y model over beats.
struct YRun {
    case: Case,
    model: YInterpolator,
    waiting: Option<YState>,
}

impl YRun {
    fn new(config: &Config, name: &str, height: u32) -> YRun {
        let mut case = Case::empty(Target::YInterpolator, config, name);
        case.statics = vec![height.into()];
        let model = YInterpolator::new(Formats::new(config), config.tilt, height);
        YRun { case, model, waiting: None }
    }

    fn beat(&mut self, beat: &YBeat) {
        self.case.give(beat);
        let complete = self.model.step(beat).follow(&mut self.waiting);
        complete.iter().flatten().for_each(|state| self.case.expect(&state.pixel));
    }
}

/// A slant of at most one pixel a step, as setup makes them.
fn slant(rng: &mut Rng, f: &Formats) -> Slant {
    let raw = match rng.u32(..4) {
        0 => [SCALE_ONE, -SCALE_ONE, 0, 1, -1][rng.usize(..5)],
        _ => rng.i64(-SCALE_ONE..=SCALE_ONE),
    };
    Slant::new(raw, f)
}

pub fn y(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let height = rng.u32(1..=f.max_size);
    let mut run = YRun::new(config, "random", height);
    for n in 0..beats {
        let beat = YBeat {
            op: op(rng, n == 0),
            save: n == 0 || rng.u32(..4) == 0,
            last: n + 1 == beats || rng.u32(..24) == 0,
            start: quantity(rng, f),
            step: DisplayStep::new(rng.i64(-2..=2), f),
            view: start(rng, height, f),
            slant: slant(rng, f),
            row: quantity(rng, f),
        };
        run.beat(&beat);
    }
    run.case
}

/// Every display step from both ends of the display, and every slant sign from both ends of y.
pub fn y_corners(config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut run = YRun::new(config, "every display step and accumulator end", f.max_size);
    let end = 1 << (SecondaryX::bits(f) - 1);
    let height = i64::from(f.max_size) << FRACTION_BITS;
    for step in -2..=2 {
        for start in [0, 1, (1 << f.coordinate_bits) - 1] {
            for slant in [-SCALE_ONE, -1, 0, 1, SCALE_ONE] {
                for view in [0, -1, height - 1, height, end - 1, -end] {
                    for n in 0..6 {
                        let beat = YBeat {
                            op: [Op::Load, Op::Step, Op::Step, Op::Row, Op::Step, Op::Row][n],
                            save: n % 3 == 0,
                            last: n == 5,
                            start: Coordinate::new(start, f),
                            step: DisplayStep::new(step, f),
                            view: SecondaryX::new(view, f),
                            slant: Slant::new(slant, f),
                            row: SecondaryX::wrap(SCALE_ONE + slant, f),
                        };
                        run.beat(&beat);
                    }
                }
            }
        }
    }
    run.case
}

/// Runs the edge model over beats.
struct EdgeRun {
    case: Case,
    model: EdgeInterpolator<EdgeBeat>,
}

impl EdgeRun {
    fn new(config: &Config, name: &str) -> EdgeRun {
        let case = Case::empty(Target::EdgeInterpolator, config, name);
        EdgeRun { case, model: EdgeInterpolator::new(Formats::new(config), config.tilt) }
    }

    fn beat(&mut self, beat: &EdgeBeat) {
        self.case.give(beat);
        let output = self.model.step(beat);
        self.case.expect(&output);
    }
}

pub fn edge(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let mut run = EdgeRun::new(config, "random");
    for n in 0..beats {
        let beat = EdgeBeat {
            op: op(rng, n == 0),
            save: n == 0 || rng.u32(..4) == 0,
            r#move: rng.bool(),
            y_move: Move::new(rng.i64(-2..=1), f),
            start: quantity(rng, f),
            a: quantity(rng, f),
            b: quantity(rng, f),
            row: quantity(rng, f),
            low: quantity(rng, f),
        };
        run.beat(&beat);
    }
    run.case
}

/// Every combination of extreme register values, through every op and movement.
pub fn edge_corners(config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut run = EdgeRun::new(config, "every register at its ends");
    let ends = |bits: u32| [0, 1, -1, (1i64 << (bits - 1)) - 1, -(1i64 << (bits - 1))];
    let (values, slopes) = (ends(f.edge_bits), ends(f.slope_bits));
    for start in values {
        for row in values {
            for a in slopes {
                for b in slopes {
                    for n in 0..12 {
                        let beat = EdgeBeat {
                            op: [Op::Load, Op::Step, Op::Step, Op::Row][n % 4],
                            save: n % 4 != 2,
                            r#move: n % 3 != 0,
                            y_move: Move::new(n as i64 % 3 - 1, f),
                            start: EdgeValue::new(start, f),
                            a: Slope::new(a, f),
                            b: Slope::new(b, f),
                            row: EdgeValue::new(row, f),
                            low: LowBits::new(n as i64 % 8, f),
                        };
                        run.beat(&beat);
                    }
                }
            }
        }
    }
    run.case
}
