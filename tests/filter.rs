//! Filter: its division against the published figures and against exact arithmetic, and its pixels against
//! the mean of what is in them.

use fastrand::Rng;
use wheatstone_golden::config::{Config, Division};
use wheatstone_golden::formats::{Quantity, Rgba};
use wheatstone_golden::pipeline::filter::{divide, factor, Filter, FilterBeat};
use wheatstone_golden::pipeline::filter_tables::{
    reciprocal, THREE_TERM, THREE_TERM_SHIFT, TWO_TERM,
};

/// Primary pixels that a secondary pixel averages at most.
const MOST: u32 = 29;

/// The published exponents p, q for n = 1 to 29 (paper, section 5.6.1, as recomputed).
const PUBLISHED_EXPONENTS: [(u32, u32); 29] = [
    (1, 1),
    (2, 2),
    (2, 4),
    (3, 3),
    (3, 4),
    (3, 5),
    (3, 6),
    (4, 4),
    (4, 4),
    (4, 5),
    (4, 5),
    (4, 6),
    (4, 6),
    (4, 7),
    (4, 8),
    (5, 5),
    (5, 5),
    (5, 5),
    (5, 6),
    (5, 6),
    (5, 6),
    (5, 6),
    (5, 6),
    (5, 7),
    (5, 7),
    (5, 7),
    (5, 8),
    (5, 8),
    (5, 8),
];

/// Relative errors of a sum of powers of two for 1/n.
fn errors(exponents: impl Fn(usize) -> Vec<u32>) -> Vec<f64> {
    let sum = |n: usize| exponents(n).iter().map(|&e| 0.5f64.powi(e as i32)).sum::<f64>();
    (1..=MOST as usize).map(|n| (sum(n) * n as f64 - 1.0).abs()).collect()
}

fn mean(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len() as f64
}

#[test]
fn two_terms_have_the_published_errors() {
    assert_eq!(TWO_TERM[1..], PUBLISHED_EXPONENTS);
    let errors = errors(|n| vec![TWO_TERM[n].0, TWO_TERM[n].1]);
    assert_eq!(errors.iter().sum::<f64>(), 305.0 / 256.0);
    assert!((mean(&errors) - 0.041_082_974_137_931_036).abs() < 1e-12);
    assert!((mean(&errors[1..]) - 0.042_550_223_214_285_71).abs() < 1e-12);
    let largest: Vec<usize> = (1..=29).filter(|&n| errors[n - 1] == 0.125).collect();
    assert_eq!(largest, [9, 18]);
    assert!(errors.iter().all(|&e| e <= 0.125));
}

#[test]
fn three_terms_have_the_expected_errors() {
    let errors = errors(|n| vec![THREE_TERM[n].0, THREE_TERM[n].1, THREE_TERM[n].2]);
    assert!(errors.iter().all(|&e| e <= 0.0625) && errors.contains(&0.0625));
    assert!((mean(&errors) - 0.012_745_8).abs() < 5e-8);
    let sorted = |&(p, q, r): &(u32, u32, u32)| p <= q && q <= r && r <= THREE_TERM_SHIFT;
    assert!(THREE_TERM.iter().all(sorted));
    // Of triples with the same sum the one that needs the fewest bits is in the table.
    let sum = |(p, q, r): (u32, u32, u32)| {
        [p, q, r].map(|e| 1 << (THREE_TERM_SHIFT - e)).iter().sum::<u32>()
    };
    for &entry in &THREE_TERM[1..] {
        let fewer = 1..entry.2;
        let pairs = fewer.clone().flat_map(|q| (1..=q).map(move |p| (p, q)));
        let mut triples = pairs.flat_map(|(p, q)| (q..entry.2).map(move |r| (p, q, r)));
        assert!(triples.all(|triple| sum(triple) != sum(entry)), "{entry:?}");
    }
}

