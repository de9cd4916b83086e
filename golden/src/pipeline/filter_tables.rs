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
