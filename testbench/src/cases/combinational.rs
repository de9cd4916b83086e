//! Cases of the units without a history: coverage, blend, display, redirection.

use super::case::Case;
use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::blend::{blend, BlendPixel};
use wheatstone_golden::pipeline::coverage::{coverage, CoverageEdges};
use wheatstone_golden::pipeline::display::{display, DisplayPoint};
use wheatstone_golden::pipeline::redirect::{redirect, Slot};
use wheatstone_golden::targets::Target;

/// An edge near the pixel, or anywhere, or at an end of its range.
fn edge(rng: &mut Rng, f: &Formats) -> (EdgeValue, Slope, Slope, LowBits) {
    let slope_bits = match rng.u32(..4) {
        0 => f.slope_bits,
        _ => rng.u32(2..=f.slope_bits),
    };
    let [a, b] = [(); 2].map(|()| reduce(rng.i64(..), slope_bits, true));
    let value = match rng.u32(..8) {
        0 => rng.i64(..),
        1 => [0, -1, 1, i64::MAX, i64::MIN][rng.usize(..5)],
        // Where samples disagree: |8E| up to 3(|a| + |b|).
        _ => rng.i64(-1 - a.abs() - b.abs()..=1 + a.abs() + b.abs()) * 3 / 8,
    };
    let [a, b] = [a, b].map(|n| Slope::new(n, f));
    (EdgeValue::wrap(value, f), a, b, LowBits::new(rng.i64(0..8), f))
}

fn join(edges: [(EdgeValue, Slope, Slope, LowBits); 3]) -> CoverageEdges {
    let [(value0, a0, b0, low0), (value1, a1, b1, low1), (value2, a2, b2, low2)] = edges;
    CoverageEdges { value0, a0, b0, low0, value1, a1, b1, low1, value2, a2, b2, low2 }
}

pub fn coverage_case(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let mut case = Case::empty(Target::Coverage, config, "random");
    for _ in 0..beats {
        let edges = join([(); 3].map(|()| edge(rng, f)));
        case.give(&edges);
        case.expect(&coverage(&edges, f));
    }
    case
}

/// Each edge alone at the ends of its registers and one step to either side of every sample.
pub fn coverage_corners(config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut case = Case::empty(Target::Coverage, config, "every sample of every edge");
    let largest = (1i64 << (f.slope_bits - 1)) - 1;
    let slopes = [0, 1, -1, 2, 5, -7, 8, -8, 1000, -1001, largest, -largest - 1];
    let inside = (EdgeValue::new(0, f), Slope::default(), Slope::default(), LowBits::default());
    for a in slopes {
        for b in slopes {
            for n in 0..16 {
                let sample = (2 * (n & 3) - 3) * a + (2 * (n >> 2) - 3) * b;
                for offset in [-9, -8, -1, 0, 1, 7, 8] {
                    let eighths = offset - sample;
                    let edge = (
                        EdgeValue::new(eighths >> 3, f),
                        Slope::new(a, f),
                        Slope::new(b, f),
                        LowBits::new(eighths & 7, f),
                    );
                    let mut edges = [inside; 3];
                    edges[n as usize % 3] = edge;
                    let edges = join(edges);
                    case.give(&edges);
                    case.expect(&coverage(&edges, f));
                }
            }
        }
    }
    case
}

pub fn blend_case(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let mut case = Case::empty(Target::Blend, config, "random");
    for _ in 0..beats {
        let byte =
            |rng: &mut Rng| if rng.u32(..6) == 0 { [0, 255][rng.usize(..2)] } else { rng.u8(..) };
        let pixel = BlendPixel {
            rgb: [(); 3].map(|()| byte(rng)),
            alpha: byte(rng),
            area: Area::new(rng.i64(0..=f.full_area().into()), f),
            background: [(); 3].map(|()| byte(rng)),
            tag: Tag::wrap(rng.i64(..), f),
        };
        case.give(&pixel);
        case.expect(&blend(&pixel, f));
    }
    case
}

/// Every alpha with every area, over black, white and grey.
pub fn blend_corners(config: &Config) -> Case {
    let f = &Formats::new(config);
    let mut case = Case::empty(Target::Blend, config, "every alpha with every area");
    for alpha in 0..=255u8 {
        for area in 0..=f.full_area() {
            for (s, b) in
                [(255, 0), (0, 255), (128, 127), (1, 254), (255, 255), (alpha, 255 - alpha)]
            {
                let pixel = BlendPixel {
                    rgb: [s, b, s ^ 1],
                    alpha,
                    area: Area::new(area.into(), f),
                    background: [b, s, b],
                    tag: Tag::wrap(i64::from(s ^ b), f),
                };
                case.give(&pixel);
                case.expect(&blend(&pixel, f));
            }
        }
    }
    case
}

