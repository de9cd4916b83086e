//! The filter's division (McCann & Lister, "An Architecture For Rapid Stereoscopic Image
//! Generation", section 5.6.1), and the sum of their gates (Table 1).

use crate::plot::{self, Series};
use crate::published::HYBRID;
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

const MEAN: &str = "the printed mean leaves out n = 1, which is exact";
const GATES: &str = "\"approximately 30,000\" is not what Table 1 sums to, with three edge units";

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

fn run(out: &Path) -> Result<Report, StudyError> {
    let [two, three] = [Division::TwoTerm, Division::ThreeTerm].map(errors);
    let percent = |what: &str, part: f64, digits| {
        Row::new(what, 100.0 * part, digits, Check::Digits).unit("%")
    };
    let count = |what: &str, n: f64| Row::new(what, n, 0, Check::Digits);
    let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let worst: Vec<f64> =
        (1..=two.len()).filter(|n| two[n - 1] == largest(&two)).map(|n| n as f64).collect();
    let terms = Table {
        title: "Division by n = 1 … 29 (section 5.6.1)".into(),
        rows: vec![
            percent("two terms, largest error", largest(&two), 1).printed(12.5),
            percent("two terms, mean error, n = 2 … 29", mean(&two[1..]), 2).printed(4.26),
            percent("two terms, mean error, n = 1 … 29", mean(&two), 2)
                .printed(4.26)
                .corrected(4.11, MEAN),
            count("first n with the largest error", worst[0]).expected(9.0),
            count("last n with the largest error", worst[worst.len() - 1]).expected(18.0),
            percent("three terms, largest error", largest(&three), 2).expected(6.25),
            percent("three terms, mean error", mean(&three), 2).expected(1.27),
        ],
    };
    let whitest = (1..=FILTER_LIMIT).map(truncated_white).max();
    let white = Table {
        title: "White, and sums that are not divided to the nearest byte".into(),
        rows: vec![
            count("n for which white overflows 8 bits", overflowing().len() as f64).expected(9.0),
            count("largest white, shifts cut", whitest.unwrap_or(0).into()).expected(286.0),
            count(
                "powers of two for which cut shifts turn white into 254",
                [1, 2, 4, 8, 16].into_iter().filter(|&n| truncated_white(n) == 254).count() as f64,
            )
            .expected(5.0),
            count("wrong quotients of the exact division", wrong_quotients(Division::Exact) as f64)
                .expected(0.0),
        ],
    };
    let gates = Table {
        title: "Gates (Table 1)".into(),
        rows: vec![count("hybrid system", HYBRID.into())
            .printed(30_000.0)
            .corrected(22_754.0, GATES)],
    };
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
        tables: vec![terms, white, gates],
        files: vec![file],
    })
}
