//! Exact steps along an edge, and division by a number that is divided by often.

/// A positive number to divide by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Divisor {
    number: i64,
    reciprocal: f64,
}

impl Divisor {
    #[inline]
    pub fn new(number: i64) -> Divisor {
        Divisor { number, reciprocal: 1.0 / number as f64 }
    }

    /// The quotient, rounded down, and the remainder; exact for quotients of up to 50 bits.
    #[inline]
    pub fn divide(&self, n: i64) -> [i64; 2] {
        // Rounded towards zero from a product that is rounded too: off by one or two.
        let mut quotient = (n as f64 * self.reciprocal) as i64;
        let mut rest = n - quotient * self.number;
        while rest < 0 {
            quotient -= 1;
            rest += self.number;
        }
        while rest >= self.number {
            quotient += 1;
            rest -= self.number;
        }
        [quotient, rest]
    }
}

/// Crossings of an edge with the centre lines of rows in one view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    /// x in subpixels, rounded up.
    x: i32,
    /// Rounding error of x, times the rise of the edge: from 0 to the rise less 1.
    excess: i32,
    /// Subpixels a row, rounded down.
    step: i32,
    /// Remainder of the step, times the rise.
    rest: i32,
    rise: i32,
}

impl Walk {
    /// An edge that runs by `run` subpixels from x while it rises by `rise`, at `below` subpixels
    /// under its upper end.
    #[inline]
    pub fn new(x: i32, run: i64, rise: &Divisor, below: i64, bits: u32) -> Walk {
        let [back, excess] = rise.divide(-run * below);
        let [step, rest] = rise.divide(run << bits);
        Walk {
            x: x - back as i32,
            excess: excess as i32,
            step: step as i32,
            rest: rest as i32,
            rise: rise.number as i32,
        }
    }

    /// The first column whose centre is not left of the edge.
    #[inline]
    pub fn column(&self, bits: u32) -> i32 {
        first_centre(self.x, bits)
    }

    /// Goes on to the next row.
    #[inline]
    pub fn next(&mut self) {
        // Beyond the lower end x may wrap, and is not used.
        self.x = self.x.wrapping_add(self.step);
        self.excess -= self.rest;
        if self.excess < 0 {
            self.x = self.x.wrapping_add(1);
            self.excess += self.rise;
        }
    }
}

/// The first pixel whose centre is not before a place: ceil(n − 1/2), n in subpixels.
#[inline]
pub(super) fn first_centre(n: i32, bits: u32) -> i32 {
    (n + (1 << (bits - 1)) - 1) >> bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn division_is_exact() {
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..1_000_000 {
            let mut number = |bits: u32| random.i64(-1 << bits..=1 << bits) >> random.u32(0..=bits);
            let (quotient, any) = (number(33), number(58));
            let number = number(29).abs() + 1;
            // Whole multiples, and their neighbours.
            let near = quotient * number + random.i64(-1..=1);
            for n in [near, any % (number << 33)] {
                let wanted = [n.div_euclid(number), n.rem_euclid(number)];
                assert_eq!(Divisor::new(number).divide(n), wanted, "{n} / {number}");
            }
        }
    }

    #[test]
    fn walks_end_where_they_should() {
        let mut random = fastrand::Rng::with_seed(2);
        for _ in 0..100_000 {
            let [x, run] = [(); 2].map(|()| random.i32(-1 << 21..=1 << 21));
            let rise = random.i64(1..=1 << 14);
            let bits = random.u32(1..=8);
            let first = random.i64(0..1 << bits).min(rise - 1);
            let rows = (rise - 1 - first) >> bits;
            let mut walk = Walk::new(x, run.into(), &Divisor::new(rise), first, bits);
            (0..rows).for_each(|_| walk.next());
            let along = i64::from(run) * (first + (rows << bits));
            let wanted = i64::from(x) - (-along).div_euclid(rise);
            assert_eq!(i64::from(walk.x), wanted, "{x} {run} {rise} {first} {rows} {bits}");
        }
    }
}
