//! Filter: average of the primary pixels in a secondary pixel (paper, section 5.6.1).

use super::filter_tables::*;
use crate::beat;
use crate::config::{Config, Division};
use crate::formats::*;

beat! {
    /// A beat, as the filter takes it.
    pub struct FilterBeat {
        /// the beat opens a secondary pixel
        first: bool,
        /// the beat is the last in its secondary pixel
        end: bool,
        /// the beat's colour counts
        include: bool,
        /// colour
        rgba: Rgba,
    }
}

beat! {
    /// The average of a secondary pixel.
    pub struct FilterPixel {
        /// average colour, 0 if nothing was averaged
        rgba: Rgba,
        /// number of colours averaged
        count: Count,
    }
}

/// State of the filter.
#[derive(Clone, Debug)]
pub struct Filter {
    division: Division,
    formats: Formats,
    sum: [u32; 4],
    count: u32,
}

impl Filter {
    /// A filter with the division of a configuration.
    pub fn new(config: &Config) -> Filter {
        Filter { division: config.division, formats: Formats::new(config), sum: [0; 4], count: 0 }
    }

    /// Takes a beat; gives the average of the pixel it ends.
    #[inline]
    pub fn step(&mut self, beat: &FilterBeat) -> Option<FilterPixel> {
        if beat.first {
            self.sum = [0; 4];
            self.count = 0;
        }
        if beat.include && self.count < FILTER_LIMIT {
            for (sum, channel) in self.sum.iter_mut().zip(beat.rgba.0) {
                *sum += u32::from(channel);
            }
            self.count += 1;
        }
        beat.end.then(|| FilterPixel {
            rgba: Rgba(self.sum.map(|sum| divide(self.division, sum, self.count))),
            count: Count::new(self.count.into(), &self.formats),
        })
    }
}

/// `sum` of `n` bytes divided by `n` (0 to 29), as the hardware divides.
pub fn divide(division: Division, sum: u32, n: u32) -> u8 {
    if n == 0 {
        return 0;
    }
    let quotient = match division {
        Division::TwoTerm => {
            let (p, q) = TWO_TERM[n as usize];
            shifted_sum(sum, TWO_TERM_SHIFT, [p, q])
        }
        Division::ThreeTerm => {
            let (p, q, r) = THREE_TERM[n as usize];
            shifted_sum(sum, THREE_TERM_SHIFT, [p, q, r])
        }
        Division::Exact => {
            ((u64::from(sum + n / 2) * u64::from(reciprocal(n))) >> RECIPROCAL_SHIFT) as u32
        }
    };
    quotient.min(255) as u8
}

/// Sum of `a`/2^e over the exponents, rounded; added up with `fraction` bits before it is cut.
fn shifted_sum<const N: usize>(a: u32, fraction: u32, exponents: [u32; N]) -> u32 {
    let sum: u32 = exponents.iter().map(|e| a << (fraction - e)).sum();
    (sum + (1 << (fraction - 1))) >> fraction
}

/// Factor that replaces the division by `n` (1 to 29): 2^-p + 2^-q for two terms (paper, equation
/// 1), 2^-p + 2^-q + 2^-r for three, and the exact division's reciprocal.
pub fn factor(division: Division, n: u32) -> f64 {
    let power = |exponent: u32| 1.0 / f64::from(1u32 << exponent);
    match division {
        Division::TwoTerm => {
            let (p, q) = TWO_TERM[n as usize];
            power(p) + power(q)
        }
        Division::ThreeTerm => {
            let (p, q, r) = THREE_TERM[n as usize];
            power(p) + power(q) + power(r)
        }
        Division::Exact => f64::from(reciprocal(n)) * power(RECIPROCAL_SHIFT),
    }
}
