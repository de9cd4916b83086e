//! Clipping of lines and polygons: both views together against each alone, bit for bit, and against
//! exact arithmetic.

use fastrand::Rng;
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};
use wheatstone_golden::clipping::{lines, near, polygons, Point, Window};
use wheatstone_golden::work::{Real, Unmetered, Work};

/// An exact fraction, or plus or minus infinity; the denominator is not negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Exact(i128, i128);

impl Exact {
    fn new(n: i128, d: i128) -> Exact {
        let (mut a, mut b) = (n.abs(), d.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let divisor = a.max(1) * d.signum();
        assert!(divisor != 0, "{n}/{d}");
        Exact(n / divisor, d / divisor)
    }

    fn whole(n: i64) -> Exact {
        Exact(n.into(), 1)
    }
}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Exact) -> Option<Ordering> {
        if self.1 == 0 && other.1 == 0 {
            return self.0.partial_cmp(&other.0);
        }
        (self.0 * other.1).partial_cmp(&(other.0 * self.1))
    }
}

impl Add for Exact {
    type Output = Exact;
    fn add(self, o: Exact) -> Exact {
        Exact::new(self.0 * o.1 + o.0 * self.1, self.1 * o.1)
    }
}

impl Neg for Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact(-self.0, self.1)
    }
}

impl Sub for Exact {
    type Output = Exact;
    fn sub(self, o: Exact) -> Exact {
        self + -o
    }
}

impl Mul for Exact {
    type Output = Exact;
    fn mul(self, o: Exact) -> Exact {
        Exact::new(self.0 * o.0, self.1 * o.1)
    }
}

impl Div for Exact {
    type Output = Exact;
    fn div(self, o: Exact) -> Exact {
        Exact::new(self.0 * o.1, self.1 * o.0)
    }
}

impl AddAssign for Exact {
    fn add_assign(&mut self, o: Exact) {
        *self = *self + o;
    }
}

impl Real for Exact {
    fn of(value: f64) -> Exact {
        if value.is_infinite() {
            return Exact(value.signum() as i128, 0);
        }
        assert!(value == value.trunc());
        Exact(value as i128, 1)
    }
    fn value(self) -> f64 {
        self.0 as f64 / self.1 as f64
    }
}

const WINDOW: Window<i64> = Window { x: [0, 8], y: [0, 6] };

fn window<T>(of: impl Fn(i64) -> T) -> Window<T> {
    Window { x: WINDOW.x.map(&of), y: WINDOW.y.map(&of) }
}

/// A point on a grid about the window: borders, corners and parallels are met often.
fn grid_point(random: &mut Rng) -> Point<i64, 2> {
    let x = random.i64(-4..=12);
    Point { x: [x, x + random.i64(-3..=3).clamp(-4 - x, 12 - x)], y: random.i64(-4..=10) }
}

fn point_of<T: Copy, const N: usize>(point: &Point<i64, N>, of: impl Fn(i64) -> T) -> Point<T, N> {
    Point { x: point.x.map(&of), y: of(point.y) }
}

fn real(n: i64) -> f64 {
    n as f64
}

/// A point anywhere about a window, or on a grid.
fn any_point(random: &mut Rng, on_grid: bool) -> Point<f64, 2> {
    if on_grid {
        return point_of(&grid_point(random), real);
    }
    let x = random.f64() * 20.0 - 6.0;
    Point { x: [x, x + random.f64() * 3.0 - 1.5], y: random.f64() * 18.0 - 6.0 }
}

fn bits<const N: usize>(points: &[[f64; N]]) -> Vec<[u64; N]> {
    points.iter().map(|point| point.map(f64::to_bits)).collect()
}

