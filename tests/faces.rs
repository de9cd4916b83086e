//! Faces of both eyes at once: against the plane equation at each eye in exact integers, and G1
//! against the areas of projected polygons and against setup.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::faces::{Facing, Plane, Viewer};
use wheatstone_golden::formats::{Eye, Formats, FRACTION_BITS};
use wheatstone_golden::scene::vector::{dot, outward, Vec3};
use wheatstone_golden::scene::{Camera, Rig};
use wheatstone_golden::setup::{Eyes, Map};
use wheatstone_golden::simultaneous::projection::Projector;
use wheatstone_golden::work::{counted, Counted, Operations, Real};

/// The value of a plane at a point.
fn exact(plane: [i64; 4], point: [i64; 3]) -> i128 {
    let terms = (0..3).map(|k| i128::from(plane[k]) * i128::from(point[k]));
    terms.sum::<i128>() + i128::from(plane[3])
}

fn real<const N: usize>(numbers: [i64; N]) -> [f64; N] {
    numbers.map(|n| n as f64)
}

/// The left and the right eye.
fn eyes(viewer: &Viewer<f64>) -> [[i64; 3]; 2] {
    let right = viewer.right.map(|n| n as i64);
    [[right[0] - viewer.separation as i64, right[1], right[2]], right]
}

#[test]
fn a_million_planes_face_the_eyes_as_their_equations_say() {
    let mut random = Rng::with_seed(1);
    let mut seen = [[0; 3]; 3];
    for _ in 0..1_000_000 {
        let place = [(); 3].map(|()| random.i64(-50..=50));
        let viewer = Viewer { right: real(place), separation: random.i64(0..=13) as f64 };
        let reach = [1, 10, 1 << 20][random.usize(..3)];
        let [a, b, c, mut d] = [(); 4].map(|()| random.i64(-reach..=reach));
        // Many planes go through an eye.
        let through = random.usize(..4);
        if let Some(&eye) = eyes(&viewer).get(through) {
            d = -exact([a, b, c, 0], eye) as i64;
        }
        let values = eyes(&viewer).map(|eye| exact([a, b, c, d], eye));
        let plane = Plane(real([a, b, c, d]));
        let facing = viewer.facing(&plane);
        let front = values.map(|value| value > 0);
        let case = || format!("{plane:?} {viewer:?} {values:?}");
        assert_eq!(facing.front(), front, "{}", case());
        assert_eq!(viewer.decide(&plane), front, "{}", case());
        assert_eq!(eyes(&viewer).map(|eye| plane.faces(real(eye))), front, "{}", case());
        let expected = match front {
            [true, true] => Some(Eyes::Both),
            [true, false] => Some(Eyes::One(Eye::Left)),
            [false, true] => Some(Eyes::One(Eye::Right)),
            [false, false] => None,
        };
        assert_eq!(facing.eyes(), expected, "{}", case());
        let [left, right] = values.map(|value| (value.signum() + 1) as usize);
        seen[left][right] += 1;
    }
    // All nine cases of behind, edge-on and before.
    assert!(seen.iter().flatten().all(|&n| n > 5_000), "{seen:?}");
}

#[test]
fn rounding_misjudges_only_planes_seen_edge_on() {
    let mut random = Rng::with_seed(2);
    let mut misjudged = 0;
    for _ in 0..300_000 {
        let size = random.u32(10..=40);
        let mut number = |bits: u32| random.i64(-(1 << bits)..1 << bits);
        let [a, b, c] = [size, size, size].map(&mut number);
        let right = [20, 20, 20].map(&mut number);
        let left = [right[0] - 1000, right[1], right[2]];
        // So close to an eye that it takes all bits to tell.
        let d = -exact([a, b, c, 0], left) as i64 + number(6);
        let viewer = Viewer { right: real(right), separation: 1000.0 };
        let front = viewer.facing(&Plane(real([a, b, c, d]))).front();
        for (eye, front) in [left, right].into_iter().zip(front) {
            let value = exact([a, b, c, d], eye);
            if front == (value > 0) {
                continue;
            }
            misjudged += 1;
            let terms = 1000 * a.abs() as i128
                + (0..3).map(|k| ([a, b, c][k] as i128 * eye[k] as i128).abs()).sum::<i128>();
            assert!(value.abs() << 50 <= terms + d.abs() as i128, "{value} of {terms}");
        }
    }
    assert!(misjudged > 0);
}

