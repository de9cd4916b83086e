//! Test of an outline for touching itself (Shamos & Hoey 1976): a line sweeps over the plane, and
//! only edges that are neighbours on it are compared.

use i_triangle::i_overlay::i_float::int::point::IntPoint;
use std::cmp::Ordering;
use std::collections::{BTreeSet, HashSet};
use std::ops::Bound::{Excluded, Unbounded};

/// A point on the grid of a polygon's plane.
pub(super) type Point = IntPoint<i32>;

/// Twice the area of a triangle, positive if counter-clockwise.
fn side(a: Point, b: Point, c: Point) -> i64 {
    let [a, b, c] = [a, b, c].map(|p| [i64::from(p.x), i64::from(p.y)]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Order in which the line sweeps over points: by x, then by y.
fn sweep(a: &Point, b: &Point) -> Ordering {
    (a.x, a.y).cmp(&(b.x, b.y))
}

/// An edge from the end that the line meets first.
#[derive(Clone, Copy)]
struct Edge {
    from: Point,
    to: Point,
    index: usize,
}

impl Ord for Edge {
    /// From the bottom to the top of the line, for edges that do not cross and are on it together.
    fn cmp(&self, other: &Edge) -> Ordering {
        if sweep(&self.from, &other.from).is_gt() {
            return other.cmp(self).reverse();
        }
        let above = |p: Point| 0.cmp(&side(self.from, self.to, p));
        above(other.from).then(above(other.to)).then(self.index.cmp(&other.index))
    }
}

impl PartialOrd for Edge {
    fn partial_cmp(&self, other: &Edge) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Eq for Edge {}

impl PartialEq for Edge {
    fn eq(&self, other: &Edge) -> bool {
        self.index == other.index
    }
}

/// True if the bounding boxes of two edges meet.
pub fn are_near(a: [Point; 2], b: [Point; 2]) -> bool {
    let apart = |of: fn(Point) -> i32| {
        let [a, b] = [a, b].map(|edge| edge.map(of));
        a[0].max(a[1]) < b[0].min(b[1]) || b[0].max(b[1]) < a[0].min(a[1])
    };
    !apart(|p| p.x) && !apart(|p| p.y)
}

/// True if two edges have a point in common.
pub fn do_touch(a: [Point; 2], b: [Point; 2]) -> bool {
    let beside = |[from, to]: [Point; 2], [p, q]: [Point; 2]| {
        side(from, to, p).signum() * side(from, to, q).signum() > 0
    };
    are_near(a, b) && !beside(a, b) && !beside(b, a)
}

/// True if two edges of an outline of `n` different points meet elsewhere than at a corner that
/// both have.
fn do_meet(a: &Edge, b: &Edge, n: usize) -> bool {
    let apart = a.index.abs_diff(b.index);
    if apart != 1 && apart != n - 1 {
        return do_touch([a.from, a.to], [b.from, b.to]);
    }
    let from_or_to = |p: Point| p == b.from || p == b.to;
    let (corner, end) = if from_or_to(a.from) { (a.from, a.to) } else { (a.to, a.from) };
    let other = if corner == b.from { b.to } else { b.from };
    // They go from the corner in one direction.
    side(corner, end, other) == 0 && sweep(&corner, &end) == sweep(&corner, &other)
}

/// True if an outline of three points or more touches itself nowhere.
pub fn is_simple(points: &[Point]) -> bool {
    let n = points.len();
    let mut places = HashSet::with_capacity(n);
    if !points.iter().all(|p| places.insert((p.x, p.y))) {
        return false;
    }
    let edge = |index: usize| {
        let [a, b] = [points[index], points[(index + 1) % n]];
        let (from, to) = if sweep(&a, &b).is_lt() { (a, b) } else { (b, a) };
        Edge { from, to, index }
    };
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_unstable_by(|&a, &b| sweep(&points[a], &points[b]));
    let mut line: BTreeSet<Edge> = BTreeSet::new();
    for corner in order {
        let edges = [edge(corner), edge((corner + n - 1) % n)];
        for ending in edges.iter().filter(|edge| edge.to == points[corner]) {
            let below = line.range(..ending).next_back();
            let above = line.range((Excluded(ending), Unbounded)).next();
            if below.zip(above).is_some_and(|(a, b)| do_meet(a, b, n)) {
                return false;
            }
            line.remove(ending);
        }
        for beginning in edges.into_iter().filter(|edge| edge.from == points[corner]) {
            let below = line.range(..&beginning).next_back();
            let above = line.range(&beginning..).next();
            if [below, above].into_iter().flatten().any(|edge| do_meet(edge, &beginning, n)) {
                return false;
            }
            line.insert(beginning);
        }
    }
    true
}