#[test]
fn white_overflows_where_expected_and_saturates() {
    let white = |n: u32| {
        let (p, q) = TWO_TERM[n as usize];
        (255.0 * f64::from(n) * (0.5f64.powi(p as i32) + 0.5f64.powi(q as i32))).round()
    };
    let overflowing: Vec<u32> = (1..=MOST).filter(|&n| white(n) > 255.0).collect();
    assert_eq!(overflowing, [9, 11, 13, 17, 18, 22, 23, 26, 29]);
    for n in overflowing {
        assert_eq!(divide(Division::TwoTerm, 255 * n, n), 255);
    }
    // Two shifts, each cut, would give 254.
    for n in [1, 2, 4, 8, 16] {
        assert_eq!(divide(Division::TwoTerm, 255 * n, n), 255);
    }
}

#[test]
fn sums_of_powers_of_two_are_rounded_once() {
    for n in 1..=MOST {
        let ((p, q), (a, b, c)) = (TWO_TERM[n as usize], THREE_TERM[n as usize]);
        for sum in 0..=255 * n {
            for (division, exponents) in
                [(Division::TwoTerm, vec![p, q]), (Division::ThreeTerm, vec![a, b, c])]
            {
                // A sum of few powers of two is exact in a double.
                let exact: f64 = exponents.iter().map(|&e| 0.5f64.powi(e as i32)).sum();
                assert_eq!(factor(division, n), exact);
                let rounded = (f64::from(sum) * exact + 0.5).floor().min(255.0);
                assert_eq!(f64::from(divide(division, sum, n)), rounded, "{sum}/{n}");
            }
        }
    }
}

#[test]
fn exact_division_is_exact() {
    for n in 1..=MOST {
        for sum in 0..=255 * n {
            let rounded = (2 * sum + n) / (2 * n);
            assert_eq!(u32::from(divide(Division::Exact, sum, n)), rounded, "{sum}/{n}");
        }
    }
    for n in 1..=32 {
        for sum in 0..=255 * n {
            let rounded = (2 * sum + n) / (2 * n);
            let quotient = (u64::from(sum + n / 2) * u64::from(reciprocal(n))) >> 18;
            assert_eq!(quotient, u64::from(rounded), "{sum}/{n}");
        }
        let factor = factor(Division::Exact, n.min(MOST));
        assert!((factor * f64::from(n.min(MOST)) - 1.0).abs() < 0.5f64.powi(13));
    }
}

#[test]
fn a_pixel_is_the_mean_of_the_first_29_colours_in_it() {
    let mut random = Rng::with_seed(1);
    let mut filter = Filter::new(&Config::FULL);
    assert_eq!(Config::FULL.division, Division::Exact);
    let mut longest = 0;
    for pixel in 0..20_000 {
        let beats = random.usize(1..=40);
        let mut colours: Vec<[u8; 4]> = Vec::new();
        for beat in 0..beats {
            let rgba = [0; 4].map(|_| if pixel % 8 == 0 { 255 } else { random.u8(..) });
            let include = random.u8(..8) > 0;
            if include {
                colours.push(rgba);
            }
            let end = beat + 1 == beats;
            let step = FilterBeat { first: beat == 0, end, include, rgba: Rgba(rgba) };
            let found = filter.step(&step);
            assert_eq!(found.is_some(), end);
            let Some(found) = found else { continue };
            longest = longest.max(colours.len());
            colours.truncate(MOST as usize);
            let n = colours.len() as u32;
            let mean = |channel: usize| {
                let sum: u32 = colours.iter().map(|c| u32::from(c[channel])).sum();
                (2 * sum + n).checked_div(2 * n).unwrap_or(0) as u8
            };
            assert_eq!(found.rgba, Rgba([0, 1, 2, 3].map(mean)));
            assert_eq!(found.count.raw(), i64::from(n));
        }
    }
    assert!(longest > MOST as usize, "more than the filter takes are offered");
}
