//! Edge functions with the top-left rule.

use super::linear::Linear;
use super::polygon::{Polygon, MAX_VERTICES};
use crate::formats::{Eye, Formats};

/// The corners of a polygon in one view, in subpixels; neighbours that fell together are merged.
#[derive(Clone, Copy, Debug)]
pub struct Outline {
    points: [[i64; 2]; MAX_VERTICES],
    count: usize,
}

impl Outline {
    /// Outline of a polygon as an eye sees it.
    pub fn new(polygon: &Polygon, eye: Eye) -> Outline {
        let mut outline = Outline { points: [[0; 2]; MAX_VERTICES], count: 0 };
        for vertex in polygon.vertices.iter().take(MAX_VERTICES) {
            let point = [vertex.x[eye as usize].into(), vertex.y[eye as usize].into()];
            if outline.count == 0 || outline.points[outline.count - 1] != point {
                outline.points[outline.count] = point;
                outline.count += 1;
            }
        }
        while outline.count > 1 && outline.points[0] == outline.points[outline.count - 1] {
            outline.count -= 1;
        }
        outline
    }

    /// The corners.
    pub fn points(&self) -> &[[i64; 2]] {
        &self.points[..self.count]
    }

    /// Twice the signed area in square subpixels; positive for clockwise as seen (y is down).
    pub fn doubled_area(&self) -> i64 {
        let points = self.points();
        let Some(&[x0, y0]) = points.first() else { return 0 };
        let turns = points.windows(2).map(|pair| {
            let [[x1, y1], [x2, y2]] = [pair[0], pair[1]];
            (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        });
        turns.sum()
    }

    /// True if every corner turns the same way, or not at all, and the outline goes round once.
    pub fn is_convex(&self) -> bool {
        let points = self.points();
        let sign = self.doubled_area().signum();
        let corner = |k: usize| points[k % self.count];
        let turns_alike = (0..self.count).all(|k| {
            let ([x0, y0], [x1, y1], [x2, y2]) = (corner(k), corner(k + 1), corner(k + 2));
            ((x1 - x0) * (y2 - y1) - (x2 - x1) * (y1 - y0)).signum() * sign >= 0
        });
        // A star turns alike too, but its y direction changes more than twice.
        let mut changes = 0;
        let mut direction = 0;
        for k in 0..2 * self.count {
            let step = (corner(k + 1)[1] - corner(k)[1]).signum();
            if step != 0 && k >= self.count && step != direction {
                changes += 1;
            }
            if step != 0 {
                direction = step;
            }
        }
        turns_alike && changes <= 2
    }

    /// Positions of the corners of the largest triangle of the fan from the first corner.
    pub fn largest_fan_triangle(&self) -> [usize; 3] {
        let points = self.points();
        let area = |k: usize| {
            let [[x0, y0], [x1, y1], [x2, y2]] = [points[0], points[k], points[k + 1]];
            ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)).abs()
        };
        let best = (1..points.len() - 1).max_by_key(|&k| (area(k), usize::MAX - k)).unwrap_or(1);
        [0, best, best + 1]
    }

    /// Smallest and largest corner: `[[x, y], [x, y]]`.
    pub fn bounds(&self) -> [[i64; 2]; 2] {
        let mut bounds = [[i64::MAX; 2], [i64::MIN; 2]];
        for point in self.points() {
            for axis in 0..2 {
                bounds[0][axis] = bounds[0][axis].min(point[axis]);
                bounds[1][axis] = bounds[1][axis].max(point[axis]);
            }
        }
        bounds
    }

    /// The edge functions, positive inside; the outline must have an area.
    pub fn edges(&self, formats: &Formats) -> impl Iterator<Item = Edge> + '_ {
        let sign = self.doubled_area().signum();
        let formats = *formats;
        (0..self.count).map(move |k| {
            let [from, to] = [self.points[k], self.points[(k + 1) % self.count]];
            Edge::new(from, to, sign, &formats)
        })
    }
}

/// Extent of the visited pixels of a row, from the span [xl, xr] between its edges on the centre line, with
/// anti-aliasing the span of the band of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Covered centres only.
    Covered,
    /// From floor(xl - 1/2) to ceil(xr - 1/2), for a polygon that the secondary pipeline follows.
    Extended {
        /// Pixels more on both sides.
        widening: i64,
        /// From 0 to 256: a pixel at the end is spared if its centre is more than 1 - `spared`/256
        /// pixels from the edge.
        spared: i64,
    },
}

/// An edge function E(x, y) = a·x + b·y + k in subpixels, positive inside the polygon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edge {
    /// Change of E for one subpixel in x, and of [`Edge::value`] for one pixel.
    pub a: i64,
    /// Change of E for one subpixel in y, and of [`Edge::value`] for one pixel.
    pub b: i64,
    k: i64,
    value: Linear,
    low: i64,
}

impl Edge {
    fn new(from: [i64; 2], to: [i64; 2], sign: i64, formats: &Formats) -> Edge {
        let a = (from[1] - to[1]) * sign;
        let b = (to[0] - from[0]) * sign;
        let k = -(a * from[0] + b * from[1]);
        let top_left = a > 0 || (a == 0 && b > 0);
        let half = formats.one_pixel() / 2;
        // E at the centre of pixel (0, 0); the bias decides which side owns E = 0.
        let corner = (a + b) * half + k - i64::from(!top_left);
        let c = corner >> formats.subpixel_bits;
        let low = corner & (formats.one_pixel() - 1);
        Edge { a, b, k, value: Linear { a, b, c }, low }
    }

    /// E' at pixel centres: a pixel is inside where it is not negative. The subpixel bits, the
    /// same at every centre, are dropped (`low`).
    pub fn value(&self) -> Linear {
        self.value
    }

    /// The three highest dropped bits.
    pub fn low(&self, formats: &Formats) -> i64 {
        self.low >> (formats.subpixel_bits - 3)
    }

    /// Exclusive upper bound of E' up to the pixel that a row begins with, for a left edge (a > 0), and from the pixel
    /// that it ends with, for a right one. With x where the edge crosses the row's band of samples that is
    /// `reach.widening` pixels beyond floor(x - 1/2) or ceil(x - 1/2), or the next one inside, if the edge is more than
    /// 1 - `reach.spared`/256 pixels from its centre; and at least all that is covered. So a traversal that has E'
    /// needs no other knowledge of its span.
    pub(super) fn span_bound(&self, reach: Reach, formats: &Formats) -> i64 {
        let Reach::Extended { widening, spared } = reach else { return self.a.abs() };
        let top_left = self.a > 0 || (self.a == 0 && self.b > 0);
        let pixel = formats.one_pixel();
        // E + beyond <= 0 there, with E = pixel * E' + low + bias.
        let band = self.b.abs() * formats.sample_reach();
        let beyond = 256 * band + self.a.abs() * (256 * widening - spared) * pixel;
        let bias = i64::from(!top_left);
        let bound = (-256 * (self.low + bias) - beyond).div_euclid(256 * pixel) + 1;
        bound.min(self.a.abs())
    }
}
