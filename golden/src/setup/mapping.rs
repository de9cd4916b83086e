//! The affine map from primary to secondary positions (paper, appendix).

use super::linear::round_ratio;
use crate::formats::{Formats, Quantity, SecondaryX, FILTER_LIMIT, FRACTION_BITS};

/// Secondary position of a primary position, exact for the snapped triangle:
/// x_s = (scale·x + shear·y)/det + constant, and the same for y with a tilted head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Map {
    det: i128,
    x: Axis,
    y: Axis,
    origin: [i64; 2],
    subpixel_bits: u32,
}

/// One coordinate of the map: numerators over the common determinant, and the value at the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Axis {
    scale: i128,
    shear: i128,
    origin: i128,
}

impl Axis {
    fn numerator(&self, det: i128, dx: i128, dy: i128) -> i128 {
        self.origin * det + self.scale * dx + self.shear * dy
    }
}

impl Map {
    /// The map that takes the primary corners to the secondary ones; none if the primary has no
    /// area.
    pub fn new(primary: [[i64; 2]; 3], secondary: [[i64; 2]; 3], formats: &Formats) -> Option<Map> {
        let difference = |points: [[i64; 2]; 3], axis: usize| {
            [1, 2].map(|k: usize| i128::from(points[k][axis] - points[0][axis]))
        };
        let [x1, x2] = difference(primary, 0);
        let [y1, y2] = difference(primary, 1);
        let det = x1 * y2 - x2 * y1;
        let axis = |n: usize| {
            let [s1, s2] = difference(secondary, n);
            Axis {
                scale: (s1 * y2 - s2 * y1) * det.signum(),
                shear: (x1 * s2 - x2 * s1) * det.signum(),
                origin: secondary[0][n].into(),
            }
        };
        (det != 0).then(|| Map {
            det: det.abs(),
            x: axis(0),
            y: axis(1),
            origin: primary[0],
            subpixel_bits: formats.subpixel_bits,
        })
    }

    /// The map that moves nothing, for edges lent to the primary.
    pub fn identity(formats: &Formats) -> Map {
        Map {
            det: 1,
            x: Axis { scale: 1, shear: 0, origin: 0 },
            y: Axis { scale: 0, shear: 1, origin: 0 },
            origin: [0; 2],
            subpixel_bits: formats.subpixel_bits,
        }
    }

    /// True if 0 < G1 <= 1, and the secondary y moves by at most one pixel a step.
    pub fn is_monotone(&self) -> bool {
        0 < self.x.scale && self.x.scale <= self.det && self.y.scale.abs() <= self.det
    }

    /// True if more than 29 primary pixels may fall into one secondary pixel.
    pub fn exceeds_filter(&self) -> bool {
        self.x.scale * i128::from(FILTER_LIMIT) < self.det
    }

    /// Pixels by which anti-aliasing widens a span: ceil(3(1 + |G2|)/(8·G1)).
    pub fn widening(&self) -> i64 {
        let n = 3 * (self.det + self.x.shear.abs());
        let d = 8 * self.x.scale;
        i64::try_from((n + d - 1).div_euclid(d)).unwrap_or(i64::MAX)
    }

    /// G1 with 14 fraction bits, to nearest.
    pub fn scale(&self) -> i64 {
        round_ratio(self.x.scale << FRACTION_BITS, self.det) as i64
    }

    /// Row shear G2 + m·G1 with 14 fraction bits, to nearest; saturated where it exceeds 63 bits.
    pub fn row_shear(&self, movement: i64) -> i64 {
        self.row(&self.x, movement)
    }

    /// Movement of the secondary y for one primary pixel, 14 fraction bits.
    pub fn slant(&self) -> i64 {
        round_ratio(self.y.scale << FRACTION_BITS, self.det) as i64
    }

    /// Movement of the secondary y from row start to row start, 14 fraction bits.
    pub fn row_rise(&self, movement: i64) -> i64 {
        self.row(&self.y, movement)
    }

    /// True if the secondary's movement for a movement of the row start fits the row registers.
    pub fn allows(&self, movement: i64, formats: &Formats) -> bool {
        SecondaryX::fits(self.row_shear(movement), formats)
            && SecondaryX::fits(self.row_rise(movement), formats)
    }

    /// Part of a pixel's width, in 256ths, that may lie between its centre and the edge inside it without a secondary
    /// pixel being found on it alone, for a polygon of so many `rows` and `columns` (docs/theory.md): 1/2 less the
    /// error of the register, in secondary pixels. With a tilted head a secondary pixel ends with its row too: nothing.
    pub fn spared(&self, rows: u64, columns: u64) -> i64 {
        if self.y.scale != 0 {
            return 0;
        }
        // In 2^-15 pixels: start, rows, creeping and steps, each rounded to half a place.
        let error = i128::from(1 + 2 * rows + columns);
        let half = 1 << FRACTION_BITS;
        ((half - error).max(0) * self.det / (128 * self.x.scale)).min(256) as i64
    }

    fn row(&self, axis: &Axis, movement: i64) -> i64 {
        let numerator = axis.shear + axis.scale * i128::from(movement);
        let row = round_ratio(numerator << FRACTION_BITS, self.det);
        row.clamp(i64::MIN.into(), i64::MAX.into()) as i64
    }

    /// Secondary x of the centre of primary pixel (i, j), 14 fraction bits, to nearest.
    pub fn x_at(&self, i: i64, j: i64) -> i64 {
        self.at(&self.x, i, j)
    }

    /// Secondary y of the centre of primary pixel (i, j), 14 fraction bits, to nearest.
    pub fn y_at(&self, i: i64, j: i64) -> i64 {
        self.at(&self.y, i, j)
    }

    fn at(&self, axis: &Axis, i: i64, j: i64) -> i64 {
        let [dx, dy] = self.offset(i, j);
        let numerator = axis.numerator(self.det, dx, dy);
        round_ratio(numerator << FRACTION_BITS, self.det << self.subpixel_bits) as i64
    }

    /// Distance of a pixel centre from the origin, in subpixels.
    fn offset(&self, i: i64, j: i64) -> [i128; 2] {
        let half = 1i64 << (self.subpixel_bits - 1);
        let centre = |n: i64| (n << self.subpixel_bits) + half;
        [(centre(i) - self.origin[0]).into(), (centre(j) - self.origin[1]).into()]
    }

    /// First and last primary pixel on row j that may fall into secondary columns 0 to width - 1,
    /// with one pixel to spare on each side.
    pub fn window(&self, j: i64, width: i64) -> [i64; 2] {
        let [dx, dy] = self.offset(0, j);
        let at_zero = self.x.numerator(self.det, dx, dy);
        let pixel = self.x.scale << self.subpixel_bits;
        let right = (i128::from(width) * self.det) << self.subpixel_bits;
        let first = (-at_zero).div_euclid(pixel) - 1;
        let last = (right - at_zero).div_euclid(pixel) + 2;
        [first, last].map(|i| i.clamp(i32::MIN.into(), i32::MAX.into()) as i64)
    }
}
