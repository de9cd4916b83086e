//! The algorithms on the publication's kind of data, each done for one view after the other and
//! for both at once.

use fastrand::Rng;
use std::hint::black_box;
use std::ops::Range;
use wheatstone_golden::clipping::{lines, polygons, Point, Window};
use wheatstone_golden::faces::{Plane, Viewer};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::simultaneous::gouraud::{self, Ramp};
use wheatstone_golden::simultaneous::projection::Projector;
use wheatstone_golden::simultaneous::{flat, Corner, Edges};
use wheatstone_golden::work::{counted, Meter, Real, Unmetered, Work};

use crate::timing::{self, Ratio};

/// Width and height of the views that are drawn, in pixels.
const SIZE: [u32; 2] = [256, 256];
const SUBPIXEL_BITS: u32 = 8;
/// Distance between the eyes and of the screen from them.
const EYES: [f64; 2] = [6.5, 60.0];

/// An algorithm with its input; results are kept until it is done again.
pub trait Algorithm: Clone {
    /// For the left view, then for the right one.
    fn separately(&mut self, meter: &mut impl Meter);
    /// For both views.
    fn together(&mut self, meter: &mut impl Meter);
}

/// Work done separately and together.
pub fn work(algorithm: &impl Algorithm) -> [Work; 2] {
    let mut algorithm = algorithm.clone();
    let mut done = [Work::default(); 2];
    let separately = counted(|| algorithm.separately(&mut done[0]));
    let together = counted(|| algorithm.together(&mut done[1]));
    (done[0].operations, done[1].operations) = (separately.1, together.1);
    done
}

/// Time separately : time together.
pub fn time(rounds: usize, algorithm: &impl Algorithm) -> Ratio {
    let [mut one, mut two] = [algorithm.clone(), algorithm.clone()];
    let separately = || black_box(&mut one).separately(&mut Unmetered);
    let together = || black_box(&mut two).together(&mut Unmetered);
    timing::ratio(rounds, separately, together)
}

/// Points before the eyes.
#[derive(Clone)]
pub struct Projection<T> {
    points: Vec<[T; 3]>,
    projector: Projector<T>,
    alone: [Vec<Point<T, 1>>; 2],
    both: Vec<Point<T, 2>>,
}

impl<T: Real> Projection<T> {
    /// Points in a box about the screen.
    pub fn new(count: usize) -> Projection<T> {
        let mut random = Rng::with_seed(1);
        let mut point = || [30.0, 20.0, 80.0].map(|reach| T::of((random.f64() - 0.5) * reach));
        let points = (0..count).map(|_| point()).collect();
        let projector = Projector::new(EYES[0], EYES[1]);
        Projection { points, projector, alone: Default::default(), both: Vec::new() }
    }
}

impl<T: Real> Algorithm for Projection<T> {
    fn separately(&mut self, _: &mut impl Meter) {
        for (eye, seen) in Eye::BOTH.into_iter().zip(&mut self.alone) {
            seen.clear();
            seen.extend(self.points.iter().map(|&point| self.projector.one(point, eye)));
        }
    }
    fn together(&mut self, _: &mut impl Meter) {
        self.both.clear();
        self.both.extend(self.points.iter().map(|&point| self.projector.both(point)));
    }
}

/// Planes about the screen.
#[derive(Clone)]
pub struct Faces<T> {
    planes: Vec<Plane<T>>,
    viewer: Viewer<T>,
    alone: [Vec<bool>; 2],
    both: Vec<[bool; 2]>,
}

impl<T: Real> Faces<T> {
    /// Planes of any direction.
    pub fn new(count: usize) -> Faces<T> {
        let mut random = Rng::with_seed(2);
        let mut plane = || [1.0, 1.0, 1.0, 20.0].map(|reach| T::of((random.f64() - 0.5) * reach));
        let planes = (0..count).map(|_| Plane(plane())).collect();
        let viewer = Viewer::new(EYES[0], EYES[1]);
        Faces { planes, viewer, alone: Default::default(), both: Vec::new() }
    }

    /// Both eyes by the publication's decisions.
    pub fn decided(&mut self) {
        self.both.clear();
        self.both.extend(self.planes.iter().map(|plane| self.viewer.decide(plane)));
    }
}

impl<T: Real> Algorithm for Faces<T> {
    fn separately(&mut self, _: &mut impl Meter) {
        let [separation, distance] = EYES;
        for (side, faces) in [-0.5, 0.5].into_iter().zip(&mut self.alone) {
            let eye = [side * separation, 0.0, -distance].map(T::of);
            faces.clear();
            faces.extend(self.planes.iter().map(|plane| plane.faces(eye)));
        }
    }
    fn together(&mut self, _: &mut impl Meter) {
        self.both.clear();
        self.both.extend(self.planes.iter().map(|plane| self.viewer.facing(plane).front()));
    }
}

