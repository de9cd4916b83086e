//! Filter: its division against the published figures and against exact arithmetic.

use wheatstone_golden::config::Division;
use wheatstone_golden::pipeline::filter::divide;
use wheatstone_golden::pipeline::filter_tables::{
    reciprocal, THREE_TERM, THREE_TERM_SHIFT, TWO_TERM,
};
use wheatstone_studies::filter::{errors, mean, overflowing, truncated_white};
use wheatstone_tests::PUBLISHED_EXPONENTS;

#[test]
fn two_terms_have_the_published_errors() {
    assert_eq!(TWO_TERM[1..], PUBLISHED_EXPONENTS);
    let errors = errors(Division::TwoTerm);
    assert_eq!(errors.iter().sum::<f64>(), 305.0 / 256.0);
    assert!((mean(&errors) - 0.041_082_974_137_931_036).abs() < 1e-12);
    assert!((mean(&errors[1..]) - 0.042_550_223_214_285_71).abs() < 1e-12);
    let largest: Vec<usize> = (1..=29).filter(|&n| errors[n - 1] == 0.125).collect();
    assert_eq!(largest, [9, 18]);
    assert!(errors.iter().all(|&e| e <= 0.125));
}

#[test]
fn three_terms_have_the_expected_errors() {
    let errors = errors(Division::ThreeTerm);
    assert!(errors.iter().all(|&e| e <= 0.0625) && errors.contains(&0.0625));
    assert!((mean(&errors) - 0.012_745_8).abs() < 5e-8);
    let sorted = |&(p, q, r): &(u32, u32, u32)| p <= q && q <= r && r <= THREE_TERM_SHIFT;
    assert!(THREE_TERM.iter().all(sorted));
}

#[test]
fn white_overflows_where_expected_and_saturates() {
    assert_eq!(overflowing(), [9, 11, 13, 17, 18, 22, 23, 26, 29]);
    assert_eq!((1..=29).map(truncated_white).max(), Some(286));
    for n in overflowing() {
        assert_eq!(divide(Division::TwoTerm, 255 * n, n), 255);
    }
    for n in [1, 2, 4, 8, 16] {
        assert_eq!(
            divide(Division::TwoTerm, 255 * n, n),
            255,
            "two truncated shifts would give 254"
        );
        assert_eq!(truncated_white(n), 254);
    }
}

#[test]
fn exact_division_is_exact() {
    for n in 1..=32 {
        for sum in 0..=255 * n {
            let rounded = (2 * sum + n) / (2 * n);
            let quotient = (u64::from(sum + n / 2) * u64::from(reciprocal(n))) >> 18;
            assert_eq!(quotient, u64::from(rounded), "{sum}/{n}");
        }
    }
}
