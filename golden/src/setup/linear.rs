//! Functions that are linear over whole pixels.

use crate::formats::FRACTION_BITS;

/// f(i, j) = a·i + b·j + c for pixel (i, j). Sums wrap: hardware registers are narrower still, and
/// a value that fits its register comes out right whatever overflowed on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear {
    /// Change for one pixel to the right.
    pub a: i64,
    /// Change for one pixel down.
    pub b: i64,
    /// Value at pixel (0, 0).
    pub c: i64,
}

impl Linear {
    /// The value at pixel (i, j).
    #[inline]
    pub fn at(&self, i: i64, j: i64) -> i64 {
        let row = self.b.wrapping_mul(j).wrapping_add(self.c);
        self.a.wrapping_mul(i).wrapping_add(row)
    }

    /// Sum of two functions.
    pub fn plus(&self, other: &Linear) -> Linear {
        Linear {
            a: self.a.wrapping_add(other.a),
            b: self.b.wrapping_add(other.b),
            c: self.c.wrapping_add(other.c),
        }
    }
}

/// The plane through three points of a triangle, ready to interpolate any attribute.
///
/// Coefficients have 14 fraction bits, rounded to nearest, and are anchored at the pixel that
/// holds the first corner: the error stays under half a unit within 2^14 pixels of it.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    x: [i128; 3],
    y: [i128; 3],
    det: i128,
    subpixel_bits: u32,
}

impl Plane {
    /// The plane over these corners (in subpixels), which must not lie on a line.
    pub fn new(corners: [[i64; 2]; 3], subpixel_bits: u32) -> Plane {
        let x = corners.map(|c| i128::from(c[0]));
        let y = corners.map(|c| i128::from(c[1]));
        let det = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        Plane { x, y, det, subpixel_bits }
    }

    /// The attribute with these values at the corners, 14 fraction bits, half a unit added so that
    /// dropping the fraction rounds to nearest.
    pub fn through(&self, values: [i64; 3]) -> Linear {
        let v = values.map(i128::from);
        if v[1] == v[0] && v[2] == v[0] {
            let c = (values[0] << FRACTION_BITS) + (1 << (FRACTION_BITS - 1));
            return Linear { a: 0, b: 0, c };
        }
        let Plane { x, y, det, subpixel_bits } = *self;
        let along_x = (v[1] - v[0]) * (y[2] - y[0]) - (v[2] - v[0]) * (y[1] - y[0]);
        let along_y = (x[1] - x[0]) * (v[2] - v[0]) - (x[2] - x[0]) * (v[1] - v[0]);
        let anchor = [x[0] >> subpixel_bits, y[0] >> subpixel_bits];
        let half = 1i128 << (subpixel_bits - 1);
        let offset = [
            (anchor[0] << subpixel_bits) + half - x[0],
            (anchor[1] << subpixel_bits) + half - y[0],
        ];
        let a = round_ratio(along_x << (FRACTION_BITS + subpixel_bits), det);
        let b = round_ratio(along_y << (FRACTION_BITS + subpixel_bits), det);
        let at_anchor = (v[0] << FRACTION_BITS)
            + round_ratio((along_x * offset[0] + along_y * offset[1]) << FRACTION_BITS, det);
        let c = at_anchor - a * anchor[0] - b * anchor[1] + (1 << (FRACTION_BITS - 1));
        // Only the low bits matter, see `Linear`.
        Linear { a: a as i64, b: b as i64, c: c as i64 }
    }
}

/// n/d rounded to the nearest integer, halves upward.
pub(super) fn round_ratio(n: i128, d: i128) -> i128 {
    let (n, d) = if d < 0 { (-n, -d) } else { (n, d) };
    // 64-bit division is several times faster, and nearly always enough.
    if let (Ok(n), Ok(d)) = (i64::try_from(2 * n + d), i64::try_from(2 * d)) {
        return n.div_euclid(d).into();
    }
    (2 * n + d).div_euclid(2 * d)
}