/// The window that lines and polygons are clipped to.
fn window<T: Real>() -> Window<T> {
    Window { x: [0.0, 640.0].map(T::of), y: [0.0, 480.0].map(T::of) }
}

/// A point within twice the window's size about its middle, with a disparity of up to 16 pixels.
fn about_window<T: Real>(random: &mut Rng) -> Point<T, 2> {
    let x = random.f64() * 1280.0 - 320.0;
    let y = random.f64() * 960.0 - 240.0;
    Point { x: [x, x + random.f64() * 32.0 - 16.0].map(T::of), y: T::of(y) }
}

fn views<const N: usize, T, U>(both: &[T], view: impl Fn(&T, usize) -> U) -> [Vec<U>; N] {
    core::array::from_fn(|n| both.iter().map(|item| view(item, n)).collect())
}

type Clipped<T, const VIEWS: usize> = [Option<lines::Line<T>>; VIEWS];

/// Lines about the window.
#[derive(Clone)]
pub struct Lines<T> {
    both: Vec<[Point<T, 2>; 2]>,
    alone: [Vec<[Point<T, 1>; 2]>; 2],
    clipped: Vec<Clipped<T, 2>>,
    clipped_alone: [Vec<Clipped<T, 1>>; 2],
}

impl<T: Real> Lines<T> {
    /// Lines with both ends anywhere about the window, or within it in both views.
    pub fn new(count: usize, within: bool) -> Lines<T> {
        let mut random = Rng::with_seed(3);
        let inside = |p: &Point<T, 2>| {
            let [x, y] = [p.x.map(T::value), [p.y.value(); 2]];
            x.iter().all(|x| (0.0..=640.0).contains(x)) && (0.0..=480.0).contains(&y[0])
        };
        let mut line = || [(); 2].map(|()| about_window(&mut random));
        let lines = core::iter::repeat_with(&mut line);
        let both: Vec<_> = lines.filter(|l| !within || l.iter().all(inside)).take(count).collect();
        let alone = views(&both, |line, view| line.map(|point| point.view(view)));
        Lines { both, alone, clipped: Vec::new(), clipped_alone: Default::default() }
    }
}

impl<T: Real> Algorithm for Lines<T> {
    fn separately(&mut self, meter: &mut impl Meter) {
        let window = window();
        for (lines, clipped) in self.alone.iter().zip(&mut self.clipped_alone) {
            clipped.clear();
            clipped.extend(lines.iter().map(|line| lines::clip(line, &window, meter)));
        }
    }
    fn together(&mut self, meter: &mut impl Meter) {
        let window = window();
        self.clipped.clear();
        self.clipped.extend(self.both.iter().map(|line| lines::clip(line, &window, meter)));
    }
}

/// Polygons about the window.
#[derive(Clone)]
pub struct Polygons<T> {
    both: Vec<Vec<Point<T, 2>>>,
    alone: [Vec<Vec<Point<T, 1>>>; 2],
    outlines: [Vec<[T; 2]>; 2],
    outline: [Vec<[T; 2]>; 1],
}

impl<T: Real> Polygons<T> {
    /// Polygons of 4 to 32 corners anywhere about the window.
    pub fn new(count: usize) -> Polygons<T> {
        let mut random = Rng::with_seed(4);
        let polygon = |_| {
            let corners = random.usize(4..=32);
            (0..corners).map(|_| about_window(&mut random)).collect::<Vec<_>>()
        };
        let both: Vec<_> = (0..count).map(polygon).collect();
        let alone = views(&both, |polygon, n| polygon.iter().map(|p| p.view(n)).collect());
        Polygons { both, alone, outlines: Default::default(), outline: Default::default() }
    }
}

impl<T: Real> Algorithm for Polygons<T> {
    fn separately(&mut self, meter: &mut impl Meter) {
        for polygon in self.alone.iter().flatten() {
            self.outline[0].clear();
            polygons::clip(polygon, &window(), meter, &mut self.outline);
        }
    }
    fn together(&mut self, meter: &mut impl Meter) {
        for polygon in &self.both {
            self.outlines.iter_mut().for_each(Vec::clear);
            polygons::clip(polygon, &window(), meter, &mut self.outlines);
        }
    }
}

/// Polygons to fill or to shade.
#[derive(Clone)]
pub struct Drawing<const VALUES: usize> {
    both: Vec<Vec<Corner<2, VALUES>>>,
    alone: [Vec<Vec<Corner<1, VALUES>>>; 2],
    edges_of_two: Edges<2, VALUES>,
    edges_of_one: Edges<1, VALUES>,
    views: [Vec<[u8; 3]>; 2],
}

