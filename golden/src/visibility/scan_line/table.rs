//! The edges of all polygons: buckets by the first row, and the list of the active ones.

use super::Area;
use crate::formats::Eye;
use crate::setup::{Polygon, Vertex};
use crate::visibility::edge::{Along, Edge};
use crate::work::{Meter, Real};

/// No edge, or the end of a bucket.
const NONE: u32 = u32::MAX;

/// An edge in the table.
pub(super) struct Entry<T, const EYES: usize, const VALUES: usize> {
    pub edge: Edge<T, EYES>,
    pub polygon: u32,
    /// The next one in the same bucket.
    next: u32,
    /// Depth and further values on the current row.
    pub values: [T; VALUES],
    slopes: [T; VALUES],
    /// Views in which the polygon is to be seen.
    pub seen: [bool; EYES],
}

/// An active edge in the order of one view.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub cell: i32,
    pub entry: u32,
}

pub(super) struct Table<T, const EYES: usize, const VALUES: usize> {
    entries: Vec<Entry<T, EYES, VALUES>>,
    /// First entry of the edges that begin on each row.
    buckets: Vec<u32>,
    /// The two active edges of each polygon.
    pairs: Vec<[u32; 2]>,
    /// Active edges by x in each view.
    order: [Vec<Place>; EYES],
    /// Room for the edges that begin on a row.
    fresh: Vec<Place>,
}

impl<T: Real, const EYES: usize, const VALUES: usize> Table<T, EYES, VALUES> {
    pub fn new(
        polygons: &[Polygon],
        eyes: [Eye; EYES],
        area: &Area,
        values: impl Fn(&Vertex) -> [T; VALUES],
        meter: &mut impl Meter,
    ) -> Self {
        let mut table = Table {
            entries: Vec::with_capacity(3 * polygons.len()),
            buckets: vec![NONE; area.height as usize],
            pairs: vec![[NONE; 2]; polygons.len()],
            order: eyes.map(|_| Vec::new()),
            fresh: Vec::new(),
        };
        for (n, polygon) in polygons.iter().enumerate() {
            let seen = eyes.map(|eye| polygon.eyes.contains(eye));
            let Some(mut from) = polygon.vertices.last().filter(|_| seen.contains(&true)) else {
                continue;
            };
            meter.note(|work| work.polygons += seen.iter().filter(|&&seen| seen).count() as u64);
            for to in &polygon.vertices {
                let (upper, lower) = if from.y[0] <= to.y[0] { (from, to) } else { (to, from) };
                from = to;
                if let Some(on) = Edge::new(upper, lower, eyes, 0, &area.formats) {
                    table.insert(on, n as u32, seen, [values(upper), values(lower)]);
                    meter.note(|work| work.edge_updates += 1);
                }
            }
        }
        table
    }

    fn insert(
        &mut self,
        (edge, along): (Edge<T, EYES>, Along<T>),
        polygon: u32,
        seen: [bool; EYES],
        [upper, lower]: [[T; VALUES]; 2],
    ) {
        let Some(bucket) = self.buckets.get_mut(edge.first as usize) else { return };
        let next = std::mem::replace(bucket, self.entries.len() as u32);
        let rise: [T; VALUES] = std::array::from_fn(|k| lower[k] - upper[k]);
        let values = std::array::from_fn(|k| upper[k] + rise[k] * along.start);
        let slopes = rise.map(|rise| rise * along.row);
        self.entries.push(Entry { edge, polygon, next, values, slopes, seen });
    }

    /// Drops the active edges that end above a row and takes the others to it; how many these are.
    pub fn advance(&mut self, row: i32, meter: &mut impl Meter) -> usize {
        let entries = &mut self.entries;
        self.order[0].retain_mut(|place| {
            let entry = &mut entries[place.entry as usize];
            if entry.edge.end <= row {
                return false;
            }
            entry.edge.step();
            for (value, &slope) in entry.values.iter_mut().zip(&entry.slopes) {
                *value += slope;
            }
            place.cell = entry.edge.x[0].cell;
            meter.note(|work| {
                work.edge_updates += 1;
                work.interpolations += (EYES + VALUES) as u64;
            });
            true
        });
        for (view, order) in self.order.iter_mut().enumerate().skip(1) {
            order.retain_mut(|place| {
                let edge = &entries[place.entry as usize].edge;
                place.cell = edge.x[view].cell;
                edge.end > row
            });
        }
        self.order[0].len()
    }

    /// Adds the edges that begin on a row, behind the active ones.
    pub fn enter(&mut self, row: i32) {
        let mut next = self.buckets[row as usize];
        while let Some(entry) = self.entries.get(next as usize) {
            let pair = &mut self.pairs[entry.polygon as usize];
            let first = self.entries.get(pair[0] as usize);
            let taken = first.is_some_and(|first| first.edge.end > row);
            pair[usize::from(taken)] = next;
            for (view, order) in self.order.iter_mut().enumerate() {
                order.push(Place { cell: entry.edge.x[view].cell, entry: next });
            }
            next = entry.next;
        }
    }

    /// Puts the active edges of a view into the order of x: the `old` first ones were in order on
    /// the row above.
    pub fn sort(&mut self, view: usize, old: usize, meter: &mut impl Meter) {
        let order = &mut self.order[view];
        insertion_sort(&mut order[..old], meter);
        insertion_sort(&mut order[old..], meter);
        // Merged from the end, with the new ones out of the way.
        self.fresh.clear();
        self.fresh.extend_from_slice(&order[old..]);
        let (mut k, mut end) = (old, order.len());
        while let Some(&fresh) = self.fresh.last() {
            end -= 1;
            if k > 0 && order[k - 1].cell > fresh.cell {
                k -= 1;
                order[end] = order[k];
            } else {
                order[end] = fresh;
                self.fresh.pop();
            }
            meter.note(|work| work.edge_updates += 1);
        }
    }

    /// The active edges of a view by x.
    pub fn order(&self, view: usize) -> &[Place] {
        &self.order[view]
    }

    pub fn entry(&self, entry: u32) -> &Entry<T, EYES, VALUES> {
        &self.entries[entry as usize]
    }

    /// The active edges of a polygon, by x.
    #[inline]
    pub fn sides(&self, polygon: u32, view: usize) -> [&Entry<T, EYES, VALUES>; 2] {
        let [a, b] = self.pairs[polygon as usize].map(|n| self.entry(n));
        if a.edge.x[view].cell > b.edge.x[view].cell {
            [b, a]
        } else {
            [a, b]
        }
    }
}

/// Puts edges that are nearly in the order of x into it.
fn insertion_sort(order: &mut [Place], meter: &mut impl Meter) {
    for n in 1..order.len() {
        let place = order[n];
        let mut k = n;
        while k > 0 && order[k - 1].cell > place.cell {
            order[k] = order[k - 1];
            k -= 1;
        }
        order[k] = place;
        meter.note(|work| work.edge_updates += (n - k) as u64);
    }
}
