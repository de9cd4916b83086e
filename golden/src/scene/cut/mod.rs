//! Polygons of any shape as triangles.
//!
//! - A convex polygon is a fan from its first corner.
//! - Any other is cut on the plane that fits it best (Newell's normal), on a grid of 2^29 steps to
//!   its longest side: the triangles are those of Delaunay, and the same whichever corner comes first.
//! - An outline that crosses or touches itself is taken apart at its crossings; what is wound
//!   round, either way, is inside, so that a hole may be reached by an edge there and back.
//! - An outline of too many crossings, a tangle, is a fan: time and memory grow with the number
//!   of corners.

mod simple;

use super::vector::{add, cross, dot, mix, outward, scale, sub, unit, Vec3};
use fastrand::Rng;
use i_triangle::int::triangulator::IntTriangulator;
use simple::Point;
use std::cmp::Ordering;
use std::collections::HashMap;

/// Steps of the grid to half the longest side: no coordinate is twice that, and products of
/// differences fit in 64 bits.
const GRID: f64 = (1 << 28) as f64;
/// Sine of the angle by which a corner may be concave and count as straight: it is rounding.
const STRAIGHT: f64 = 1e-9;
/// Size of a normal, in squares of half the longest side, that is rounding: the corners lie on a line.
const LINE: f64 = 1e-12;
/// Edges of an outline of which the crossings are counted, to estimate those of all.
const SAMPLES: usize = 200;
/// Most pairs of edges a corner that touch, and that lie in each other's bounding box, of an outline
/// that is no tangle. Every edge touches its neighbours.
const TANGLE: [usize; 2] = [5, 2_000];
/// Most crossings times corners: each is looked for on all edges.
const SEARCHES: usize = 100_000_000;

/// A polygon in triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cut {
    /// Corners of the triangles, wound as the polygon is: indices of its corners, then of `crossings`.
    pub triangles: Vec<[usize; 3]>,
    /// Points where the outline crosses itself.
    pub crossings: Vec<Crossing>,
}

/// A point on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The corners that the edge joins.
    pub edge: [usize; 2],
    /// Position of the point along the edge, 0 to 1.
    pub at: f64,
}

impl Crossing {
    /// The value at the point, if `ends` are the values at the ends of the edge.
    pub fn between<const N: usize>(&self, ends: [[f64; N]; 2]) -> [f64; N] {
        mix(ends[0], ends[1], self.at)
    }
}

/// Cuts a polygon of corners with finite coordinates; three or more make a triangle at least.
pub fn cut(corners: &[Vec3]) -> Cut {
    if corners.len() <= 3 {
        return fan(corners.len(), 0);
    }
    let first = least_rotation(corners);
    let order: Vec<usize> = (first..corners.len()).chain(0..first).collect();
    let Some(points) = flattened(order.iter().map(|&k| corners[k]).collect()) else {
        return fan(corners.len(), 0);
    };
    if is_convex(&points) {
        return fan(corners.len(), 0);
    }
    Outline::new(&points, &order).cut().unwrap_or_else(|| fan(corners.len(), first))
}

/// True if a polygon is convex, as far as its corners lie in one plane; so are those without area.
pub fn is_convex_polygon(corners: &[Vec3]) -> bool {
    corners.len() <= 3 || flattened(corners.to_vec()).is_none_or(|points| is_convex(&points))
}

/// The triangles from one corner to all edges.
fn fan(corners: usize, first: usize) -> Cut {
    let at = |k: usize| (first + k) % corners;
    let triangles = (2..corners).map(|k| [first, at(k - 1), at(k)]).collect();
    Cut { triangles, crossings: Vec::new() }
}

/// The corner from which on the corners are the least in the order of their coordinates.
fn least_rotation(corners: &[Vec3]) -> usize {
    let n = corners.len();
    let compare = |i: usize, j: usize| {
        let [a, b] = [corners[i % n], corners[j % n]];
        // + 0.0 makes one of 0 and -0.
        let mut axes = (0..3).map(|k| (a[k] + 0.0).total_cmp(&(b[k] + 0.0)));
        axes.find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
    };
    // Two candidates are compared; the greater one and all that begin in its equal part are out.
    let (mut best, mut other, mut equal) = (0, 1, 0);
    while best < n && other < n && equal < n {
        match compare(best + equal, other + equal) {
            Ordering::Equal => {
                equal += 1;
                continue;
            }
            Ordering::Greater => best += equal + 1,
            Ordering::Less => other += equal + 1,
        }
        other += usize::from(best == other);
        equal = 0;
    }
    best.min(other)
}

