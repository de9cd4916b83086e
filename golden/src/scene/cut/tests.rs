use super::*;
use crate::scene::vector::rotate;
use std::collections::BTreeSet;

type Flat = [f64; 2];

/// A polygon put somewhere in space, its front to the viewer before.
fn placed(polygon: &[Flat], random: &mut Rng) -> Vec<Vec3> {
    let turn = [(); 3].map(|()| random.f64() * 360.0);
    let size = 10f64.powi(random.i32(-6..=6));
    let at = [(); 3].map(|()| (random.f64() - 0.5) * size * 10.0);
    let turned = |p: &Flat| (0..3).fold([p[0], p[1], 0.0], |p, axis| rotate(p, axis, turn[axis]));
    polygon.iter().map(|p| add(scale(turned(p), size), at)).collect()
}

fn area(polygon: &[Flat]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| wedge(*a, *b)).sum::<f64>() / 2.0
}

/// Winding number of a polygon about a point, positive counter-clockwise.
fn winding(polygon: &[Flat], p: Flat) -> i32 {
    let next = polygon.iter().cycle().skip(1);
    let crossings = polygon.iter().zip(next).map(|(&a, &b)| {
        let left = wedge(step(a, b), step(a, p)) > 0.0;
        match (a[1] <= p[1], b[1] <= p[1]) {
            (true, false) if left => 1,
            (false, true) if !left => -1,
            _ => 0,
        }
    });
    crossings.sum()
}

/// Corners of the triangles, and their areas, which are not negative.
fn triangles(polygon: &[Flat], cut: &Cut) -> Vec<[Flat; 3]> {
    let place = |n: usize| match polygon.get(n) {
        Some(&corner) => corner,
        None => {
            let crossing = cut.crossings[n - polygon.len()];
            crossing.between(crossing.edge.map(|k| polygon[k]))
        }
    };
    cut.triangles.iter().map(|t| t.map(place)).collect()
}

/// Checks a cut against the polygon's winding number at random points, and returns its area.
fn check(polygon: &[Flat], cut: &Cut, random: &mut Rng, what: &str) -> f64 {
    let parts = triangles(polygon, cut);
    let areas: Vec<f64> = parts.iter().map(|t| area(t)).collect();
    let size = polygon.iter().flatten().fold(0.0, |m: f64, n| m.max(n.abs()));
    assert!(areas.iter().all(|&a| a >= -1e-7 * size * size), "{what}: {areas:?}");
    for _ in 0..100 {
        let p = [(); 2].map(|()| (random.f64() * 2.2 - 1.1) * size);
        let covered = parts.iter().filter(|t| winding(&t[..], p) != 0).count();
        // The grid moves edges a little.
        let near = |t: &[Flat; 3]| {
            (0..3).any(|k| {
                let [a, b] = [t[k], t[(k + 1) % 3]];
                let along = step(a, b);
                let length = along[0].hypot(along[1]);
                wedge(along, step(a, p)).abs() <= 1e-6 * size * length
            })
        };
        if !parts.iter().any(near) {
            assert_eq!(covered, usize::from(winding(polygon, p) != 0), "{what} at {p:?}");
        }
    }
    areas.iter().sum()
}

/// The corners of each triangle, from the least one on.
fn set(cut: &Cut, corners: usize, first: usize) -> BTreeSet<[usize; 3]> {
    let original = |k: usize| if k < corners { (k + first) % corners } else { k };
    let sorted = |t: &[usize; 3]| {
        let mut t = t.map(original);
        let least = (0..3).min_by_key(|&k| t[k]).unwrap_or_default();
        t.rotate_left(least);
        t
    };
    cut.triangles.iter().map(sorted).collect()
}

