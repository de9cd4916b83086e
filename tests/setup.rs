//! Setup against exact rational arithmetic and brute force.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats, Quantity, SecondaryX, SCALE_MIN};
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::*;

const CONFIGS: [Config; 2] = [Config::DEFAULT, Config::PAPER];

/// Secondary x of a point by barycentric coordinates, as an exact fraction.
fn barycentric(p: [[i64; 2]; 3], s: [i64; 3], x: i128, y: i128, scale: i128) -> (i128, i128) {
    let [a, b, c] = p.map(|v| v.map(|n| i128::from(n) * scale));
    let area = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    };
    let q = [x, y];
    let weights = [area(q, b, c), area(a, q, c), area(a, b, q)];
    let sum: i128 = weights.iter().zip(s).map(|(w, s)| w * i128::from(s)).sum();
    (sum, area(a, b, c))
}

/// |value - numerator/denominator| <= 1/2, exactly.
fn is_nearest(value: i64, numerator: i128, denominator: i128) -> bool {
    (2 * (i128::from(value) * denominator - numerator)).abs() <= denominator.abs()
}

fn each_triangle(count: usize, mut check: impl FnMut(&Polygon, &Formats, Class)) {
    for config in CONFIGS {
        let formats = Formats::new(&config);
        let mut triangles = Triangles::new(11, formats, 320, 240);
        for n in 0..count {
            let class = Class::ALL[n % Class::ALL.len()];
            check(&triangles.triangle(class), &formats, class);
        }
    }
}

#[test]
fn the_map_is_rounded_to_nearest_everywhere() {
    let mut maps = 0;
    each_triangle(3000, |polygon, f, _| {
        let corners = Eye::BOTH.map(|eye| Outline::new(polygon, eye));
        if corners.iter().any(|o| o.points().len() < 3) {
            return;
        }
        let [primary, secondary] = corners.map(|o| [o.points()[0], o.points()[1], o.points()[2]]);
        let Some(map) = Map::new(primary, secondary, f) else { return };
        maps += 1;
        let half = i128::from(f.one_pixel() / 2);
        for (i, j) in [(0, 0), (17, 5), (-9, 200), (319, 239)] {
            let centre = |n: i64| i128::from(n) * i128::from(f.one_pixel()) + half;
            let (n, d) = barycentric(primary, secondary.map(|c| c[0]), centre(i), centre(j), 1);
            let d = d * i128::from(f.one_pixel());
            assert!(is_nearest(map.x_at(i, j), n << 14, d), "x at ({i}, {j}) of {polygon:?}");
            // One step and one row are the differences of the map.
            let (right, _) =
                barycentric(primary, secondary.map(|c| c[0]), centre(i + 1), centre(j), 1);
            assert!(is_nearest(map.scale(), (right - n) << 14, d), "G1 of {polygon:?}");
            let (down, _) =
                barycentric(primary, secondary.map(|c| c[0]), centre(i + 3), centre(j + 1), 1);
            assert!(is_nearest(map.row_shear(3), (down - n) << 14, d), "row shear of {polygon:?}");
        }
    });
    assert!(maps > 4000, "only {maps} maps compared");
}

#[test]
fn edges_agree_with_the_top_left_rule_by_definition() {
    let mut inside = 0;
    each_triangle(600, |polygon, f, _| {
        let outline = Outline::new(polygon, Eye::Left);
        let area = outline.doubled_area();
        if area == 0 {
            return;
        }
        let points = outline.points();
        let edges: Vec<Edge> = outline.edges(f).collect();
        let [[x0, y0], [x1, y1]] = outline.bounds().map(|p| p.map(|c| c >> f.subpixel_bits));
        for j in (y0 - 1..=y1 + 1).step_by(3) {
            for i in (x0 - 1..=x1 + 1).step_by(2) {
                let [x, y] = [i, j].map(|n| n * f.one_pixel() + f.one_pixel() / 2);
                for (k, edge) in edges.iter().enumerate() {
                    let ([px, py], [qx, qy]) = (points[k], points[(k + 1) % points.len()]);
                    // Clockwise as seen: an edge that goes up is a left one, a level one that goes right a top one.
                    let ([px, py], [qx, qy]) =
                        if area > 0 { ([px, py], [qx, qy]) } else { ([qx, qy], [px, py]) };
                    let cross = (qx - px) * (y - py) - (qy - py) * (x - px);
                    let owns = qy < py || (qy == py && qx > px);
                    let expected = cross > 0 || (cross == 0 && owns);
                    assert_eq!(
                        edge.value().at(i, j) >= 0,
                        expected,
                        "({i}, {j}) edge {k} of {points:?}"
                    );
                    inside += u32::from(expected);
                }
            }
        }
    });
    assert!(inside > 10_000);
}