impl<const VALUES: usize> Drawing<VALUES> {
    /// Polygons of which the corners are given in pixels of the left view; the right one sees them
    /// 3 pixels to the right.
    pub fn of(corners: &[[f64; 2]]) -> Drawing<VALUES> {
        let subpixels = |n: f64| (n * f64::from(1 << SUBPIXEL_BITS)).round() as i32;
        let corner = |(k, &[x, y]): (usize, &[f64; 2])| Corner {
            x: [x, x + 3.0].map(subpixels),
            y: subpixels(y),
            values: [(k * 97 % 256) as i32; VALUES],
        };
        Drawing::new(vec![corners.iter().enumerate().map(corner).collect()])
    }

    /// Convex polygons with that many sides, of any width and height up to `reach` pixels from
    /// their middle, and a little narrower or wider to the right eye.
    pub fn random(count: usize, sides: usize, reach: f64) -> Drawing<VALUES> {
        let mut random = Rng::with_seed(5);
        let polygon = |_| {
            let size = [(); 2].map(|()| reach * (0.3 + 0.7 * random.f64()));
            let [turn, scale] = [random.f64(), 0.9 + 0.2 * random.f64()];
            let corner = |k: usize| {
                let part = (k as f64 + 0.6 * random.f64()) / sides as f64 + turn;
                let (sine, cosine) = (part * core::f64::consts::TAU).sin_cos();
                let [x, y] = [size[0] * cosine, size[1] * sine].map(|n| n * 256.0);
                let values = [(); VALUES].map(|()| random.i32(0..=255));
                let middle = [0, 1].map(|n| f64::from(SIZE[n]) * 128.0);
                let x = [middle[0] + x, middle[0] + scale * x].map(|n| n as i32);
                Corner { x, y: (middle[1] + y) as i32, values }
            };
            (0..sides).map(corner).collect()
        };
        Drawing::new((0..count).map(polygon).collect())
    }

    fn new(both: Vec<Vec<Corner<2, VALUES>>>) -> Drawing<VALUES> {
        let alone = views(&both, |polygon, n| polygon.iter().map(|c| c.view(n)).collect());
        Drawing {
            both,
            alone,
            edges_of_two: Edges::new(SIZE, SUBPIXEL_BITS),
            edges_of_one: Edges::new(SIZE, SUBPIXEL_BITS),
            views: [(); 2].map(|()| vec![[0; 3]; (SIZE[0] * SIZE[1]) as usize]),
        }
    }
}

/// The row of a view from which on it is drawn.
fn row(view: &mut [[u8; 3]], y: usize) -> &mut [[u8; 3]] {
    &mut view[y * SIZE[0] as usize..]
}

/// Fills a span. Not inlined, so that both forms write pixels with the same code.
#[inline(never)]
fn paint(row: &mut [[u8; 3]], columns: Range<usize>, n: usize) {
    row[columns].fill([n as u8, 128, 255]);
}

/// Draws a span, not inlined either.
#[inline(never)]
fn paint_ramp(row: &mut [[u8; 3]], ramp: Ramp<3>) {
    ramp.for_each(|x, rgb| row[x] = rgb.map(|n| n as u8));
}

/// Scan-line fill.
impl Algorithm for Drawing<0> {
    fn separately(&mut self, meter: &mut impl Meter) {
        for (polygons, view) in self.alone.iter().zip(&mut self.views) {
            for (n, polygon) in polygons.iter().enumerate() {
                flat::fill(&mut self.edges_of_one, polygon, meter, |_, y, columns| {
                    paint(row(view, y), columns, n);
                });
            }
        }
    }
    fn together(&mut self, meter: &mut impl Meter) {
        for (n, polygon) in self.both.iter().enumerate() {
            flat::fill(&mut self.edges_of_two, polygon, meter, |view, y, columns| {
                paint(row(&mut self.views[view], y), columns, n);
            });
        }
    }
}

/// Gouraud shading.
impl Algorithm for Drawing<3> {
    fn separately(&mut self, meter: &mut impl Meter) {
        for (polygons, view) in self.alone.iter().zip(&mut self.views) {
            for polygon in polygons {
                gouraud::shade(&mut self.edges_of_one, polygon, meter, |_, y, ramp| {
                    paint_ramp(row(view, y), ramp);
                });
            }
        }
    }
    fn together(&mut self, meter: &mut impl Meter) {
        for polygon in &self.both {
            gouraud::shade(&mut self.edges_of_two, polygon, meter, |view, y, ramp| {
                paint_ramp(row(&mut self.views[view], y), ramp);
            });
        }
    }
}