/// A polygon round the origin whose corners are at random distances.
fn star(corners: usize, random: &mut Rng) -> Vec<Flat> {
    let corner = |k: usize| {
        let angle = (k as f64 + 0.9 * random.f64()) / corners as f64 * std::f64::consts::TAU;
        let far = 0.05 + 0.95 * random.f64();
        [far * angle.cos(), far * angle.sin()]
    };
    (0..corners).map(corner).collect()
}

/// The outline of random columns: many corners on lines and at equal heights.
fn skyline(columns: usize, random: &mut Rng) -> Vec<Flat> {
    let mut outline = vec![[columns as f64, 0.0], [0.0, 0.0]];
    outline.swap(0, 1);
    for k in (0..columns).rev() {
        let height = f64::from(random.u8(1..=3));
        outline.extend([1, 0].map(|n| [(k + n) as f64, height]));
    }
    outline
}

/// A long way in, and beside it the way back.
fn spiral(corners: usize) -> Vec<Flat> {
    let arm = |k: usize, width: f64| {
        let angle = k as f64 / 7.0;
        let far = angle + 1.0 + width;
        [far * angle.cos(), far * angle.sin()]
    };
    let half = corners / 2;
    // From outside in on the inner side, and out again on the outer one.
    let inner = (0..half).rev().map(|k| arm(k, 0.0)).collect::<Vec<_>>();
    inner.into_iter().chain((0..half).map(|k| arm(k, 3.0))).rev().collect()
}

#[test]
fn simple_polygons_are_covered_once_and_the_same_from_every_corner() {
    let mut random = Rng::with_seed(1);
    for case in 0..400 {
        let polygon = match case % 3 {
            0 => star(4 + case / 10, &mut random),
            1 => skyline(1 + case / 20, &mut random),
            _ => {
                let mut outline = spiral(8 + case / 4);
                if area(&outline) < 0.0 {
                    outline.reverse();
                }
                outline
            }
        };
        let corners = placed(&polygon, &mut random);
        let whole = cut(&corners);
        let what = format!("case {case}, {} corners", polygon.len());
        assert!(whole.crossings.is_empty(), "{what}");
        let covered = check(&polygon, &whole, &mut random, &what);
        assert!((covered / area(&polygon) - 1.0).abs() < 1e-6, "{what}: {covered}");
        // Equal heights of a skyline are repeated corners.
        let triangles = whole.triangles.len();
        assert!(triangles == polygon.len() - 2 || case % 3 == 1, "{what}: {triangles}");
        if is_convex_polygon(&corners) {
            continue;
        }
        for first in [1, polygon.len() / 2, polygon.len() - 1] {
            let mut turned = corners.clone();
            turned.rotate_left(first);
            let n = polygon.len();
            assert_eq!(set(&cut(&turned), n, first), set(&whole, n, 0), "{what} from {first}");
        }
    }
}

#[test]
fn convex_polygons_are_fans_from_their_first_corner() {
    let mut random = Rng::with_seed(2);
    for corners in 3..60 {
        // On a circle, with corners in the middle of edges.
        let angle = |k: usize| k as f64 / corners as f64 * std::f64::consts::TAU;
        let round: Vec<Flat> = (0..corners).map(|k| [angle(k).cos(), angle(k).sin()]).collect();
        let middles = round.iter().zip(round.iter().cycle().skip(1));
        let straight: Vec<Flat> = middles.flat_map(|(a, b)| [*a, mix(*a, *b, 0.5)]).collect();
        for polygon in [round, straight] {
            let placed = placed(&polygon, &mut random);
            assert!(is_convex_polygon(&placed));
            assert_eq!(cut(&placed), fan(polygon.len(), 0));
            assert_eq!(cut(&placed).triangles[0], [0, 1, 2]);
        }
    }
    // A pentagram turns left everywhere too, but goes round twice.
    let pentagram: Vec<Flat> = (0..5)
        .map(|k| f64::from(2 * k) / 5.0 * std::f64::consts::TAU)
        .map(|angle| [angle.cos(), angle.sin()])
        .collect();
    let corners = placed(&pentagram, &mut random);
    assert!(!is_convex_polygon(&corners));
    let parts = cut(&corners);
    assert_eq!(parts.crossings.len(), 5);
    check(&pentagram, &parts, &mut random, "pentagram");
}

