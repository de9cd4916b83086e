//! The edges of all polygons: buckets by the first row, and those that cross the current row.

use crate::cost;
use crate::formats::{Eye, Formats};
use crate::setup::Vertex;
use crate::visibility::edge::{Along, Edge};
use crate::work::{Meter, Operations, Real};
use std::ops::Range;

/// No edge, or the end of a bucket.
const NONE: u32 = u32::MAX;

/// An edge in the table.
struct Entry<T, const EYES: usize, const VALUES: usize> {
    edge: Edge<EYES>,
    polygon: u32,
    /// The next one in the same bucket.
    next: u32,
    /// Depth and further values on the current row.
    values: [T; VALUES],
    slopes: [T; VALUES],
}

/// A polygon in the table.
struct Face<T, const EYES: usize, const VALUES: usize> {
    /// Views in which it is to be seen.
    seen: [bool; EYES],
    /// Its two edges that cross the current row.
    sides: [u32; 2],
    /// Change of each value from pixel to pixel in each view.
    slopes: [[T; VALUES]; EYES],
}

/// Edge table and list of active polygons.
pub(super) struct Table<T, const EYES: usize, const VALUES: usize> {
    entries: Vec<Entry<T, EYES, VALUES>>,
    /// First entry of the edges that begin on each row.
    buckets: Vec<u32>,
    faces: Vec<Face<T, EYES, VALUES>>,
    /// Polygons whose edges cross the current row, in their order.
    active: Vec<u32>,
    eyes: [Eye; EYES],
    formats: Formats,
}

impl<T: Real, const EYES: usize, const VALUES: usize> Table<T, EYES, VALUES> {
    pub fn new(eyes: [Eye; EYES], height: u32, formats: Formats) -> Self {
        let buckets = vec![NONE; height as usize];
        let (entries, faces, active) = (Vec::new(), Vec::new(), Vec::new());
        Table { entries, buckets, faces, active, eyes, formats }
    }

