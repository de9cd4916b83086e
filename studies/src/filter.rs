//! The filter's division (McCann & Lister, "An Architecture For Rapid Stereoscopic Image
//! Generation", section 5.6.1), and the sum of their gates (Table 1).

use crate::errata;
use crate::plot::{self, Series};
use crate::published;
use crate::{Check, Experiment, Report, Row, StudyError, Table};
use std::path::Path;
use wheatstone_golden::config::Division;
use wheatstone_golden::formats::FILTER_LIMIT;
use wheatstone_golden::pipeline::filter::{divide, factor};
use wheatstone_golden::pipeline::filter_tables::{TWO_TERM, TWO_TERM_SHIFT};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "filter",
    description: "McCann & Lister's division by n in two terms: its errors, and those of three",
    run,
};

/// Gates of Table 1, and how many of the unit there are.
const TABLE_1: [(&str, u32, u32); 7] = [
    ("x interpolator", published::X_INTERPOLATOR, 1),
    ("y interpolator", published::Y_INTERPOLATOR, 1),
    ("edge interpolator", published::EDGE_INTERPOLATOR, 3),
    ("filter", published::FILTER, 1),
    ("coverage", published::COVERAGE, 1),
    ("blending", published::BLEND, 1),
    ("redirection", published::REDIRECT, 1),
];

const DERIVATION: &str = "the text does not say which units its \"approximately 5,000\" count; \
    these are the ones that figure 3 cannot do without";

/// Relative errors of the division by n for n from 1 to 29.
pub fn errors(division: Division) -> Vec<f64> {
    (1..=FILTER_LIMIT).map(|n| (factor(division, n) * f64::from(n) - 1.0).abs()).collect()
}