#[test]
fn outlines_that_cross_themselves_cover_what_they_go_round() {
    let mut random = Rng::with_seed(3);
    for case in 0..300 {
        let corners = 4 + case / 25;
        let polygon: Vec<Flat> = match case % 2 {
            0 => (0..corners).map(|_| [(); 2].map(|()| random.f64() * 2.0 - 1.0)).collect(),
            // Repeated corners, edges there and back, corners on edges.
            _ => (0..corners).map(|_| [(); 2].map(|()| f64::from(random.i8(-2..=2)))).collect(),
        };
        // Space would choose the other front where the parts of the area are nearly equal.
        let corners: Vec<Vec3> = polygon.iter().map(|p| [p[0], p[1], 0.0]).collect();
        let parts = cut(&corners);
        let front = area(&polygon);
        if front.abs() > 1e-3 && !is_convex_polygon(&corners) {
            let flipped: Vec<Flat> =
                polygon.iter().map(|p| [p[0] * front.signum(), p[1]]).collect();
            check(&flipped, &parts, &mut random, &format!("case {case}: {polygon:?}"));
        }
    }
}

#[test]
fn a_hole_is_reached_by_an_edge_there_and_back() {
    let square = |half: f64| [[-half, -half], [half, -half], [half, half], [-half, half]];
    let mut outline = square(2.0).to_vec();
    outline.push(outline[0]);
    let [a, b, c, d] = square(1.0);
    outline.extend([a, d, c, b, a]);
    let mut random = Rng::with_seed(4);
    let parts = cut(&placed(&outline, &mut random));
    assert!(parts.crossings.is_empty());
    assert!((check(&outline, &parts, &mut random, "hole") - 12.0).abs() < 1e-6);
}

#[test]
fn whatever_has_no_area_is_cut_all_the_same() {
    let line = |n: usize| -> Vec<Vec3> { (0..n).map(|k| [(k * 7 % n) as f64; 3]).collect() };
    let mut flat = vec![[1.0, 2.0, 3.0]; 1000];
    flat.extend(line(1000));
    for corners in [vec![[1e-300; 3]; 9], line(4), line(50_000), flat] {
        let parts = cut(&corners);
        assert!(parts.triangles.iter().flatten().all(|&k| k < corners.len()));
    }
    for corners in 0..4 {
        assert_eq!(cut(&vec![[0.0; 3]; corners]).triangles.len(), usize::from(corners == 3));
    }
}

#[test]
fn a_hundred_thousand_corners_take_no_longer_than_their_number_says() {
    let mut random = Rng::with_seed(5);
    let count = 100_000;
    let space = |polygon: Vec<Flat>| polygon.iter().map(|p| [p[0], p[1], 0.0]).collect::<Vec<_>>();
    assert_eq!(cut(&space(star(count, &mut random))).triangles.len(), count - 2);
    // Every pair of edges in each other's box.
    let teeth = (0..count / 2).flat_map(|k| {
        let at = 2.0 * k as f64 / count as f64;
        [[at, -at], [at + 1.0, 1.0 - at]]
    });
    let comb =
        placed(&teeth.chain([[1.0, -1.0 - 1e-3], [0.0, -1e-3]]).collect::<Vec<_>>(), &mut random);
    cut(&comb);
    let tangle = space((0..count).map(|_| [(); 2].map(|()| random.f64())).collect());
    let parts = cut(&tangle);
    let least = least_rotation(&tangle);
    assert!(parts.triangles.iter().all(|t| t[0] == least));
    let mut turned = tangle;
    turned.rotate_left(12_345);
    assert_eq!(set(&cut(&turned), count, 12_345), set(&parts, count, 0));
}
