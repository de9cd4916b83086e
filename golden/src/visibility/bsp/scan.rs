//! Rows of one polygon, in one view or in two that share them.

use crate::formats::{Eye, Formats};
use crate::setup::Polygon;
use crate::visibility::edge::Edge;
use std::ops::Range;

/// Follows convex polygons from row to row.
pub(super) struct Scan<const EYES: usize> {
    /// Edges of the polygon, sorted by the first row. Two of them cross each row; when one ends,
    /// the next one takes its place.
    edges: Vec<Edge<EYES>>,
}

impl<const EYES: usize> Scan<EYES> {
    pub fn new() -> Self {
        Scan { edges: Vec::new() }
    }

    /// Takes up the edges of a polygon that cross any of these rows.
    #[inline]
    fn begin(
        &mut self,
        polygon: &Polygon,
        eyes: [Eye; EYES],
        rows: &Range<i32>,
        formats: &Formats,
    ) {
        self.edges.clear();
        let mut from = &polygon.vertices[polygon.vertices.len() - 1];
        for to in &polygon.vertices {
            let [y, next] = [from, to].map(|v| v.y[eyes[0] as usize]);
            let (upper, lower) = if y <= next { (from, to) } else { (to, from) };
            from = to;
            let made = Edge::new::<f64>(upper, lower, eyes, rows.start, formats);
            if let Some((edge, _)) = made {
                self.edges.push(edge);
            }
        }
        for n in 1..self.edges.len() {
            let mut k = n;
            while k > 0 && self.edges[k - 1].first > self.edges[k].first {
                self.edges.swap(k - 1, k);
                k -= 1;
            }
        }
    }

    /// Calls `pixels` for each of the rows that a polygon crosses, with the first pixel of its
    /// span and the one past the last in each view. Returns how many they are.
    #[inline]
    pub fn rows(
        &mut self,
        polygon: &Polygon,
        eyes: [Eye; EYES],
        rows: &Range<i32>,
        formats: &Formats,
        mut pixels: impl FnMut(i32, [[i32; 2]; EYES]),
    ) -> usize {
        self.begin(polygon, eyes, rows, formats);
        let [Some(mut a), Some(mut b)] = [0, 1].map(|n| self.edges.get(n).copied()) else {
            return 0;
        };
        let mut rest = self.edges[2..].iter();
        let mut row = a.first;
        let first = row;
        loop {
            let until = a.end.min(b.end).min(rows.end);
            for row in row..until {
                let spans = std::array::from_fn(|view| {
                    let [a, b] = [a.cell(view), b.cell(view)];
                    [a.min(b), a.max(b)]
                });
                pixels(row, spans);
                a.step();
                b.step();
            }
            row = until;
            if row == rows.end {
                return (row - first) as usize;
            }
            for side in [&mut a, &mut b] {
                if side.end == row {
                    match rest.next() {
                        Some(next) => *side = *next,
                        None => return (row - first) as usize,
                    }
                }
            }
        }
    }
}