/// The corners on the plane that fits them best, in half the largest extent about their middle;
/// counter-clockwise is positive. None where they lie on a line.
fn flattened(mut corners: Vec<Vec3>) -> Option<Vec<[f64; 2]>> {
    let mut bounds = [[f64::MAX; 3], [f64::MIN; 3]];
    for corner in &corners {
        bounds[0] = std::array::from_fn(|k| bounds[0][k].min(corner[k]));
        bounds[1] = std::array::from_fn(|k| bounds[1][k].max(corner[k]));
    }
    let half = sub(bounds[1], bounds[0]).iter().fold(0.0, |m: f64, &n| m.max(n / 2.0));
    if half == 0.0 || !half.is_finite() {
        return None;
    }
    let middle = scale(add(bounds[0], bounds[1]), 0.5);
    corners.iter_mut().for_each(|c| *c = sub(*c, middle).map(|n| n / half));
    let normal = normal(&corners)?;
    // Any direction across the normal will do: along the axis that is the farthest from it.
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    let right = unit(cross(normal, std::array::from_fn(|k| f64::from(u8::from(k == least)))));
    let up = cross(right, normal);
    Some(corners.iter().map(|&c| [dot(c, right), dot(c, up)]).collect())
}

/// Newell's normal of corners about the origin; if the parts of the polygon cancel each other, that of
/// the largest triangle in it.
fn normal(corners: &[Vec3]) -> Option<Vec3> {
    let fan = || corners.windows(2).map(|pair| outward(corners[0], pair[0], pair[1]));
    let largest = |n: &Vec3| n.iter().fold(0.0, |m: f64, n| m.max(n.abs()));
    let sum = fan().fold([0.0; 3], add);
    let chosen = match largest(&sum) > STRAIGHT {
        true => sum,
        false => fan().max_by(|a, b| largest(a).total_cmp(&largest(b)))?,
    };
    (largest(&chosen) > LINE).then(|| unit(chosen))
}

/// Twice the area of the triangle of the origin and two points.
fn wedge(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn step(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [b[0] - a[0], b[1] - a[1]]
}

/// True if all corners turn left, and the outline goes round once.
fn is_convex(points: &[[f64; 2]]) -> bool {
    let mut points = points.to_vec();
    points.dedup();
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    let n = points.len();
    let turn = |a: [f64; 2], b: [f64; 2]| {
        let [long, broad] = [a, b].map(|v| v[0].hypot(v[1]));
        let sine = wedge(a, b) / (long * broad);
        // A corner that goes straight back is none.
        sine > STRAIGHT || (sine >= -STRAIGHT && a[0] * b[0] + a[1] * b[1] > 0.0)
    };
    let from_first = |k: usize| step(points[0], points[k]);
    let corners = (0..n).all(|k| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| points[k % n]);
        turn(step(a, b), step(b, c))
    });
    let round_once = |k: usize| {
        let [first, this, next] = [1, k, k + 1].map(from_first);
        let least = -STRAIGHT;
        wedge(this, next) >= least && wedge(first, next) >= least
    };
    n > 2 && corners && (1..n - 1).all(round_once)
}

/// A polygon's outline on the grid.
struct Outline {
    /// Neighbours differ.
    points: Vec<Point>,
    /// Which corner of the polygon each is.
    corners: Vec<usize>,
    /// Number of the polygon's corners.
    count: usize,
}

impl Outline {
    fn new(points: &[[f64; 2]], order: &[usize]) -> Outline {
        let grid = |p: &[f64; 2]| {
            let [x, y] = p.map(|n| (n * GRID).round() as i32);
            Point::new(x, y)
        };
        let mut all: Vec<(Point, usize)> =
            points.iter().zip(order).map(|(p, &corner)| (grid(p), corner)).collect();
        all.dedup_by_key(|(point, _)| *point);
        while all.len() > 1 && all[0].0 == all[all.len() - 1].0 {
            all.pop();
        }
        let (points, corners) = all.into_iter().unzip();
        Outline { points, corners, count: order.len() }
    }