#[test]
fn extended_spans_are_those_of_the_theorem() {
    let mut rows_seen = 0;
    each_triangle(1500, |polygon, f, _| {
        let outline = Outline::new(polygon, Eye::Left);
        if outline.doubled_area() == 0 || f.mask_bits > 1 {
            return;
        }
        let view = View::new(&outline, f);
        let spans = view.extended_spans(0, 0, [i64::MIN / 2, i64::MAX / 2]);
        let rows: Vec<Row> = view.rows(&spans, 240).collect();
        let points = outline.points();
        for row in &rows {
            rows_seen += 1;
            let y = i64::from(row.y) * f.one_pixel() + f.one_pixel() / 2;
            // Crossings of the centre line with every side, as fractions.
            let mut crossings: Vec<(i128, i128)> = Vec::new();
            for k in 0..points.len() {
                let ([px, py], [qx, qy]) = (points[k], points[(k + 1) % points.len()]);
                if py.min(qy) <= y && y <= py.max(qy) {
                    if py == qy {
                        crossings.extend([(px.into(), 1), (qx.into(), 1)]);
                    } else {
                        let d = i128::from(qy - py);
                        let n = i128::from(px) * d + i128::from(qx - px) * i128::from(y - py);
                        crossings.push((n * d.signum(), d.abs()));
                    }
                }
            }
            let pixel = i128::from(f.one_pixel());
            let floor = |(n, d): (i128, i128)| (2 * n - pixel * d).div_euclid(2 * pixel * d);
            let ceil = |(n, d): (i128, i128)| -(-(2 * n - pixel * d)).div_euclid(2 * pixel * d);
            let first = crossings.iter().map(|&c| floor(c)).min();
            let last = crossings.iter().map(|&c| ceil(c)).max();
            assert_eq!(
                (Some(row.first.into()), Some(row.last.into())),
                (first, last),
                "{points:?} {row:?}"
            );
        }
    });
    assert!(rows_seen > 20_000, "{rows_seen}");
}

#[test]
fn parts_give_back_the_rows() {
    each_triangle(2000, |polygon, f, class| {
        let planner = Planner::new(
            Config::DEFAULT,
            Options { cost_rule: false, ..Options::new(&Config::DEFAULT) },
            320,
            240,
        );
        if f.subpixel_bits != 8 {
            return;
        }
        let Plan::Derived(derived) = planner.plan(polygon) else { return };
        let attributes = Attributes::new(polygon, derived.primary.other(), f);
        let registers = Registers::derived(&derived, &attributes);
        let mut rows = derived.rows.iter();
        let mut count = 0;
        for part in parts(&derived.rows, |m| registers.allows(m, f)) {
            count += 1;
            let mut start = None;
            for row in part.rows {
                assert_eq!(Some(row), rows.next());
                let expected = start.map_or(row.first, |s: i32| s + part.movement as i32);
                assert!((0..=1).contains(&(row.first - expected)), "{class:?} {row:?}");
                start = Some(row.first);
            }
            if part.rows.len() > 1 {
                assert!(SecondaryX::fits(derived.map.row_shear(part.movement), f));
            }
        }
        assert_eq!(rows.next(), None);
        assert!(count <= 12, "{class:?}: {count} parts for {} rows", derived.rows.len());
    });
}

#[test]
fn the_smallest_scale_admits_29_pixels_and_no_30th() {
    let most = |scale: i64| ((1 << 14) + scale - 1) / scale;
    assert_eq!(most(SCALE_MIN), 29);
    assert_eq!(most(SCALE_MIN - 1), 30);
}

#[test]
fn reasons_are_given_in_order() {
    let config = Config::DEFAULT;
    let f = Formats::new(&config);
    let vertex = |x: [f64; 2], y: f64| {
        let px = |n: f64| (n * f.one_pixel() as f64) as i32;
        Vertex { x: x.map(px), y: [px(y); 2], ..Vertex::default() }
    };
    let planner =
        |cost_rule| Planner::new(config, Options { cost_rule, ..Options::new(&config) }, 320, 240);
    let reason = |corners: [([f64; 2], f64); 3], change: fn(&mut Polygon)| {
        let vertices = corners.map(|(x, y)| vertex(x, y)).to_vec();
        let mut polygon = Polygon { vertices, ..Polygon::default() };
        change(&mut polygon);
        match planner(true).plan(&polygon) {
            Plan::Monocular { reason, eyes } => Some((reason, eyes)),
            _ => None,
        }
    };
    let large = [([10.0, 12.0], 10.0), ([90.0, 80.0], 20.0), ([40.0, 41.0], 90.0)];
    assert_eq!(reason(large, |_| ()), None);
    assert_eq!(reason(large, |p| p.specular = true), Some((Reason::Specular, [true; 2])));
    assert_eq!(reason(large, |p| p.guard_band = true), Some((Reason::GuardBand, [true; 2])));
    assert_eq!(
        reason(large, |p| p.eyes = Eyes::One(Eye::Right)),
        Some((Reason::ViewExclusive, [false, true]))
    );
    let turned = [([10.0, 90.0], 10.0), ([90.0, 10.0], 20.0), ([40.0, 41.0], 90.0)];
    assert_eq!(reason(turned, |_| ()), Some((Reason::ViewExclusive, [true; 2])));
    let edge_on = [([10.0, 30.0], 10.0), ([90.0, 30.0], 20.0), ([40.0, 30.0], 90.0)];
    assert_eq!(reason(edge_on, |_| ()), Some((Reason::ViewExclusive, [true, false])));
    let narrow = [([10.0, 31.0], 10.0), ([90.0, 32.0], 20.0), ([40.0, 30.0], 90.0)];
    assert_eq!(reason(narrow, |_| ()), Some((Reason::Ratio, [true; 2])));
    let tiny = [([10.2, 10.3], 10.1), ([11.1, 11.0], 10.6), ([10.4, 10.6], 11.2)];
    assert_eq!(reason(tiny, |_| ()), Some((Reason::Cost, [true; 2])));
    let steep = [([10.0, 12.0], 10.0), ([10.01, 12.01], 90.0), ([10.02, 12.02], 50.0)];
    let polygon = |cost_rule| {
        let mut vertices = steep.map(|(x, y)| vertex(x, y)).to_vec();
        vertices[2].colour = [wheatstone_golden::formats::Rgba([255; 4]); 2];
        planner(cost_rule).plan(&Polygon { vertices, ..Polygon::default() })
    };
    assert!(matches!(polygon(false), Plan::Monocular { reason: Reason::Gradient, .. }));
}
