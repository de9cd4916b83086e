//! One row of one view: intervals between edges, and what is seen on each.

use super::table::{Entry, Table};
use super::{Line, Paint};
use crate::work::{Meter, Real};
use std::ops::Range;

/// A polygon over the current interval.
pub(super) struct Open<T> {
    polygon: u32,
    /// First pixel of its span.
    start: i32,
    /// Depth from there on, once it is needed.
    depth: Option<Line<T>>,
}

/// A walk along a row.
pub(super) struct Walk<'a, T, P, M, const EYES: usize, const VALUES: usize> {
    table: &'a Table<T, EYES, VALUES>,
    view: usize,
    row: i32,
    /// Neighbouring pixels that show one polygon, not yet painted.
    run: Option<(u32, Range<i32>)>,
    paint: &'a mut P,
    meter: &'a mut M,
}

impl<'a, T: Real, P: Paint<T>, M: Meter, const EYES: usize, const VALUES: usize>
    Walk<'a, T, P, M, EYES, VALUES>
{
    pub fn new(
        table: &'a Table<T, EYES, VALUES>,
        view: usize,
        row: i32,
        paint: &'a mut P,
        meter: &'a mut M,
    ) -> Self {
        Walk { table, view, row, run: None, paint, meter }
    }

    /// Walks from column 0 to the last one. `open` is room for the polygons on the way.
    pub fn go(mut self, width: i32, open: &mut Vec<Open<T>>) {
        open.clear();
        let mut from = 0;
        for place in self.table.order(self.view) {
            let entry = self.table.entry(place.entry);
            if !entry.seen[self.view] {
                continue;
            }
            let end = place.cell.min(width);
            if from < end {
                self.interval(open, from..end);
                from = end;
            }
            match open.iter().position(|open| open.polygon == entry.polygon) {
                Some(k) => {
                    open.swap_remove(k);
                }
                None => {
                    open.push(Open { polygon: entry.polygon, start: place.cell, depth: None });
                }
            }
        }
        self.finish();
    }

    /// Finds what is seen on an interval that some polygons cover.
    fn interval(&mut self, open: &mut [Open<T>], columns: Range<i32>) {
        match open {
            [] => return,
            [only] => return self.see(only.polygon, columns),
            _ => {}
        }
        for open in open.iter_mut().filter(|open| open.depth.is_none()) {
            open.depth = Some(self.spread(open.polygon).line(0, open.start));
        }
        let [first, last] = [columns.start, columns.end - 1].map(|x| nearest(open, x));
        self.meter.note(|work| work.depth_tests += 2 * open.len() as u64);
        if first == last {
            return self.see(first, columns);
        }
        self.meter.note(|work| work.depth_tests += (open.len() * columns.len()) as u64);
        for x in columns {
            self.see(nearest(open, x), x..x + 1);
        }
    }

    /// Adds an interval to the run before it if it shows the same polygon.
    #[inline]
    fn see(&mut self, polygon: u32, columns: Range<i32>) {
        match &mut self.run {
            Some((before, run)) if *before == polygon && run.end == columns.start => {
                run.end = columns.end;
            }
            _ => {
                self.finish();
                self.run = Some((polygon, columns));
            }
        }
    }

    /// Paints the run.
    #[inline]
    fn finish(&mut self) {
        let Some((polygon, columns)) = self.run.take() else { return };
        self.meter.note(|work| {
            work.pixels_written += columns.len() as u64;
            work.interpolations += ((VALUES - 1) * columns.len()) as u64;
        });
        let start = columns.start;
        if VALUES > 1 {
            let spread = self.spread(polygon);
            let value = |k| spread.line(k + 1, start);
            self.paint.run(self.view, self.row, columns, polygon, value);
        } else {
            let nothing = |_| Line { first: T::of(0.0), slope: T::of(0.0) };
            self.paint.run(self.view, self.row, columns, polygon, nothing);
        }
    }

    /// A polygon's span.
    #[inline]
    fn spread(&self, polygon: u32) -> Spread<'a, T, EYES, VALUES> {
        let [left, right] = self.table.sides(polygon, self.view);
        let [cell, end] = [left, right].map(|entry| entry.edge.x[self.view].cell);
        let offset = left.edge.offset(self.view);
        let width = T::of(f64::from(end - cell)) + offset - right.edge.offset(self.view);
        Spread { left, right, cell, offset, scale: T::of(1.0) / width }
    }
}

/// A polygon's span on a row, from edge to edge.
struct Spread<'a, T, const EYES: usize, const VALUES: usize> {
    left: &'a Entry<T, EYES, VALUES>,
    right: &'a Entry<T, EYES, VALUES>,
    /// First pixel.
    cell: i32,
    /// From the left edge to its centre, in pixels.
    offset: T,
    /// One by the width.
    scale: T,
}

impl<T: Real, const EYES: usize, const VALUES: usize> Spread<'_, T, EYES, VALUES> {
    /// A value from pixel `start` on.
    #[inline]
    fn line(&self, value: usize, start: i32) -> Line<T> {
        let [left, right] = [self.left, self.right].map(|entry| entry.values[value]);
        let slope = (right - left) * self.scale;
        let away = self.offset + T::of(f64::from(start - self.cell));
        Line { first: left + slope * away, slope }
    }
}

/// The nearest of some polygons at a pixel, the first one of equals.
#[inline]
fn nearest<T: Real>(open: &[Open<T>], x: i32) -> u32 {
    let mut best: Option<(T, u32)> = None;
    for open in open {
        let Some(Line { first, slope }) = open.depth else { continue };
        let depth = first + slope * T::of(f64::from(x - open.start));
        let nearer = best.is_none_or(|(least, polygon)| {
            depth < least || (depth == least && open.polygon < polygon)
        });
        if nearer {
            best = Some((depth, open.polygon));
        }
    }
    best.map_or(u32::MAX, |(_, polygon)| polygon)
}
