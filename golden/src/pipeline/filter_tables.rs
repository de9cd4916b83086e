//! Tables of the filter's division by n (paper, section 5.6.1), shared by the model and, through
//! the generated header, by the Verilog. Index 0 is unused and zero.

use crate::formats::FILTER_LIMIT;

/// Entries of a table: one for each n, and the unused one.
const ENTRIES: usize = FILTER_LIMIT as usize + 1;

/// Fraction bits of the two-term sum: no exponent in [`TWO_TERM`] exceeds it.
pub const TWO_TERM_SHIFT: u32 = 8;

/// Fraction bits of the three-term sum: no exponent in [`THREE_TERM`] exceeds it.
///
/// The published figures of three terms, 6.25 % and 1.27 %, need exponents up to 11: with 9
/// fraction bits the mean is 1.51 %, with 12 it would be 1.26 %.
pub const THREE_TERM_SHIFT: u32 = 11;

/// Fraction bits of the exact reciprocals.
pub const RECIPROCAL_SHIFT: u32 = 18;

/// 1/n ≈ 2^-p + 2^-q, as (p, q) with p ≤ q.
pub const TWO_TERM: [(u32, u32); ENTRIES] = two_term();

/// 1/n ≈ 2^-p + 2^-q + 2^-r, as (p, q, r) with p ≤ q ≤ r; of triples with the same sum the one
/// with the smallest r.
pub const THREE_TERM: [(u32, u32, u32); ENTRIES] = three_term();

/// ceil(2^18 / n), with which ((A + n/2)·reciprocal(n)) >> 18 is A/n rounded to nearest; 0 for 0.
pub const fn reciprocal(n: u32) -> u32 {
    if n == 0 {
        0
    } else {
        (1u32 << RECIPROCAL_SHIFT).div_ceil(n)
    }
}

/// Distance of `sum`/2^`shift` from 1/n, in units that are the same for every sum of that n.
const fn distance(sum: u32, n: u32, shift: u32) -> u32 {
    (sum * n).abs_diff(1 << shift)
}

const fn two_term() -> [(u32, u32); ENTRIES] {
    let mut table = [(0, 0); ENTRIES];
    let mut n = 1;
    while n < ENTRIES {
        let mut best = u32::MAX;
        let mut q = 1;
        while q <= TWO_TERM_SHIFT {
            let mut p = 1;
            while p <= q {
                let sum = (1 << (TWO_TERM_SHIFT - p)) + (1 << (TWO_TERM_SHIFT - q));
                let d = distance(sum, n as u32, TWO_TERM_SHIFT);
                if d < best {
                    best = d;
                    table[n] = (p, q);
                }
                p += 1;
            }
            q += 1;
        }
        n += 1;
    }
    table
}

const fn three_term() -> [(u32, u32, u32); ENTRIES] {
    let mut table = [(0, 0, 0); ENTRIES];
    let mut n = 1;
    while n < ENTRIES {
        let mut best = u32::MAX;
        let mut r = 1;
        while r <= THREE_TERM_SHIFT {
            let mut q = 1;
            while q <= r {
                let mut p = 1;
                while p <= q {
                    let sum = (1 << (THREE_TERM_SHIFT - p))
                        + (1 << (THREE_TERM_SHIFT - q))
                        + (1 << (THREE_TERM_SHIFT - r));
                    let d = distance(sum, n as u32, THREE_TERM_SHIFT);
                    if d < best {
                        best = d;
                        table[n] = (p, q, r);
                    }
                    p += 1;
                }
                q += 1;
            }
            r += 1;
        }
        n += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest and mean relative error over n = 1 to 29 of sums with `shift` fraction bits.
    fn errors(shift: u32, sum: impl Fn(usize) -> u32) -> (f64, f64) {
        let error = |n: usize| f64::from(distance(sum(n), n as u32, shift)) / f64::from(1 << shift);
        let all = (1..ENTRIES).map(error);
        (all.clone().fold(0.0, f64::max), all.sum::<f64>() / f64::from(FILTER_LIMIT))
    }

    #[test]
    fn two_terms_have_the_published_errors() {
        let sum = |n: usize| (256 >> TWO_TERM[n].0) + (256 >> TWO_TERM[n].1);
        let (largest, mean) = errors(TWO_TERM_SHIFT, sum);
        assert_eq!(largest, 0.125);
        // The paper's 4.26 % leaves out n = 1, which is exact.
        assert!((mean * 29.0 / 28.0 - 0.04255022321428571).abs() < 1e-12, "mean {mean}");
        #[rustfmt::skip]
        let published = [
            (1, 1), (2, 2), (2, 4), (3, 3), (3, 4), (3, 5), (3, 6), (4, 4), (4, 4), (4, 5),
            (4, 5), (4, 6), (4, 6), (4, 7), (4, 8), (5, 5), (5, 5), (5, 5), (5, 6), (5, 6),
            (5, 6), (5, 6), (5, 6), (5, 7), (5, 7), (5, 7), (5, 8), (5, 8), (5, 8),
        ];
        assert_eq!(TWO_TERM[1..], published);
    }

    #[test]
    fn three_terms_have_the_known_errors() {
        let sum = |n: usize| {
            let (p, q, r) = THREE_TERM[n];
            (2048 >> p) + (2048 >> q) + (2048 >> r)
        };
        let (largest, mean) = errors(THREE_TERM_SHIFT, sum);
        assert_eq!(largest, 0.0625);
        assert!((mean - 0.0127458).abs() < 1e-7, "mean {mean}");
        assert!(THREE_TERM.iter().all(|(p, q, r)| p <= q && q <= r && *r <= THREE_TERM_SHIFT));
    }

    #[test]
    fn reciprocals_divide_exactly() {
        for n in 1..=FILTER_LIMIT {
            for sum in 0..=255 * n {
                let quotient = ((sum + n / 2) * reciprocal(n)) >> RECIPROCAL_SHIFT;
                assert_eq!(quotient, (2 * sum + n) / (2 * n), "{sum} / {n}");
            }
        }
    }
}
