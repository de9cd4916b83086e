//! Scan-line hidden-surface algorithm, for one view or for both at once.
//!
//! Adelson et al. 1991, "Scan-line algorithms". All edges are put into buckets by their first row.
//! A list holds the polygons whose edges cross the current row, with x and depth of the crossings.
//! On each row their spans are compared pixel by pixel, and the nearest is seen; of equal depths
//! the polygon that comes first. Polygons may pass through each other: the depths of a row are
//! kept until its end.
//!
//! For both views at once there is one set of buckets and one list, and what depends on y alone is
//! computed once: rows, steps along edges, depth and further values there.

mod row;
mod table;

use super::{Items, Surfaces};
use crate::formats::{Eye, Formats};
use crate::setup::{Polygon, Vertex};
use crate::work::{Meter, Real};
use row::Row;
use table::Table;

pub use row::Seen;
pub use table::Line;

/// What one eye sees.
pub fn one<T: Real>(surfaces: &Surfaces, eye: Eye, meter: &mut impl Meter) -> Items {
    let mut items = [surfaces.items()];
    draw_items::<T, 1>(surfaces, [eye], &mut items, meter);
    let [items] = items;
    items
}

/// What both eyes see, in one pass.
pub fn both<T: Real>(surfaces: &Surfaces, meter: &mut impl Meter) -> [Items; 2] {
    let mut items = Eye::BOTH.map(|_| surfaces.items());
    draw_items::<T, 2>(surfaces, Eye::BOTH, &mut items, meter);
    items
}

/// Writes what some eyes see into item buffers of the surfaces' size.
pub fn draw_items<T: Real, const EYES: usize>(
    surfaces: &Surfaces,
    eyes: [Eye; EYES],
    items: &mut [Items; EYES],
    meter: &mut impl Meter,
) {
    let Surfaces { width, height, formats, .. } = *surfaces;
    let depth = |v: &Vertex| [T::of(f64::from(v.depth))];
    let area = Area { width, height, formats };
    draw(&surfaces.opaque, eyes, &area, depth, meter, |view, row, seen: Seen<T, EYES, 1>| {
        items[view].row(row).copy_from_slice(seen.items);
    });
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

/// Draws convex polygons, those that are wanted in any of these views. `values` gives depth and
/// whatever else is to be interpolated of a corner, which must not depend on the view; `paint`
/// receives view, row and what is seen there.
pub fn draw<T: Real, const EYES: usize, const VALUES: usize>(
    polygons: &[Polygon],
    eyes: [Eye; EYES],
    area: &Area,
    values: impl Fn(&Vertex) -> [T; VALUES],
    meter: &mut impl Meter,
    mut paint: impl FnMut(usize, i32, Seen<T, EYES, VALUES>),
) {
    let mut table = Table::new(polygons, eyes, area, values, meter);
    let mut pixels = Row::new(area.width);
    for row in 0..area.height as i32 {
        table.advance(row, meter);
        table.enter(row, meter);
        for view in 0..EYES {
            pixels.resolve(&table, view, meter);
            paint(view, row, pixels.seen(&table, view));
        }
    }
}