    /// Its triangles; none if it is a tangle or has no area on the grid.
    fn cut(mut self) -> Option<Cut> {
        let mut triangulator = IntTriangulator::<i32, u32>::default();
        triangulator.delaunay = true;
        let found = if self.points.len() < 3 {
            return None;
        } else if simple::is_simple(&self.points) {
            if doubled_area(&self.points) < 0 {
                self.points.reverse();
                self.corners.reverse();
            }
            triangulator.uncheck_triangulate_contour(&self.points)
        } else if !self.is_tangle() {
            triangulator.triangulate_contour(&self.points)
        } else {
            return None;
        };
        if found.indices.is_empty() {
            return None;
        }
        let mut known: HashMap<[i32; 2], usize> = HashMap::new();
        for (point, &corner) in self.points.iter().zip(&self.corners) {
            known.entry([point.x, point.y]).or_insert(corner);
        }
        let mut cut = Cut::default();
        let mut indices = Vec::with_capacity(found.points.len());
        for point in &found.points {
            indices.push(*known.entry([point.x, point.y]).or_insert_with(|| {
                cut.crossings.push(self.locate(*point));
                self.count + cut.crossings.len() - 1
            }));
            if cut.crossings.len() * self.points.len() > SEARCHES {
                return None;
            }
        }
        let corner = |&n: &u32| indices[n as usize];
        cut.triangles =
            found.indices.chunks_exact(3).map(|t| [0, 1, 2].map(|k| corner(&t[k]))).collect();
        Some(cut)
    }

    fn edge(&self, k: usize) -> [Point; 2] {
        [self.points[k], self.points[(k + 1) % self.points.len()]]
    }

    /// True if so many edges cross that taking them apart would take too long; an estimate.
    fn is_tangle(&self) -> bool {
        let n = self.points.len();
        let samples = SAMPLES.min(n);
        let mut random = Rng::with_seed(n as u64);
        let mut sampled: Vec<usize> = (0..n).collect();
        random.shuffle(&mut sampled);
        let (mut touching, mut near) = (0, 0);
        for &k in &sampled[..samples] {
            let edge = self.edge(k);
            let others =
                (0..n).map(|m| self.edge(m)).filter(|other| simple::are_near(edge, *other));
            for other in others {
                near += 1;
                touching += usize::from(simple::do_touch(edge, other));
            }
        }
        // Every pair is met from both of its edges.
        let all = |count: usize| count * n / samples / 2;
        let most = |count: usize| 100 + count * n;
        all(touching) > most(TANGLE[0]).min(n + SEARCHES / n) || all(near) > most(TANGLE[1])
    }

    /// The place of a point on the edge that is the nearest to it.
    fn locate(&self, point: Point) -> Crossing {
        let float = |p: Point| [f64::from(p.x), f64::from(p.y)];
        let point = float(point);
        let on = |k: usize| {
            let [from, to] = self.edge(k).map(float);
            let along = step(from, to);
            let [x, y] = step(from, point);
            let length = along[0] * along[0] + along[1] * along[1];
            let at = ((x * along[0] + y * along[1]) / length).clamp(0.0, 1.0);
            let [x, y] = step(mix(from, to, at), point);
            (x * x + y * y, k, at)
        };
        let nearest = (0..self.points.len()).map(on).min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, k, at) = nearest.unwrap_or_default();
        Crossing { edge: [k, (k + 1) % self.corners.len()].map(|k| self.corners[k]), at }
    }
}

/// Twice the area that an outline goes round, positive if counter-clockwise.
fn doubled_area(points: &[Point]) -> i128 {
    let wide = |p: Point| [i128::from(p.x), i128::from(p.y)];
    let next = points.iter().cycle().skip(1);
    let pairs = points.iter().zip(next).map(|(&a, &b)| [wide(a), wide(b)]);
    pairs.map(|[a, b]| a[0] * b[1] - a[1] * b[0]).sum()
}

#[cfg(test)]
mod tests;