#[test]
fn fourteen_operations_become_ten_or_eleven() {
    let viewer: Viewer<Counted> = Viewer::new(6.5, 60.0);
    let mut random = Rng::with_seed(3);
    let mut decisions = [0; 2];
    for _ in 0..10_000 {
        let plane = Plane([(); 4].map(|()| Counted::of(random.f64() * 10.0 - 5.0)));
        let left = [viewer.right[0] - viewer.separation, viewer.right[1], viewer.right[2]];
        let separately = counted(|| [left, viewer.right].map(|eye| plane.faces(eye)));
        let together = counted(|| viewer.facing(&plane).front());
        let decided = counted(|| viewer.decide(&plane));
        assert_eq!((separately.0, separately.0), (together.0, decided.0));
        let arithmetic = |additions, multiplications, comparisons| Operations {
            additions,
            multiplications,
            comparisons,
            divisions: 0,
        };
        assert_eq!(separately.1, arithmetic(6, 6, 2));
        assert_eq!(together.1, arithmetic(4, 4, 2));
        decisions[(decided.1.all() - 10) as usize] += 1;
        assert_eq!(decided.1.arithmetic(), 8);
    }
    assert!(decisions.iter().all(|&n| n > 1000), "{decisions:?}");
}

/// A random triangle in front of eyes at 60 from the screen, not far from edge-on.
fn triangle(random: &mut Rng) -> [Vec3; 3] {
    let place = [(); 3].map(|()| random.f64() * 20.0 - 10.0);
    let mut corner = || {
        let offset = [8.0, 8.0, 30.0].map(|reach| (random.f64() - 0.5) * reach);
        [0, 1, 2].map(|k| place[k] + offset[k])
    };
    [corner(), corner(), corner()]
}

fn facing(viewer: &Viewer<f64>, [a, b, c]: [Vec3; 3]) -> Facing<f64> {
    let normal = outward(a, b, c);
    viewer.facing(&Plane([normal[0], normal[1], normal[2], -dot(normal, a)]))
}

/// Twice the signed area.
fn area(points: [[f64; 2]; 3]) -> f64 {
    let [[x0, y0], [x1, y1], [x2, y2]] = points;
    (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
}

#[test]
fn the_values_of_a_plane_are_as_the_areas_of_its_polygons() {
    let rig = Rig::default();
    let viewer = Viewer::new(rig.eye_separation, rig.viewing_distance);
    let projector = Projector::new(rig.eye_separation, rig.viewing_distance);
    let mut random = Rng::with_seed(4);
    let mut exclusive = 0;
    for _ in 0..100_000 {
        let corners = triangle(&mut random);
        let facing = facing(&viewer, corners);
        let points = corners.map(|corner| projector.both(corner));
        let areas = [0, 1].map(|view| area(points.map(|p| [p.x[view], p.y])));
        let scale = 60.0 * corners.iter().map(|p| 1.0 + p[2] / 60.0).product::<f64>();
        for (area, value) in areas.into_iter().zip(facing.values) {
            // Counter-clockwise from the front; the plane's value is the area times what follows
            // from the corners' distances alone.
            assert!((area * scale - value).abs() < 1e-9 * scale, "{corners:?}");
        }
        match facing.scale() {
            Some((eye, g1)) => {
                let [primary, secondary] = [eye, eye.other()].map(|eye| areas[eye as usize]);
                assert!((g1 * primary - secondary).abs() < 1e-9, "{corners:?}");
                assert!((0.0..=1.0).contains(&g1));
            }
            None => exclusive += 1,
        }
    }
    assert!(exclusive > 1_000, "{exclusive}");
}

#[test]
fn g1_is_that_of_setup_but_for_snapping() {
    let formats = Formats::new(&Config::DEFAULT);
    let rig = Rig::default();
    let camera = Camera::new(&rig, 640, 480, &formats);
    let viewer = Viewer::new(rig.eye_separation, rig.viewing_distance);
    let mut random = Rng::with_seed(5);
    let (mut compared, mut largest): (u32, f64) = (0, 0.0);
    for _ in 0..100_000 {
        let corners = triangle(&mut random);
        let Some((primary, g1)) = facing(&viewer, corners).scale() else { continue };
        let snapped = corners.map(|corner| camera.snap(corner));
        let points = |eye: Eye| snapped.map(|p| [p.x[eye as usize], p.y[eye as usize]]);
        let views = [primary, primary.other()].map(points);
        // Each coordinate of three corners moved by at most half a subpixel.
        let moved = views.map(|points| {
            let side = |k: usize, axis: usize| (points[k][axis] - points[(k + 1) % 3][axis]).abs();
            let sides: i64 = (0..3).map(|k| side(k, 0) + side(k, 1)).sum();
            0.5 * sides as f64 + 3.0
        });
        let area = area(views[0].map(real)).abs();
        let Some(map) = Map::new(views[0], views[1], &formats).filter(|_| area > 2.0 * moved[0])
        else {
            continue;
        };
        let one = f64::from(1 << FRACTION_BITS);
        let allowed = (moved[1] + g1 * moved[0]) / (area - moved[0]) + 0.5 / one;
        let difference = (map.scale() as f64 / one - g1).abs();
        assert!(difference <= allowed, "{corners:?}: {difference} of {allowed}");
        compared += 1;
        largest = largest.max(difference / allowed);
    }
    assert!(compared > 50_000 && largest > 0.1, "{compared} {largest}");
}
