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
use crate::setup::Vertex;
use crate::work::{Meter, Real};
use row::Depths;
use table::Table;

pub use row::Seen;
pub use table::Line;

/// Item buffer of one eye.
pub fn one<T: Real>(surfaces: &Surfaces, eye: Eye, meter: &mut impl Meter) -> Items {
    let mut items = [surfaces.items()];
    draw_items::<T, 1>(surfaces, [eye], &mut items, meter);
    let [items] = items;
    items
}

/// Item buffers of both eyes, in one pass; in one for each if they do not share their rows
/// ([`Surfaces::level`]).
pub fn both<T: Real>(surfaces: &Surfaces, meter: &mut impl Meter) -> [Items; 2] {
    if surfaces.level().is_err() {
        return Eye::BOTH.map(|eye| one::<T>(surfaces, eye, meter));
    }
    let mut items = Eye::BOTH.map(|_| surfaces.items());
    draw_items::<T, 2>(surfaces, Eye::BOTH, &mut items, meter);
    items
}

/// Writes what some eyes that share their rows see into item buffers of the surfaces' size.
pub fn draw_items<T: Real, const EYES: usize>(
    surfaces: &Surfaces,
    eyes: [Eye; EYES],
    items: &mut [Items; EYES],
    meter: &mut impl Meter,
) {
    let depth = |v: &Vertex| [T::of(f64::from(v.depth))];
    let polygons = surfaces.opaque.iter();
    let polygons = polygons.map(|p| (eyes.map(|eye| p.eyes.contains(eye)), p.vertices.iter()));
    let nothing = |_: Seen<T, EYES, 1>, _: &mut _| ();
    draw(polygons, eyes, &surfaces.formats, depth, items, meter, nothing);
}

/// Draws convex polygons into item buffers of one size. Of each polygon is given in which of the
/// views it is to be seen, and its corners.
///
/// `values` gives depth and whatever else is to be interpolated of a corner, which must not depend
/// on the view; `paint` is told what is seen on each row of each view.
pub fn draw<'a, T: Real, C, M: Meter, const EYES: usize, const VALUES: usize>(
    polygons: impl Iterator<Item = ([bool; EYES], C)>,
    eyes: [Eye; EYES],
    formats: &Formats,
    values: impl Fn(&Vertex) -> [T; VALUES],
    items: &mut [Items; EYES],
    meter: &mut M,
    mut paint: impl FnMut(Seen<T, EYES, VALUES>, &mut M),
) where
    C: Iterator<Item = &'a Vertex> + Clone,
{
    let Items { width, height, .. } = items[0];
    let mut table = Table::new(eyes, height, *formats);
    for (seen, corners) in polygons {
        meter.note(|work| work.polygons += seen.iter().filter(|&&seen| seen).count() as u64);
        table.add(seen, corners, &values, meter);
    }
    let mut depths = Depths::new(width);
    for row in 0..height as i32 {
        table.advance(row, meter);
        table.enter(row, meter);
        for (view, items) in items.iter_mut().enumerate() {
            let items = items.row(row);
            depths.resolve(&table, view, items, meter);
            paint(Seen { view, row, items, table: &table }, meter);
        }
    }
}
