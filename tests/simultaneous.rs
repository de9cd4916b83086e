//! Projection and scan conversion of both views together against each alone, bit for bit; coverage
//! against direct rendering; the work that is saved.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::direct;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::scene::{Camera, Rig};
use wheatstone_golden::setup::{Outline, Polygon, Vertex};
use wheatstone_golden::simultaneous::projection::Projector;
use wheatstone_golden::simultaneous::{flat, gouraud, Corner, Edges};
use wheatstone_golden::work::{counted, Counted, Real, Unmetered, Work};

const SIZE: [u32; 2] = [48, 40];
const BITS: u32 = 8;

#[test]
fn both_projections_are_those_of_each_eye_and_of_the_scenes() {
    let rig = Rig { pixels_per_unit: 1.0, ..Rig::default() };
    let camera = Camera::new(&rig, 0, 0, &Formats::new(&Config::DEFAULT));
    let projector = Projector::new(rig.eye_separation, rig.viewing_distance);
    let mut random = Rng::with_seed(1);
    for _ in 0..1_000_000 {
        let point = [40.0, 40.0, 110.0].map(|reach| (random.f64() - 0.5) * reach);
        let both = projector.both(point);
        for eye in Eye::BOTH {
            let one = projector.one(point, eye);
            let seen = both.view(eye as usize);
            assert_eq!([one.x[0], one.y].map(f64::to_bits), [seen.x[0], seen.y].map(f64::to_bits));
            // Pixels go downward.
            let [x, y] = camera.pixel(point, eye);
            assert!((x - one.x[0]).abs() + (y + one.y).abs() < 1e-9, "{point:?}");
        }
    }
}

#[test]
fn twelve_operations_become_eight() {
    let projector = Projector::<Counted>::new(6.5, 60.0);
    let point = [1.0, 2.0, 3.0].map(Counted::of);
    let (_, separately) = counted(|| Eye::BOTH.map(|eye| projector.one(point, eye)));
    let (_, together) = counted(|| projector.both(point));
    // Divisions are multiplications to the publication.
    let kinds = |o: wheatstone_golden::work::Operations| {
        (o.additions, o.multiplications + o.divisions, o.comparisons)
    };
    assert_eq!((kinds(separately), kinds(together)), ((4, 8, 0), (3, 5, 0)));
}

/// Shapes of polygons that go wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// Corners round an ellipse: flat, tall, wide, down to less than a pixel.
    Convex,
    /// Corners round an ellipse at changing distances.
    Star,
    /// Corners anywhere, sides crossing each other.
    Tangle,
}

/// A polygon of 3 to 32 sides somewhere about the window, some of them far larger.
fn polygon<const VALUES: usize>(random: &mut Rng, shape: Shape) -> Vec<Corner<2, VALUES>> {
    let sides = random.usize(3..=32);
    let reach =
        [(); 2].map(|()| [0.3, 2.0, 10.0, 40.0, 5e5][random.usize(..5)] * (0.5 + random.f64()));
    let centre = SIZE.map(|size| f64::from(size) * (1.4 * random.f64() - 0.2));
    let [scale, shear] = [random.f64() * 1.2 - 0.2, random.f64() * 2.0 - 1.0];
    // Every other polygon has its corners on pixel centres and borders.
    let grid = [1, 1 << (BITS - 1)][random.usize(..2)];
    let snap = |n: f64| (n * f64::from(1 << BITS) / f64::from(grid)).round() as i32 * grid;
    let corner = |k: usize, random: &mut Rng| {
        let angle = k as f64 / sides as f64 * core::f64::consts::TAU;
        let [dx, dy] = match shape {
            Shape::Convex => [angle.cos(), angle.sin()],
            Shape::Star => [angle.cos(), angle.sin()].map(|n| n * (0.2 + 0.8 * random.f64())),
            Shape::Tangle => [(); 2].map(|()| random.f64() * 2.0 - 1.0),
        };
        let [dx, dy] = [dx * reach[0], dy * reach[1]];
        let right = centre[0] + scale * dx + shear * dy;
        Corner {
            x: [centre[0] + dx, right].map(snap),
            y: snap(centre[1] + dy),
            values: [(); VALUES].map(|()| random.i32(0..=255)),
        }
    };
    (0..sides).map(|k| corner(k, random)).collect()
}

fn shape(n: usize) -> Shape {
    [Shape::Convex, Shape::Star, Shape::Tangle][n % 3]
}

fn view<const VALUES: usize>(polygon: &[Corner<2, VALUES>], view: usize) -> Vec<Corner<1, VALUES>> {
    polygon.iter().map(|corner| corner.view(view)).collect()
}

