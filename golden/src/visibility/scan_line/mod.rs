//! Scan-line hidden-surface algorithm, for one view or for both at once.
//!
//! Adelson et al. 1991, "Scan-line algorithms". All edges are put into buckets by their first row.
//! A list holds the edges that cross the current row, with their depth there. For each view the
//! list is sorted by x; between two neighbours the set of polygons that cover the pixels does not
//! change, and the nearest of them is seen. For both views at once there is one set of buckets and
//! one list, and what depends on y (rows, depth, colours along edges) is computed once.
//!
//! Polygons may pass through each other. Depth is linear along a row, so a polygon that is nearest
//! at both ends of an interval is nearest all along it; where different ones are, every pixel is
//! looked at. Of equal depths the polygon that comes first is seen.

mod row;
mod table;

use super::{Items, Surfaces};
use crate::formats::{Eye, Formats};
use crate::setup::{Polygon, Vertex};
use crate::work::{Meter, Real};
use row::Walk;
use std::ops::Range;
use table::Table;

/// What one eye sees.
pub fn one<T: Real>(surfaces: &Surfaces, eye: Eye, meter: &mut impl Meter) -> Items {
    let [items] = items::<T, 1>(surfaces, [eye], meter);
    items
}

/// What both eyes see, in one pass.
pub fn both<T: Real>(surfaces: &Surfaces, meter: &mut impl Meter) -> [Items; 2] {
    items::<T, 2>(surfaces, Eye::BOTH, meter)
}

fn items<T: Real, const EYES: usize>(
    surfaces: &Surfaces,
    eyes: [Eye; EYES],
    meter: &mut impl Meter,
) -> [Items; EYES] {
    let Surfaces { width, height, formats, .. } = *surfaces;
    let mut items = eyes.map(|_| Items::new(width, height));
    let depth = |v: &Vertex| [T::of(f64::from(v.depth))];
    draw(&surfaces.opaque, eyes, &Area { width, height, formats }, depth, &mut items, meter);
    items
}

/// The pixels of a view.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Widths of coordinates.
    pub formats: Formats,
}

/// A value along a row.
#[derive(Clone, Copy, Debug)]
pub struct Line<T> {
    /// At the first pixel.
    pub first: T,
    /// Change from pixel to pixel.
    pub slope: T,
}

/// What receives the visible parts of rows.
pub trait Paint<T> {
    /// `columns` of a row show a polygon. `value` tells the values that are interpolated beside
    /// depth, counted from 0; all columns lie between the polygon's edges.
    fn run(
        &mut self,
        view: usize,
        row: i32,
        columns: Range<i32>,
        polygon: u32,
        value: impl Fn(usize) -> Line<T>,
    );
}

impl<T: Real, const EYES: usize> Paint<T> for [Items; EYES] {
    #[inline]
    fn run(
        &mut self,
        view: usize,
        row: i32,
        columns: Range<i32>,
        polygon: u32,
        _: impl Fn(usize) -> Line<T>,
    ) {
        self[view].span(row, columns.start, columns.end).fill(polygon);
    }
}

/// Draws convex polygons, those that are wanted in any of these views. `values` gives depth and
/// whatever else is to be interpolated of a corner, which must not depend on the view.
pub fn draw<T: Real, const EYES: usize, const VALUES: usize>(
    polygons: &[Polygon],
    eyes: [Eye; EYES],
    area: &Area,
    values: impl Fn(&Vertex) -> [T; VALUES],
    paint: &mut impl Paint<T>,
    meter: &mut impl Meter,
) {
    let mut table = Table::new(polygons, eyes, area, values, meter);
    let mut open = Vec::new();
    for row in 0..area.height as i32 {
        let old = table.advance(row, meter);
        table.enter(row);
        for view in 0..EYES {
            table.sort(view, old, meter);
            Walk::new(&table, view, row, &mut *paint, &mut *meter).go(area.width as i32, &mut open);
        }
    }
}