#[test]
fn a_million_lines_are_clipped_together_as_alone() {
    let mut random = Rng::with_seed(1);
    let window = window(real);
    let (mut seen, mut differing) = (0, 0);
    let [mut together, mut alone] = [Work::default(); 2];
    for n in 0..1_000_000 {
        let line = [(); 2].map(|()| any_point(&mut random, n % 2 == 0));
        let both = lines::clip(&line, &window, &mut together);
        for view in 0..2 {
            let [single] = lines::clip(&line.map(|p| p.view(view)), &window, &mut alone);
            let same = both[view].map(|l| bits(&l)) == single.map(|l| bits(&l));
            assert!(same, "{line:?} {view}: {both:?} {single:?}");
            seen += u32::from(single.is_some());
        }
        differing += u32::from(both[0].is_some() != both[1].is_some());
    }
    assert!(seen > 600_000 && differing > 50_000, "{seen} {differing}");
    let saving = 1.0 - together.boundary_clips as f64 / alone.boundary_clips as f64;
    println!("{:.1} % fewer clips", 100.0 * saving);
    assert!(saving > 0.25);
}

/// The part of a line within the closed window: from the first to the last of those of its ends and
/// crossings of the borders that are inside.
fn reference_line(from: [i64; 2], to: [i64; 2]) -> Option<[[Exact; 2]; 2]> {
    let (from, to) = (from.map(Exact::whole), to.map(Exact::whole));
    let borders = [WINDOW.x, WINDOW.y].map(|range| range.map(Exact::whole));
    let mut parameters = vec![Exact(0, 1), Exact(1, 1)];
    for axis in [0, 1] {
        if from[axis] != to[axis] {
            let crossing = |border| (border - from[axis]) / (to[axis] - from[axis]);
            parameters.extend(borders[axis].map(crossing));
        }
    }
    let at = |t: Exact| [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]));
    let inside = |t: &Exact| {
        let point = at(*t);
        let within =
            |axis: usize| borders[axis][0] <= point[axis] && point[axis] <= borders[axis][1];
        Exact(0, 1) <= *t && *t <= Exact(1, 1) && within(0) && within(1)
    };
    parameters.retain(inside);
    parameters.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    Some([at(*parameters.first()?), at(*parameters.last()?)])
}

fn near_to(rounded: [f64; 2], exact: [Exact; 2]) -> bool {
    (0..2).all(|axis| (rounded[axis] - exact[axis].value()).abs() < 1e-12)
}

#[test]
fn lines_are_what_exact_arithmetic_leaves() {
    let mut random = Rng::with_seed(2);
    let (mut points, mut whole) = (0, 0);
    for _ in 0..200_000 {
        let line = [(); 2].map(|()| grid_point(&mut random));
        let exact_line = line.map(|p| point_of(&p, Exact::whole));
        let exact = lines::clip(&exact_line, &window(Exact::whole), &mut Unmetered);
        let rounded = lines::clip(&line.map(|p| point_of(&p, real)), &window(real), &mut Unmetered);
        for view in 0..2 {
            let [from, to] = line.map(|p| [p.x[view], p.y]);
            let reference = reference_line(from, to);
            assert_eq!(exact[view], reference, "{line:?}");
            assert_eq!(rounded[view].is_some(), reference.is_some(), "{line:?}");
            let Some(reference) = reference else { continue };
            let rounded = rounded[view].expect("as the reference");
            assert!((0..2).all(|k| near_to(rounded[k], reference[k])), "{line:?} {rounded:?}");
            points += u32::from(reference[0] == reference[1]);
            whole += u32::from(reference == [from, to].map(|p| p.map(Exact::whole)));
        }
    }
    // Corners that are just touched, and lines that are left alone.
    assert!(points > 5_000 && whole > 20_000, "{points} {whole}");
}

#[test]
fn eight_boundary_clips_become_six() {
    let line = [Point { x: [1.0, 2.0], y: 1.0 }, Point { x: [6.0, 5.0], y: 4.0 }];
    let mut together = Work::default();
    lines::clip(&line, &window(real), &mut together);
    let mut alone = Work::default();
    for view in 0..2 {
        lines::clip(&line.map(|p| p.view(view)), &window(real), &mut alone);
    }
    assert_eq!((alone.boundary_clips, together.boundary_clips), (8, 6));
    // Above the window one clip settles it for both views.
    let above = line.map(|p| Point { y: p.y - 9.0, ..p });
    let mut together = Work::default();
    assert_eq!(lines::clip(&above, &window(real), &mut together), [None; 2]);
    assert_eq!(together.boundary_clips, 1);
}

