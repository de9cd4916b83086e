//! Rows of one polygon, in one view or in two at once.

use crate::formats::{Eye, Formats};
use crate::setup::{Polygon, MAX_VERTICES};
use crate::visibility::edge::Edge;
use std::ops::Range;

/// A convex polygon followed from row to row.
pub(in crate::visibility) struct Scan<const EYES: usize> {
    /// Sorted by the first row. Two cross each row; when one ends, the next takes its place.
    edges: [Edge<f64, EYES>; MAX_VERTICES],
    count: usize,
    next: usize,
    pair: [usize; 2],
    row: i32,
    end: i32,
}

impl<const EYES: usize> Scan<EYES> {
    /// The polygon from the first of these rows on.
    pub fn new(polygon: &Polygon, eyes: [Eye; EYES], rows: &Range<i32>, formats: &Formats) -> Self {
        let mut edges = [Edge::NONE; MAX_VERTICES];
        let mut count = 0;
        let mut end = i32::MIN;
        let mut from = &polygon.vertices[polygon.vertices.len() - 1];
        for to in &polygon.vertices {
            let (upper, lower) = if from.y[0] <= to.y[0] { (from, to) } else { (to, from) };
            from = to;
            let Some((edge, _)) = Edge::new(upper, lower, eyes, rows.start, formats) else {
                continue;
            };
            let mut k = count;
            while k > 0 && edges[k - 1].first > edge.first {
                edges[k] = edges[k - 1];
                k -= 1;
            }
            edges[k] = edge;
            count += 1;
            end = end.max(edge.end);
        }
        let row = edges[0].first;
        Scan { edges, count, next: 2, pair: [0, 1], row, end: end.min(rows.end) }
    }

    /// Calls `pixels` for each row with the first pixel of the span and the one past its last in
    /// each view.
    #[inline]
    pub fn rows(mut self, mut pixels: impl FnMut(i32, [[i32; 2]; EYES])) {
        while self.row < self.end {
            let [a, b] = self.pair;
            let until = self.edges[a].end.min(self.edges[b].end).min(self.end);
            if until <= self.row {
                // Not convex.
                return;
            }
            for row in self.row..until {
                pixels(
                    row,
                    std::array::from_fn(|view| {
                        let [a, b] = [a, b].map(|k| self.edges[k].x[view].cell);
                        [a.min(b), a.max(b)]
                    }),
                );
                self.edges[a].step();
                self.edges[b].step();
            }
            self.row = until;
            for side in &mut self.pair {
                if self.edges[*side].end <= until && self.next < self.count {
                    *side = self.next;
                    self.next += 1;
                }
            }
        }
    }
}
