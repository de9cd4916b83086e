//! Pieces of polygons: what planes have left of them in each view.
//!
//! A cut does not touch the outline. It decides for each pixel that the polygon covers which piece
//! has it, so that the pieces together cover what the polygon does.

use super::part::Part;
use super::plane::Side;
use super::scan::Scan;
use crate::formats::{Eye, Formats};
use crate::setup::{Outline, Polygon};
use std::ops::Range;

/// A polygon, or a part of one.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub polygon: u32,
    /// The part of it that each eye sees, if any.
    pub views: [Option<Region>; 2],
}

/// The part of a piece that an eye sees.
#[derive(Clone, Debug)]
pub(super) struct Region {
    /// Rows with pixels of it.
    pub rows: Range<i32>,
    /// Limits of the columns on each of these rows where the polygon was cut, or nothing.
    pub limits: Vec<[i32; 2]>,
}

impl Region {
    /// Columns of the polygon's span that it has on a row, in a view of this width.
    #[inline]
    pub fn within(&self, row: i32, [first, end]: [i32; 2], width: i32) -> [i32; 2] {
        let (first, end) = (first.max(0), end.min(width));
        if self.limits.is_empty() {
            return [first, end];
        }
        let [low, high] = self.limit(row);
        [first.max(low), end.min(high)]
    }

    /// The limits of the columns on a row.
    #[inline]
    pub fn limit(&self, row: i32) -> [i32; 2] {
        match self.limits.get((row - self.rows.start) as usize) {
            Some(limit) => *limit,
            None if self.limits.is_empty() => [i32::MIN, i32::MAX],
            None => [0, 0],
        }
    }
}

/// A view that pieces are seen in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    pub eye: Eye,
    pub width: u32,
    pub height: u32,
    pub formats: Formats,
}

impl Window {
    /// All that the eye sees of a polygon.
    pub fn whole(&self, polygon: &Polygon) -> Option<Region> {
        if !polygon.eyes.contains(self.eye) {
            return None;
        }
        let all = Region { rows: 0..self.height as i32, limits: Vec::new() };
        let mut rows: Option<Range<i32>> = None;
        self.pixels(polygon, &all, |row, _| {
            let first = rows.as_ref().map_or(row, |rows| rows.start);
            rows = Some(first..row + 1);
        });
        rows.map(|rows| Region { rows, ..all })
    }

    /// Calls `visit` for each row of a region with the first pixel and the one past the last.
    fn pixels(&self, polygon: &Polygon, region: &Region, mut visit: impl FnMut(i32, [i32; 2])) {
        let rows = &region.rows;
        Scan::new().rows(polygon, [self.eye], rows, &self.formats, |row, [span]| {
            let [first, end] = region.within(row, span, self.width as i32);
            if first < end {
                visit(row, [first, end]);
            }
        });
    }

    /// A rectangle around a region.
    pub fn part(&self, polygon: &Polygon, region: &Region) -> Part {
        let [[left, _], [right, _]] = Outline::new(polygon, self.eye).bounds();
        let column = |x: i64| (x >> self.formats.subpixel_bits).clamp(0, self.width.into()) as i32;
        let columns = column(left)..column(right + self.formats.one_pixel());
        Part { columns, rows: region.rows.clone() }
    }

    /// True for the negative, and for the positive side, if a region has pixels there; for neither
    /// if all of it is in the plane.
    pub fn sides(&self, polygon: &Polygon, region: &Region, side: &Side) -> [bool; 2] {
        let corners = self.corner_sides(polygon, side);
        if corners != [true, true] {
            return corners;
        }
        let half = 1i128 << (self.formats.subpixel_bits - 1);
        let centre = |n: i32| (i128::from(n) << self.formats.subpixel_bits) + half;
        let mut found = [false; 2];
        self.pixels(polygon, region, |row, [first, end]| {
            for column in [first, end - 1] {
                let value = side.at(centre(column), centre(row));
                found = [found[0] || value < 0, found[1] || value > 0];
            }
        });
        found
    }

    /// The same of a polygon's corners, and so perhaps of more than its pixels.
    pub fn corner_sides(&self, polygon: &Polygon, side: &Side) -> [bool; 2] {
        let eye = self.eye as usize;
        let values = polygon.vertices.iter().map(|v| side.at(v.x[eye].into(), v.y[eye].into()));
        values.fold([false; 2], |found, value| [found[0] || value < 0, found[1] || value > 0])
    }

    /// The negative and the other part of a region.
    pub fn cut(&self, polygon: &Polygon, region: &Region, side: &Side) -> [Option<Region>; 2] {
        let mut parts = [(); 2].map(|()| Region { rows: 0..0, limits: Vec::new() });
        self.pixels(polygon, region, |row, [first, end]| {
            let [left, right] = region.limit(row);
            let columns = side.columns(row, self.formats.subpixel_bits);
            for (part, [low, high]) in parts.iter_mut().zip(columns) {
                if first.max(low) >= end.min(high) {
                    continue;
                }
                if part.limits.is_empty() {
                    part.rows = row..row;
                }
                // Rows between that have nothing.
                part.limits.resize((row - part.rows.start) as usize, [0, 0]);
                part.limits.push([left.max(low), right.min(high)]);
                part.rows.end = row + 1;
            }
        });
        parts.map(|part| (!part.limits.is_empty()).then_some(part))
    }
}