/// A polygon of 3 to 12 corners, often touching itself.
fn polygon<P>(random: &mut Rng, point: impl Fn(&mut Rng) -> P) -> Vec<P> {
    (0..random.usize(3..=12)).map(|_| point(random)).collect()
}

fn alone<T: Real>(polygon: &[Point<T, 2>], window: &Window<T>, view: usize) -> Vec<[T; 2]> {
    let polygon: Vec<_> = polygon.iter().map(|p| p.view(view)).collect();
    let mut clipped = [Vec::new()];
    polygons::clip(&polygon, window, &mut Unmetered, &mut clipped);
    let [clipped] = clipped;
    clipped
}

#[test]
fn a_million_polygons_are_clipped_together_as_alone() {
    let mut random = Rng::with_seed(3);
    let window = window(real);
    let mut corners = [0, 0];
    for n in 0..1_000_000 {
        let polygon = polygon(&mut random, |random| any_point(random, n % 2 == 0));
        let mut both = [Vec::new(), Vec::new()];
        polygons::clip(&polygon, &window, &mut Unmetered, &mut both);
        for (view, outline) in both.iter().enumerate() {
            let single = alone(&polygon, &window, view);
            assert_eq!(bits(outline), bits(&single), "{polygon:?} {view}");
            corners[usize::from(single.len() > polygon.len())] += 1;
        }
    }
    assert!(corners.iter().all(|&n| n > 100_000), "{corners:?}");
}

/// Twice the signed area.
fn area(points: &[[Exact; 2]]) -> Exact {
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    pairs.fold(Exact(0, 1), |sum, (p, q)| sum + p[0] * q[1] - q[0] * p[1])
}

/// The polygon cut by one border after another (Sutherland and Hodgman).
fn reference_polygon(mut points: Vec<[Exact; 2]>) -> Vec<[Exact; 2]> {
    let borders = [(0, WINDOW.x), (1, WINDOW.y)];
    for (axis, [low, high]) in borders {
        for (border, sign) in [(low, 1), (high, -1)] {
            let inside = |p: &[Exact; 2]| Exact(sign, 1) * (p[axis] - Exact::whole(border));
            let mut kept = Vec::new();
            for (k, to) in points.iter().enumerate() {
                let from = points[(k + points.len() - 1) % points.len()];
                let [a, b] = [inside(&from), inside(to)];
                let zero = Exact(0, 1);
                if (a < zero) != (b < zero) {
                    let t = a / (a - b);
                    kept.push([0, 1].map(|n| from[n] + t * (to[n] - from[n])));
                }
                if b >= zero {
                    kept.push(*to);
                }
            }
            points = kept;
        }
    }
    points
}

/// Winding number of the outline about a point that lies on none of its edges.
fn winding(points: &[[Exact; 2]], [x, y]: [Exact; 2]) -> i32 {
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    let crossings = pairs.map(|(p, q)| {
        let direction = i32::from(p[1] <= y) - i32::from(q[1] <= y);
        let right = direction != 0 && p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) > x;
        direction * i32::from(right)
    });
    crossings.sum()
}

#[test]
fn polygons_wind_round_every_point_as_before() {
    let mut random = Rng::with_seed(4);
    let exact_window = window(Exact::whole);
    let mut around = [0; 2];
    for _ in 0..20_000 {
        let polygon = polygon(&mut random, grid_point);
        let exact: Vec<_> = polygon.iter().map(|p| point_of(p, Exact::whole)).collect();
        let rounded: Vec<_> = polygon.iter().map(|p| point_of(p, real)).collect();
        let mut clipped = [Vec::new(), Vec::new()];
        polygons::clip(&exact, &exact_window, &mut Unmetered, &mut clipped);
        for (view, clipped) in clipped.iter().enumerate() {
            let points: Vec<_> = exact.iter().map(|p| [p.x[view], p.y]).collect();
            let inside = |p: &[Exact; 2]| {
                let [x, y] = [exact_window.x, exact_window.y];
                x[0] <= p[0] && p[0] <= x[1] && y[0] <= p[1] && p[1] <= y[1]
            };
            assert!(clipped.iter().all(inside), "{points:?}: {clipped:?}");
            assert_eq!(area(clipped), area(&reference_polygon(points.clone())), "{points:?}");
            for _ in 0..8 {
                // Off every edge: slopes have no such denominators.
                let at = |n: i64, prime| Exact::whole(n) + Exact(1, prime);
                let place = [at(random.i64(0..8), 101), at(random.i64(0..6), 10_007)];
                let wanted = winding(&points, place);
                assert_eq!(winding(clipped, place), wanted, "{points:?} round {place:?}");
                around[usize::from(wanted != 0)] += 1;
            }
            let rounded = alone(&rounded, &window(real), view);
            assert_eq!(rounded.len(), clipped.len(), "{points:?}");
            assert!(rounded.iter().zip(clipped).all(|(r, e)| near_to(*r, *e)), "{points:?}");
        }
    }
    assert!(around.iter().all(|&n| n > 50_000), "{around:?}");
}

