//! Noted operations against the same formulas in numbers that count.

use wheatstone_golden::config::Config;
use wheatstone_golden::cost;
use wheatstone_golden::direct::Direct;
use wheatstone_golden::formats::{Eye, Formats, Rgba};
use wheatstone_golden::frame::Frame;
use wheatstone_golden::setup::{Attributes, Outline, Polygon, Vertex};
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::work::{counted, Counted, Operations, Real, Work};

const FORMATS: Formats = Formats::new(&Config::DEFAULT);

fn of(n: i64) -> Counted {
    Counted::of(n as f64)
}

fn triangle(seed: u64) -> Polygon {
    let mut random = fastrand::Rng::with_seed(seed);
    let vertices = (0..3).map(|_| {
        let [x, y] = [(); 2].map(|()| random.i32(0..64 * 256));
        let colour = [Rgba([random.u8(..), random.u8(..), random.u8(..), 255]); 2];
        let depth = random.u32(1000..1 << 23);
        Vertex { x: [x; 2], y: [y; 2], depth, colour, ..Vertex::default() }
    });
    Polygon { vertices: vertices.collect(), id: 7, ..Polygon::default() }
}

fn cross(p: [[Counted; 2]; 3]) -> Counted {
    let [[x0, y0], [x1, y1], [x2, y2]] = p;
    (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
}

/// a, b and c of the plane through three values, as `Plane::through` has them.
fn through(p: [[Counted; 2]; 3], det: Counted, v: [Counted; 3]) -> [Counted; 3] {
    // Not one or the other: both are looked at.
    if (v[1] == v[0]) & (v[2] == v[0]) {
        return [of(0), of(0), v[0]];
    }
    let [[x0, y0], [x1, y1], [x2, y2]] = p;
    let across = (v[1] - v[0]) * (y2 - y0) - (v[2] - v[0]) * (y1 - y0);
    let down = (x1 - x0) * (v[2] - v[0]) - (x2 - x0) * (v[1] - v[0]);
    let anchor = [x0, y0].map(|n| of(n.value() as i64 >> 8));
    // Shifts are free.
    let subpixels = |n: Counted| Counted::of(n.value() * 256.0);
    let centre = of(128);
    let offset = [subpixels(anchor[0]) + centre - x0, subpixels(anchor[1]) + centre - y0];
    let [a, b] = [across, down].map(|n| subpixels(n / det));
    let at_anchor = v[0] + (across * offset[0] + down * offset[1]) / det;
    [a, b, at_anchor - a * anchor[0] - b * anchor[1]]
}

/// The first cell and the one past the last of a row, as direct rendering finds them.
fn crossing(p: [[Counted; 2]; 3], row: i64) -> [i64; 2] {
    let (one, y) = (of(256), of((2 * row + 1) * 256));
    let mut cells = [Counted::of(1e9), Counted::of(-1e9)];
    for k in 0..3 {
        let [from, to] = [p[k], p[(k + 1) % 3]].map(|p| p.map(|n| Counted::of(n.value() * 2.0)));
        let [upper, lower] = if from[1] <= to[1] { [from, to] } else { [to, from] };
        if !((upper[1] <= y) & (y < lower[1])) {
            continue;
        }
        let (rise, run) = (lower[1] - upper[1], lower[0] - upper[0]);
        let numerator = (upper[0] - one) * rise + run * (y - upper[1]);
        let quotient = numerator / (Counted::of(2.0 * one.value()) * rise);
        let cell = Counted::of(quotient.value().ceil());
        cells[0] = if cell < cells[0] { cell } else { cells[0] };
        cells[1] = if cell > cells[1] { cell } else { cells[1] };
    }
    let [first, end] = cells.map(|n| n.value() as i64);
    if first > end {
        [0, 0]
    } else {
        [first, end]
    }
}

#[test]
fn planes() {
    for seed in 0..50 {
        let polygon = triangle(seed);
        let outline = Outline::new(&polygon, Eye::Left);
        let attributes = Attributes::new(&polygon, Eye::Left, &FORMATS);
        let corners = Attributes::corners(&polygon, Eye::Left);
        let p = corners.map(|v| [of(v.x[0].into()), of(v.y[0].into())]);
        let ((), done) = counted(|| {
            // The largest triangle of the fan, then the determinant.
            let largest = cross(p);
            let _ = largest > of(0);
            let det = cross(p);
            let depth = through(p, det, corners.map(|v| of(v.depth.into())));
            assert!((depth[0].value() * 16384.0 - attributes.depth.a as f64).abs() < 2.0);
            assert!((depth[1].value() * 16384.0 - attributes.depth.b as f64).abs() < 2.0);
            for n in 0..4 {
                through(p, det, corners.map(|v| of(v.colour[0].0[n].into())));
            }
        });
        assert_eq!(done, cost::attributes(3, &attributes), "seed {seed}");
        let points: Vec<[Counted; 2]> = outline.points().iter().map(|p| p.map(of)).collect();
        let (doubled, done) = counted(|| {
            let mut sum = of(0);
            for pair in points.windows(2) {
                sum += cross([points[0], pair[0], pair[1]]);
            }
            let _ = sum == of(0);
            sum
        });
        assert_eq!(doubled.value() as i64, outline.doubled_area());
        assert_eq!(done, cost::area(3));
    }
}

/// All that drawing one triangle without texture takes.
#[test]
fn direct_rendering_of_a_triangle() {
    let direct = Direct { formats: FORMATS, textures: &[], lookup: Lookup::Nearest };
    for seed in 0..50 {
        let polygon = triangle(seed);
        let mut frame = Frame::new(64, 64, [0; 3]);
        let mut work = Work::default();
        direct.draw_metered(&polygon, Eye::Left, &mut frame, &mut work);
        let outline = Outline::new(&polygon, Eye::Left);
        let p: [[Counted; 2]; 3] = std::array::from_fn(|k| outline.points()[k].map(of));
        let [[_, top], [_, bottom]] = outline.bounds();
        let mut pixels = 0;
        let ((), crossings) = counted(|| {
            for row in top.div_euclid(256)..=bottom.div_euclid(256).min(63) {
                let [first, end] = crossing(p, row);
                pixels += (end - first).max(0) as u64;
            }
        });
        assert_eq!((work.pixels_tested, work.pixels_written), (pixels, pixels), "seed {seed}");
        // Depth and four channels a·x + b·y + c, a comparison, and blending: alpha by area, and three
        // channels of two sums and a product.
        let linear = Operations::new(2, 2, 0, 0) * 5 + Operations::comparisons(1);
        let blend = Operations::new(1 + 3 * 2, 1 + 3, 0, 1);
        let attributes = Attributes::new(&polygon, Eye::Left, &FORMATS);
        let setup = cost::area(3) + cost::attributes(3, &attributes);
        let expected = setup + crossings + (linear + blend) * pixels;
        assert_eq!(work.fixed_point, expected, "seed {seed}");
        assert_eq!(work.operations, Operations::default());
    }
}