pub fn display_case(config: &Config, seed: u64, beats: usize) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let width = rng.u32(1..=f.max_size);
    let mut case = Case::empty(Target::Display, config, "random");
    case.statics = vec![width.into()];
    for _ in 0..beats {
        let point = DisplayPoint {
            x: PixelX::wrap(rng.i64(..), f),
            y: Coordinate::wrap(rng.i64(..), f),
            swap: rng.bool(),
            mirror: rng.bool(),
        };
        case.give(&point);
        case.expect(&display(&point, width, f));
    }
    case
}

/// Both ends and the middle of x and y at the narrowest and the widest view, in every mode.
pub fn display_corners(config: &Config, width: u32) -> Case {
    let f = &Formats::new(config);
    let mut case = Case::empty(Target::Display, config, format!("every mode, width {width}"));
    case.statics = vec![width.into()];
    let end = 1 << (PixelX::bits(f) - 1);
    let last = (1 << f.coordinate_bits) - 1;
    for x in [-end, -1, 0, 1, i64::from(width) - 1, width.into(), last.min(end - 1), end - 1] {
        for y in [0, 1, last / 2, last] {
            for mode in 0..4 {
                let point = DisplayPoint {
                    x: PixelX::new(x, f),
                    y: Coordinate::new(y, f),
                    swap: mode & 1 == 1,
                    mirror: mode & 2 == 2,
                };
                case.give(&point);
                case.expect(&display(&point, width, f));
            }
        }
    }
    case
}

/// A slot with random pixels.
fn slot(rng: &mut Rng, primary: bool, secondary: bool, eye: Eye, f: &Formats) -> Slot {
    let coordinate = |rng: &mut Rng| Coordinate::wrap(rng.i64(..), f);
    Slot {
        primary,
        secondary,
        eye,
        primary_x: coordinate(rng),
        primary_y: coordinate(rng),
        primary_rgba: Rgba::from_word(rng.u32(..)),
        primary_area: Area::wrap(rng.i64(..), f),
        primary_depth: Depth::wrap(rng.i64(..), f),
        primary_write: rng.bool(),
        secondary_x: coordinate(rng),
        secondary_y: coordinate(rng),
        secondary_rgba: Rgba::from_word(rng.u32(..)),
        secondary_area: Area::wrap(rng.i64(..), f),
        secondary_depth: Depth::wrap(rng.i64(..), f),
        secondary_write: rng.bool(),
        secondary_blended: rng.bool(),
    }
}

fn give_slot(case: &mut Case, slot: &Slot, single: bool) {
    case.give(slot);
    for (stream, pixel) in redirect(slot, single) {
        case.outputs[stream as usize].push(&pixel);
    }
}

pub fn redirect_case(config: &Config, seed: u64, beats: usize) -> Case {
    redirect_slots(config, seed, beats, seed.is_multiple_of(3))
}

/// Random slots, for one display or two.
pub fn redirect_slots(config: &Config, seed: u64, beats: usize, single: bool) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(seed);
    let name = if single { "random, one display" } else { "random" };
    let mut case = Case::empty(Target::Redirect, config, name);
    case.statics = vec![single.into()];
    // Runs of slots for one eye, as polygons make them, and single ones.
    let mut eye = Eye::Left;
    for _ in 0..beats {
        if rng.u32(..6) == 0 {
            eye = Eye::BOTH[rng.usize(..2)];
        }
        let (primary, secondary) = (rng.u32(..4) > 0, rng.u32(..4) > 0);
        give_slot(&mut case, &slot(rng, primary, secondary, eye, f), single);
    }
    case
}

/// Every kind of slot after every other.
pub fn redirect_corners(config: &Config, single: bool) -> Case {
    let f = &Formats::new(config);
    let rng = &mut Rng::with_seed(single.into());
    let displays = if single { "one display" } else { "two displays" };
    let mut case =
        Case::empty(Target::Redirect, config, format!("every pair of slots, {displays}"));
    case.statics = vec![single.into()];
    for pair in 0..64 {
        for kind in [pair >> 3, pair & 7] {
            let eye = Eye::BOTH[kind >> 2];
            give_slot(&mut case, &slot(rng, kind & 1 == 1, kind & 2 == 2, eye, f), single);
        }
    }
    case
}