#[test]
fn a_window_inside_a_polygon_is_kept_whole_and_one_outside_has_no_area() {
    let square = |low: i64, high: i64| {
        let corner = |x, y| Point { x: [x, x + 1], y };
        let corners = [corner(low, low), corner(high, low), corner(high, high), corner(low, high)];
        corners.map(|p| point_of(&p, Exact::whole))
    };
    for (square, wanted) in [(square(-9, 30), 2 * 48), (square(9, 30), 0), (square(-30, -4), 0)] {
        let mut clipped = [Vec::new(), Vec::new()];
        polygons::clip(&square, &window(Exact::whole), &mut Unmetered, &mut clipped);
        assert_eq!(clipped.map(|outline| area(&outline)), [Exact::whole(wanted); 2]);
    }
}

#[test]
fn edges_within_the_window_take_six_intersections_instead_of_eight() {
    let corners = [[1.0, 1.0], [7.0, 2.0], [5.0, 5.0], [2.0, 4.0], [1.0, 3.0]];
    let polygon = corners.map(|[x, y]| Point { x: [x, x + 0.5], y });
    let (mut together, mut single) = (Work::default(), Work::default());
    polygons::clip(&polygon, &window(real), &mut together, &mut [Vec::new(), Vec::new()]);
    for view in 0..2 {
        let polygon = polygon.map(|p| p.view(view));
        polygons::clip(&polygon, &window(real), &mut single, &mut [Vec::new()]);
    }
    assert_eq!((single.boundary_clips, together.boundary_clips), (5 * 8, 5 * 6));
}

#[test]
fn the_near_plane_cuts_exactly() {
    let mut random = Rng::with_seed(5);
    let near_plane = Exact::whole(2);
    let [mut cut, mut gone] = [0; 2];
    for _ in 0..50_000 {
        let points = [(); 2].map(|()| [(); 3].map(|()| Exact::whole(random.i64(-5..9))));
        let line = near::clip_line(points, near_plane, &mut Unmetered);
        // Exactly the points of the line that are not before the plane: ends, and the crossing.
        let behind = points.map(|p| p[2] >= near_plane);
        let Some(line) = line else {
            assert_eq!(behind, [false, false]);
            gone += 1;
            continue;
        };
        for k in 0..2 {
            let [a, b] = [points[k], points[1 - k]];
            if behind[k] {
                assert_eq!(line[k], a);
                continue;
            }
            cut += 1;
            let t = (near_plane - a[2]) / (b[2] - a[2]);
            assert_eq!(line[k], [0, 1, 2].map(|n| a[n] + t * (b[n] - a[n])), "{points:?}");
            assert_eq!(line[k][2], near_plane);
        }
        // A triangle with the line as its first edge keeps what the line keeps.
        let tip = [Exact::whole(1), Exact::whole(3), Exact::whole(9)];
        let mut work = Work::default();
        let kept = near::clip_polygon(&[points[0], points[1], tip], near_plane, &mut work);
        assert!(line.iter().all(|p| kept.contains(p)), "{points:?} {kept:?}");
        assert!(kept.iter().all(|p| p[2] >= near_plane));
        assert_eq!(work.boundary_clips, 3);
    }
    assert!(cut > 10_000 && gone > 5_000, "{cut} {gone}");
}