/// Spans of a polygon: view, row, columns.
fn filled<const VIEWS: usize>(
    edges: &mut Edges<VIEWS, 0>,
    polygon: &[Corner<VIEWS, 0>],
    work: &mut Work,
) -> Vec<(usize, usize, usize, usize)> {
    let mut spans = Vec::new();
    flat::fill(edges, polygon, work, |view, y, columns| {
        spans.push((view, y, columns.start, columns.end));
    });
    spans.sort_unstable();
    spans
}

#[test]
fn polygons_are_filled_together_as_alone() {
    let mut random = Rng::with_seed(2);
    let (mut two, mut one) = (Edges::new(SIZE, BITS), Edges::new(SIZE, BITS));
    let [mut together, mut alone] = [Work::default(); 2];
    for n in 0..400_000 {
        let polygon = polygon(&mut random, shape(n));
        let both = filled(&mut two, &polygon, &mut together);
        let mut single = filled(&mut one, &view(&polygon, 0), &mut alone);
        let right = filled(&mut one, &view(&polygon, 1), &mut alone);
        single.extend(right.into_iter().map(|(_, y, start, end)| (1, y, start, end)));
        assert_eq!(both, single, "{polygon:?}");
    }
    // What does not depend on x is done once.
    assert_eq!(alone.edge_updates, 2 * together.edge_updates);
    let done = |work: Work| (work.polygons, work.interpolations, work.pixels_written);
    assert_eq!(done(alone), done(together));
    assert!(together.pixels_written > 50_000_000);
}

/// Pixels of a view that an odd number of the triangles of its fan cover, by direct rendering.
fn reference(polygon: &[Corner<2, 0>], eye: Eye, formats: &Formats) -> Vec<bool> {
    let mut covered = vec![false; (SIZE[0] * SIZE[1]) as usize];
    for k in 1..polygon.len() - 1 {
        let corners = [0, k, k + 1].map(|n| polygon[n]);
        let vertices = corners.map(|c| Vertex { x: c.x, y: [c.y; 2], ..Vertex::default() });
        let triangle = Polygon { vertices: vertices.to_vec(), ..Polygon::default() };
        direct::scan(&Outline::new(&triangle, eye), SIZE, formats, |x, y, _, _| {
            covered[(y * i64::from(SIZE[0]) + x) as usize] ^= true;
        });
    }
    covered
}

#[test]
fn coverage_is_that_of_direct_rendering() {
    let formats = Formats::new(&Config { antialias: false, ..Config::DEFAULT });
    assert_eq!(formats.subpixel_bits, BITS);
    let mut random = Rng::with_seed(3);
    let mut edges = Edges::new(SIZE, BITS);
    let mut pixels = 0;
    for n in 0..60_000 {
        let polygon = polygon(&mut random, shape(n));
        let mut covered = [0, 1].map(|_| vec![false; (SIZE[0] * SIZE[1]) as usize]);
        flat::fill(&mut edges, &polygon, &mut Unmetered, |view, y, columns| {
            for x in columns {
                let pixel = &mut covered[view][y * SIZE[0] as usize + x];
                assert!(!*pixel, "twice: {polygon:?}");
                *pixel = true;
                pixels += 1;
            }
        });
        for eye in Eye::BOTH {
            let reference = reference(&polygon, eye, &formats);
            assert_eq!(covered[eye as usize], reference, "{polygon:?} {eye:?}");
        }
    }
    assert!(pixels > 8_000_000, "{pixels}");
}

/// A pixel: view, row, column and values.
type Pixel = (usize, usize, usize, [i32; 3]);

fn shaded<const VIEWS: usize>(
    edges: &mut Edges<VIEWS, 3>,
    polygon: &[Corner<VIEWS, 3>],
    work: &mut Work,
) -> Vec<Pixel> {
    let mut pixels = Vec::new();
    gouraud::shade(edges, polygon, work, |view, y, ramp| {
        ramp.for_each(|x, values| pixels.push((view, y, x, values)));
    });
    pixels.sort_unstable();
    pixels
}

#[test]
fn polygons_are_shaded_together_as_alone() {
    let mut random = Rng::with_seed(4);
    let (mut two, mut one) = (Edges::new(SIZE, BITS), Edges::new(SIZE, BITS));
    let (mut plain_two, mut drawn) = (Edges::new(SIZE, BITS), 0);
    for n in 0..60_000 {
        let polygon = polygon::<3>(&mut random, shape(n));
        let [mut together, mut alone] = [Work::default(); 2];
        let both = shaded(&mut two, &polygon, &mut together);
        let mut single = shaded(&mut one, &view(&polygon, 0), &mut alone);
        let right = shaded(&mut one, &view(&polygon, 1), &mut alone);
        single.extend(right.into_iter().map(|(_, y, x, values)| (1, y, x, values)));
        assert_eq!(both, single, "{polygon:?}");
        assert!(both.iter().all(|pixel| pixel.3.iter().all(|v| (0..=255).contains(v))));
        // The pixels are those of the fill.
        let plain: Vec<_> = polygon.iter().map(|c| Corner { x: c.x, y: c.y, values: [] }).collect();
        let spans = filled(&mut plain_two, &plain, &mut Work::default());
        let of_spans =
            spans.iter().flat_map(|&(v, y, start, end)| (start..end).map(move |x| (v, y, x)));
        assert!(of_spans.eq(both.iter().map(|&(v, y, x, _)| (v, y, x))), "{polygon:?}");
        drawn += both.len();
    }
    assert!(drawn > 5_000_000, "{drawn}");
}

