//! Tables of the filter's division (paper, section 5.6.1).

use crate::formats::FILTER_LIMIT;

const ENTRIES: usize = FILTER_LIMIT as usize + 1;

/// Exponents p, q with 1/n = 2^-p + 2^-q as nearly as possible; entry 0 is not used.
pub const TWO_TERM: [(u32, u32); ENTRIES] = two_term();

/// Exponents p, q, r with 1/n = 2^-p + 2^-q + 2^-r as nearly as possible; entry 0 is not used.
pub const THREE_TERM: [(u32, u32, u32); ENTRIES] = three_term();

/// ceil(2^18/n): with it ((A + n/2)·r) >> 18 is A/n rounded, for every sum A of n bytes.
pub const fn reciprocal(n: u32) -> u32 {
    (1u32 << 18).div_ceil(n)
}

/// Longest shift of the three-term table; longer ones would gain next to nothing.
const LONGEST: u32 = 11;

/// 2^-`exponent` in units of 2^-`LONGEST`.
const fn power(exponent: u32) -> i64 {
    1 << (LONGEST - exponent)
}

/// |`sum` - 1/n| in units of 2^-`LONGEST`/n, for comparing sums at one n.
const fn error(sum: i64, n: u32) -> i64 {
    (sum * n as i64 - power(0)).abs()
}

const fn two_term() -> [(u32, u32); ENTRIES] {
    let mut table = [(0, 0); ENTRIES];
    let mut n = 1;
    while n < ENTRIES {
        let mut best = i64::MAX;
        let mut p = 1;
        while p <= 8 {
            let mut q = p;
            while q <= 8 {
                let error = error(power(p) + power(q), n as u32);
                if error < best {
                    best = error;
                    table[n] = (p, q);
                }
                q += 1;
            }
            p += 1;
        }
        n += 1;
    }
    table
}

const fn three_term() -> [(u32, u32, u32); ENTRIES] {
    let mut table = [(0, 0, 0); ENTRIES];
    let mut n = 1;
    while n < ENTRIES {
        let mut best = i64::MAX;
        let mut p = 1;
        while p <= LONGEST {
            let mut q = p;
            while q <= LONGEST {
                let mut r = q;
                while r <= LONGEST {
                    let error = error(power(p) + power(q) + power(r), n as u32);
                    if error < best {
                        best = error;
                        table[n] = (p, q, r);
                    }
                    r += 1;
                }
                q += 1;
            }
            p += 1;
        }
        n += 1;
    }
    table
}