    /// Adds the edges of a polygon to the table.
    ///
    /// The slope of a value v along x is the integral of v dy round the polygon by that of x dy.
    /// Only the latter, the area, depends on the view.
    #[inline]
    pub fn add<'a>(
        &mut self,
        seen: [bool; EYES],
        corners: impl Iterator<Item = &'a Vertex> + Clone,
        values: impl Fn(&Vertex) -> [T; VALUES],
        meter: &mut impl Meter,
    ) {
        let number = self.faces.len() as u32;
        let mut slopes = [[T::of(0.0); VALUES]; EYES];
        if let Some(last) = corners.clone().last().filter(|_| seen.contains(&true)) {
            let mut areas = [T::of(0.0); EYES];
            let mut moments = [T::of(0.0); VALUES];
            let mut from = (last, values(last));
            for corner in corners {
                let to = (corner, values(corner));
                self.side(number, from, to, &mut areas, &mut moments);
                // Differences and sums of coordinates, and the edge.
                let sums = Operations::new(1 + EYES as u64, 0, 0, 0);
                meter.note(|work| work.fixed_point += sums + cost::edge(EYES));
                from = to;
            }
            let one = T::of(self.formats.one_pixel() as f64);
            // Without an area there is no pixel either.
            slopes = areas.map(|area| {
                let scale = one / area;
                moments.map(|moment| moment * scale)
            });
        }
        self.faces.push(Face { seen, sides: [NONE; 2], slopes });
    }

    /// Adds one side of a polygon to its integrals and to the table.
    #[inline]
    fn side(
        &mut self,
        polygon: u32,
        from: (&Vertex, [T; VALUES]),
        to: (&Vertex, [T; VALUES]),
        areas: &mut [T; EYES],
        moments: &mut [T; VALUES],
    ) {
        let real = |n: i32| T::of(f64::from(n));
        let y = |v: &Vertex| v.y[self.eyes[0] as usize];
        let fall = real(y(to.0) - y(from.0));
        for (area, eye) in areas.iter_mut().zip(self.eyes) {
            *area += real(from.0.x[eye as usize] + to.0.x[eye as usize]) * fall;
        }
        for (k, moment) in moments.iter_mut().enumerate() {
            *moment += (from.1[k] + to.1[k]) * fall;
        }
        let (upper, lower) = if y(from.0) <= y(to.0) { (from, to) } else { (to, from) };
        if let Some(on) = Edge::new(upper.0, lower.0, self.eyes, 0, &self.formats) {
            self.insert(on, polygon, [upper.1, lower.1]);
        }
    }

    fn insert(
        &mut self,
        (edge, along): (Edge<EYES>, Along<T>),
        polygon: u32,
        [upper, lower]: [[T; VALUES]; 2],
    ) {
        let Some(bucket) = self.buckets.get_mut(edge.first as usize) else { return };
        let next = std::mem::replace(bucket, self.entries.len() as u32);
        let rise: [T; VALUES] = std::array::from_fn(|k| lower[k] - upper[k]);
        let values = std::array::from_fn(|k| upper[k] + rise[k] * along.start);
        let slopes = rise.map(|rise| rise * along.row);
        self.entries.push(Entry { edge, polygon, next, values, slopes });
    }

    /// Takes the active edges to a row, and drops polygons that end above it.
    pub fn advance(&mut self, row: i32, meter: &mut impl Meter) {
        let Table { entries, faces, active, .. } = self;
        active.retain(|&polygon| {
            let mut left = false;
            for side in faces[polygon as usize].sides {
                let entry = &mut entries[side as usize];
                if entry.edge.end <= row {
                    continue;
                }
                left = true;
                entry.edge.step();
                for (value, &slope) in entry.values.iter_mut().zip(&entry.slopes) {
                    *value += slope;
                }
                meter.note(|work| {
                    work.edge_updates += 1;
                    work.interpolations += (EYES + VALUES) as u64;
                    work.fixed_point += Operations::new(EYES as u64, 0, 0, 0);
                });
            }
            left
        });
    }

    /// Adds the edges that begin on a row: in the place of one that has ended, or the first two of
    /// a polygon.
    pub fn enter(&mut self, row: i32, meter: &mut impl Meter) {
        let Table { entries, buckets, faces, active, .. } = self;
        let mut next = buckets[row as usize];
        while let Some(entry) = entries.get(next as usize) {
            let sides = &mut faces[entry.polygon as usize].sides;
            let first = entries.get(sides[0] as usize);
            let taken = first.is_some_and(|first| first.edge.end > row);
            sides[usize::from(taken)] = next;
            if !taken {
                // Still in the list if its other edge goes on.
                if let Err(place) = active.binary_search(&entry.polygon) {
                    active.insert(place, entry.polygon);
                }
            }
            meter.note(|work| work.edge_updates += 1);
            next = entry.next;
        }
    }

    /// The polygons whose edges cross the current row and that a view is to show, in their order,
    /// with their spans.
    pub fn spans(&self, view: usize) -> impl Iterator<Item = (u32, Span<'_, T, EYES, VALUES>)> {
        let active = self.active.iter().filter(move |&&n| self.faces[n as usize].seen[view]);
        active.map(move |&polygon| (polygon, self.span(polygon, view)))
    }

    /// The span of an active polygon on the current row.
    #[inline]
    pub fn span(&self, polygon: u32, view: usize) -> Span<'_, T, EYES, VALUES> {
        let face = &self.faces[polygon as usize];
        let [a, b] = face.sides.map(|side| &self.entries[side as usize]);
        let [cell, end] = [a, b].map(|side| side.edge.cell(view));
        let (left, columns) = if cell <= end { (a, cell..end) } else { (b, end..cell) };
        Span { columns, left, view, slopes: &face.slopes[view] }
    }
}

/// The pixels of a row that a polygon covers.
pub(super) struct Span<'a, T, const EYES: usize, const VALUES: usize> {
    /// From the first one to before the last one; they may lie outside the view.
    pub columns: Range<i32>,
    left: &'a Entry<T, EYES, VALUES>,
    view: usize,
    slopes: &'a [T; VALUES],
}

impl<T: Real, const EYES: usize, const VALUES: usize> Span<'_, T, EYES, VALUES> {
    /// From the left edge to the centre of a pixel.
    #[inline]
    pub fn offset(&self, column: i32) -> T {
        self.left.edge.offset(self.view, column)
    }

    /// A value from that pixel on.
    #[inline]
    pub fn line(&self, value: usize, offset: T) -> Line<T> {
        let slope = self.slopes[value];
        Line { first: self.left.values[value] + slope * offset, slope }
    }
}

/// A value along a row.
#[derive(Clone, Copy, Debug)]
pub struct Line<T> {
    /// At the first pixel.
    pub first: T,
    /// Change from pixel to pixel.
    pub slope: T,
}