/// Crossings of a convex polygon's outline with the centre line of a row of a view, and the values
/// there, from left to right.
fn crossings(polygon: &[Corner<2, 3>], view: usize, y: usize) -> Vec<(f64, [f64; 3])> {
    let one = f64::from(1 << BITS);
    let line = (y as f64 + 0.5) * one;
    let mut found = Vec::new();
    for (k, to) in polygon.iter().enumerate() {
        let from = &polygon[(k + polygon.len() - 1) % polygon.len()];
        if (f64::from(from.y) < line) != (f64::from(to.y) < line) {
            let t = (line - f64::from(from.y)) / f64::from(to.y - from.y);
            let mix = |a: i32, b: i32| f64::from(a) + t * f64::from(b - a);
            let values = [0, 1, 2].map(|n| mix(from.values[n], to.values[n]));
            found.push((mix(from.x[view], to.x[view]) / one, values));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

#[test]
fn colours_are_interpolated_along_edges_and_between_them() {
    let mut random = Rng::with_seed(5);
    let mut edges = Edges::new(SIZE, BITS);
    let mut compared = 0;
    for _ in 0..30_000 {
        let polygon = polygon::<3>(&mut random, Shape::Convex);
        // Corners between the centre lines, so that no edge ends on one.
        let polygon: Vec<_> = polygon.iter().map(|c| Corner { y: c.y | 1, ..*c }).collect();
        gouraud::shade(&mut edges, &polygon, &mut Unmetered, |view, y, ramp| {
            let crossings = crossings(&polygon, view, y);
            let &[left, right] = &crossings[..] else { return };
            let pixels = [left, right].map(|(x, _)| (x - 0.5).ceil());
            let steps = pixels[1] - 1.0 - pixels[0];
            ramp.for_each(|x, values| {
                let t = if steps > 0.0 { (x as f64 - pixels[0]) / steps } else { 0.0 };
                for (n, value) in values.into_iter().enumerate() {
                    let wanted = left.1[n] + t * (right.1[n] - left.1[n]);
                    let error = (f64::from(value) - wanted).abs();
                    assert!(error < 0.51, "{polygon:?} {x} {y} {wanted}");
                }
                compared += 1;
            });
        });
    }
    assert!(compared > 5_000_000, "{compared}");
}

/// A polygon with a row for each width: a staircase that is as wide there, in both views.
fn staircase(widths: &[i32]) -> Vec<Corner<2, 3>> {
    let corner = |x: i32, y: usize| Corner {
        x: [x + 4, x + 7].map(|x| x << BITS),
        y: (y as i32) << BITS,
        values: [x & 255, y as i32 & 255, 128],
    };
    let right = widths.iter().enumerate().flat_map(|(y, &w)| [corner(w, y), corner(w, y + 1)]);
    [corner(0, 0)].into_iter().chain(right).chain([corner(0, widths.len())]).collect()
}

/// Interpolations for a polygon done for each view, and for both together.
fn interpolations(polygon: &[Corner<2, 3>]) -> [u64; 2] {
    let (mut two, mut one) = (Edges::new([64, 64], BITS), Edges::new([64, 64], BITS));
    let [mut alone, mut together] = [Work::default(); 2];
    shaded(&mut two, polygon, &mut together);
    (0..2).for_each(|n| drop(shaded(&mut one, &view(polygon, n), &mut alone)));
    [alone.interpolations, together.interpolations]
}

#[test]
fn interpolations_are_those_of_the_publication() {
    let mut random = Rng::with_seed(6);
    for _ in 0..1000 {
        let rows = random.usize(1..=32);
        let widths: Vec<i32> = (0..rows).map(|_| random.i32(2..=40)).collect();
        let edge = 2 * rows as u64;
        let interior: u64 = widths.iter().map(|&w| w as u64 - 2).sum();
        let expected = [2 * (4 * edge + 3 * interior), 5 * edge + 6 * interior];
        assert_eq!(interpolations(&staircase(&widths)), expected, "{widths:?}");
    }
    // Two pixels wide: 37.5 % less, the most there is.
    assert_eq!(interpolations(&staircase(&[2; 20])), [320, 200]);
}