/// Their mean.
pub fn mean(errors: &[f64]) -> f64 {
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// The n for which the two-term average of n white pixels, rounded, is more than white.
pub fn overflowing() -> Vec<u32> {
    let average = |n: u32| {
        let (p, q) = TWO_TERM[n as usize];
        let white = 255 * n;
        let sum = (white << (TWO_TERM_SHIFT - p)) + (white << (TWO_TERM_SHIFT - q));
        (sum + (1 << (TWO_TERM_SHIFT - 1))) >> TWO_TERM_SHIFT
    };
    (1..=FILTER_LIMIT).filter(|&n| average(n) > 255).collect()
}

/// The n that the paper's formula does not bring back to 8 bits.
const OVERFLOWING: [u32; 9] = [9, 11, 13, 17, 18, 22, 23, 26, 29];

/// The average of n white pixels as two shifts and an addition give it, each shift cut.
pub fn truncated_white(n: u32) -> u32 {
    let (p, q) = TWO_TERM[n as usize];
    ((255 * n) >> p) + ((255 * n) >> q)
}

/// Sums of n bytes whose quotient is not the nearest byte.
fn wrong_quotients(division: Division) -> usize {
    let wrong = |n: u32| {
        let nearest = move |sum: u32| ((2 * sum + n) / (2 * n)) as u8;
        (0..=255 * n).filter(move |&sum| divide(division, sum, n) != nearest(sum)).count()
    };
    (1..=FILTER_LIMIT).map(wrong).sum()
}

/// The least relative error of 2^-p + 2^-q for 1/n, or of 2^-p ± 2^-q, over all p and q that the table
/// can have.
fn least_error(n: u32, signs: &[f64]) -> f64 {
    let power = |exponent: u32| 0.5f64.powi(exponent as i32);
    let exponents = || 0..=TWO_TERM_SHIFT;
    let pairs = exponents().flat_map(|p| exponents().map(move |q| (p, q)));
    let error = |(p, q)| {
        let error = |sign: &f64| (f64::from(n) * (power(p) + sign * power(q)) - 1.0).abs();
        signs.iter().map(error).fold(f64::MAX, f64::min)
    };
    pairs.map(error).fold(f64::MAX, f64::min)
}

/// The least shift with which the product with ceil(2^shift/n) rounds every sum of n bytes to the
/// nearest quotient, for every n.
fn least_exact_shift() -> u32 {
    let exact = |shift: u32, n: u32| {
        let reciprocal = (1u64 << shift).div_ceil(n.into());
        (n / 2..=255 * n + n / 2)
            .all(|sum| (u64::from(sum) * reciprocal) >> shift == u64::from(sum / n))
    };
    (0..32).find(|&shift| (1..=FILTER_LIMIT).all(|n| exact(shift, n))).unwrap_or(32)
}

fn percent(what: impl Into<String>, part: f64, digits: usize) -> Row {
    Row::new(what, 100.0 * part, digits, Check::Digits).unit("%")
}

fn count(what: impl Into<String>, n: impl Into<f64>) -> Row {
    Row::new(what, n.into(), 0, Check::Digits)
}

/// The errors of the divisions.
fn terms(two: &[f64], three: &[f64]) -> Table {
    let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let worst: Vec<u32> =
        (1..=FILTER_LIMIT).filter(|&n| two[n as usize - 1] == largest(two)).collect();
    let signed: Vec<f64> = (1..=FILTER_LIMIT).map(|n| least_error(n, &[1.0, -1.0])).collect();
    let whole = 256.0 * two.iter().sum::<f64>();
    let rows = vec![
        count("entries of the table", FILTER_LIMIT).printed(29.0),
        percent("two terms, largest error", largest(two), 1).printed(12.5),
        percent("two terms, mean error, n = 2 … 29", mean(&two[1..]), 2).printed(4.26),
        percent("two terms, mean error, n = 1 … 29", mean(two), 2)
            .printed(4.26)
            .corrected(4.11, errata::MEAN_ERROR),
        count("two terms, sum of errors, in 256ths", whole).expected(305.0),
        count("first n with the largest error", worst[0]).expected(9.0),
        count("last n with the largest error", worst[worst.len() - 1]).expected(18.0),
        percent("three terms, largest error", largest(three), 2).expected(6.25),
        percent("three terms, mean error", mean(three), 2).expected(1.27),
        percent("two terms, added or subtracted, largest error", largest(&signed), 4)
            .expected(7.8125),
        percent("two terms, added or subtracted, mean error", mean(&signed), 3).expected(2.909),
        count("exact division, least shift", least_exact_shift()).expected(18.0),
        count("exact division, wrong quotients", wrong_quotients(Division::Exact) as f64)
            .expected(0.0),
    ];
    Table { title: "Division by n = 1 … 29 (section 5.6.1)".into(), rows }
}

/// p and q for every n, their error held against all other p and q.
fn exponents(two: &[f64]) -> Table {
    let row = |(n, &error): (u32, &f64)| {
        let (p, q) = TWO_TERM[n as usize];
        let one = if p == q { format!(" = 1/2^{}", p - 1) } else { String::new() };
        percent(format!("1/{n}: 1/2^{p} + 1/2^{q}{one}"), error, 2)
            .expected(100.0 * least_error(n, &[1.0]))
    };
    let rows = (1..).zip(two).map(row).collect();
    Table { title: "Table of p and q (equation 1), and its errors".into(), rows }
}

fn white() -> Table {
    let whitest = (1..=FILTER_LIMIT).map(truncated_white).max().unwrap_or(0);
    let overflowing = overflowing();
    let darkened = [1, 2, 4, 8, 16].into_iter().filter(|&n| truncated_white(n) == 254).count();
    let mut rows = vec![
        count("n for which white overflows 8 bits", overflowing.len() as f64)
            .expected(OVERFLOWING.len() as f64),
        count("largest white, shifts cut", whitest).expected(286.0),
        count("powers of two for which cut shifts turn white into 254", darkened as f64)
            .expected(5.0),
    ];
    rows.extend((1..).zip(overflowing.into_iter().zip(OVERFLOWING)).map(|(k, (n, expected))| {
        count(format!("n for which white overflows, {k} of 9"), n).expected(expected.into())
    }));
    Table { title: "White in 8 bits".into(), rows }
}

fn gates() -> Table {
    let mut rows: Vec<Row> =
        TABLE_1.iter().map(|&(unit, gates, _)| Row::quoted(unit, gates.into())).collect();
    let [three, all] = [&TABLE_1[2..3], &TABLE_1[..]]
        .map(|units| units.iter().map(|(_, gates, units)| gates * units).sum::<u32>());
    let derivation = [0, 1, 6].map(|n| TABLE_1[n].1).iter().sum::<u32>();
    let what = "pure derivation: interpolators of x and y, redirection";
    rows.push(Row::new(what, derivation.into(), 0, Check::Trend).printed(5000.0).note(DERIVATION));
    rows.push(count("three edge interpolators", three).printed(8304.0));
    let hybrid = count("hybrid system, sum", all).printed(30_000.0);
    rows.push(hybrid.corrected(22_754.0, errata::GATES));
    Table { title: "Gates (Table 1)".into(), rows }
}

fn run(out: &Path) -> Result<Report, StudyError> {
    let [two, three] = [Division::TwoTerm, Division::ThreeTerm].map(errors);
    let file = out.join("errors.svg");
    let series = |name: &str, errors: &[f64]| {
        let point = |(n, e): (usize, &f64)| ((n + 1) as f64, 100.0 * e);
        Series::new(name, errors.iter().enumerate().map(point).collect())
    };
    let title = "Relative error of the division by n";
    plot::lines(
        &file,
        title,
        ["n", "error / %"],
        &[series("two terms", &two), series("three terms", &three)],
    )?;
    Ok(Report {
        experiment: EXPERIMENT.name.into(),
        publication: "McCann & Lister".into(),
        tables: vec![terms(&two, &three), exponents(&two), white(), gates()],
        files: vec![file],
    })
}
