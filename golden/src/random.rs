//! Random polygons of the kinds that go wrong, for regressions and tests.

use crate::formats::{Formats, Rgba, DEPTH_MAX};
use crate::setup::{Eyes, Polygon, Vertex};
use fastrand::Rng;

/// A kind of random triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// Anywhere, any size.
    Generic,
    /// About 32 pixels.
    Px32,
    /// About 8 pixels.
    Px8,
    /// About 2 pixels.
    Px2,
    /// Tall and thin, down to a tenth of a pixel.
    VerticalSliver,
    /// Wide and low, down to a tenth of a pixel.
    HorizontalSliver,
    /// G1 between 1/29 and 0.15.
    ScaleNearZero,
    /// G1 a little under 1.
    ScaleNearOne,
    /// G1 exactly 1: shear and shift alone.
    ScaleOne,
    /// Shear of several pixels a row.
    SteepShear,
    /// Corners on pixel centres and corners, and neighbouring sides shared.
    Ties,
    /// Partly outside the windows.
    Windows,
}

impl Class {
    /// All classes.
    pub const ALL: [Class; 12] = [
        Class::Generic,
        Class::Px32,
        Class::Px8,
        Class::Px2,
        Class::VerticalSliver,
        Class::HorizontalSliver,
        Class::ScaleNearZero,
        Class::ScaleNearOne,
        Class::ScaleOne,
        Class::SteepShear,
        Class::Ties,
        Class::Windows,
    ];

    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Class::Generic => "generic",
            Class::Px32 => "32 px",
            Class::Px8 => "8 px",
            Class::Px2 => "2 px",
            Class::VerticalSliver => "vertical sliver",
            Class::HorizontalSliver => "horizontal sliver",
            Class::ScaleNearZero => "G1 near 0",
            Class::ScaleNearOne => "G1 near 1",
            Class::ScaleOne => "G1 exactly 1",
            Class::SteepShear => "steep shear",
            Class::Ties => "half-pixel ties",
            Class::Windows => "windows",
        }
    }
}

/// Makes random triangles for views of one size.
#[derive(Clone, Debug)]
pub struct Triangles {
    /// Source of randomness.
    pub rng: Rng,
    formats: Formats,
    size: [i64; 2],
}

impl Triangles {
    /// A generator with a seed.
    pub fn new(seed: u64, formats: Formats, width: u32, height: u32) -> Triangles {
        Triangles { rng: Rng::with_seed(seed), formats, size: [width.into(), height.into()] }
    }

    /// A triangle of a class. Its id is 0, its eyes both; it may have no area.
    pub fn triangle(&mut self, class: Class) -> Polygon {
        let primary = self.primary(class);
        let secondary = self.secondary(class, &primary);
        let swap = self.rng.bool();
        let vertices = (0..3).map(|k| self.vertex(primary[k], secondary[k], swap)).collect();
        Polygon { vertices, eyes: Eyes::Both, ..Polygon::default() }
    }

    /// A convex polygon of four to six corners, each corner on an ellipse.
    pub fn convex(&mut self) -> Polygon {
        let corners = self.rng.u32(4..=6);
        let [width, height] = self.size.map(|n| n as f64);
        let centre = [self.uniform(0.0, width), self.uniform(0.0, height)];
        let reach = [self.uniform(4.0, 30.0), self.uniform(4.0, 30.0)];
        let (turn, squeeze) = (self.uniform(0.0, 6.3), self.uniform(0.3, 1.0));
        let vertices = (0..corners).map(|k| {
            let angle = turn + f64::from(k) * core::f64::consts::TAU / f64::from(corners);
            let x = centre[0] + reach[0] * angle.cos();
            let primary = [self.px(x), self.px(centre[1] + reach[1] * angle.sin())];
            self.vertex(primary, self.px(centre[0] + squeeze * (x - centre[0]) + 3.0), false)
        });
        Polygon { vertices: vertices.collect(), ..Polygon::default() }
    }

    fn vertex(&mut self, primary: [i64; 2], secondary: i64, swap: bool) -> Vertex {
        let [left, right] = if swap { [secondary, primary[0]] } else { [primary[0], secondary] };
        let colour = [(); 2].map(|()| {
            let [r, g, b, _] = self.rng.u32(..).to_le_bytes();
            Rgba([r, g, b, 255])
        });
        Vertex {
            x: [left as i32, right as i32],
            y: [primary[1] as i32; 2],
            depth: self.rng.u32(..=DEPTH_MAX),
            colour,
            ..Vertex::default()
        }
    }

    /// Subpixels of a number of pixels.
    fn px(&self, pixels: f64) -> i64 {
        (pixels * self.formats.one_pixel() as f64).round() as i64
    }

    fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.rng.f64()
    }

    fn around(&mut self, centre: [f64; 2], reach: [f64; 2]) -> [i64; 2] {
        [0, 1].map(|n| {
            let offset = self.uniform(-reach[n], reach[n]);
            self.px(centre[n] + offset)
        })
    }

    fn primary(&mut self, class: Class) -> [[i64; 2]; 3] {
        let [width, height] = self.size.map(|n| n as f64);
        let centre = [self.uniform(0.0, width), self.uniform(0.0, height)];
        let reach = match class {
            Class::Px32 | Class::ScaleNearOne | Class::ScaleOne => [16.0; 2],
            Class::Px8 => [4.0; 2],
            Class::Px2 => [1.0; 2],
            Class::VerticalSliver => [self.uniform(0.05, 4.0), 60.0],
            Class::HorizontalSliver => [60.0, self.uniform(0.05, 2.0)],
            Class::ScaleNearZero => [80.0, 12.0],
            Class::SteepShear => [40.0, 3.0],
            Class::Windows => [width.min(100.0), height.min(100.0)],
            Class::Generic | Class::Ties => [width / 3.0, height / 3.0],
        };
        let mut corners = [(); 3].map(|()| self.around(centre, reach));
        if class == Class::Ties {
            // Halves and wholes, so that edges and corners meet pixel centres.
            let half = self.formats.one_pixel() / 2;
            let reach = self.rng.f64() * 12.0 + 2.0;
            corners = [(); 3]
                .map(|()| self.around(centre, [reach; 2]).map(|c| c.div_euclid(half) * half));
        }
        corners
    }

    /// Secondary x of the corners.
    fn secondary(&mut self, class: Class, primary: &[[i64; 2]; 3]) -> [i64; 3] {
        let shift = self.uniform(-8.0, 8.0);
        let (scale, shear) = match class {
            Class::ScaleNearZero => (self.uniform(1.0 / 29.0, 0.15), self.uniform(-0.5, 0.5)),
            Class::ScaleNearOne => (self.uniform(0.97, 1.0), self.uniform(-0.2, 0.2)),
            Class::ScaleOne => (1.0, [-1.0, -0.5, 0.0, 0.25, 1.0, 2.0][self.rng.usize(..6)]),
            Class::SteepShear => (self.uniform(0.2, 1.0), self.uniform(-12.0, 12.0)),
            Class::Ties => (1.0, 0.0),
            _ => (self.uniform(0.1, 1.0), self.uniform(-0.6, 0.6)),
        };
        let half = self.formats.one_pixel() / 2;
        let [x0, y0] = primary[0].map(|c| c as f64);
        let ties = self.rng.i64(-9..9) * half;
        let squeeze = self.rng.bool();
        primary.map(|[x, y]| {
            if class == Class::Ties {
                let x = if squeeze {
                    (x - primary[0][0]).div_euclid(2 * half) * half + primary[0][0]
                } else {
                    x
                };
                return x + ties;
            }
            // Keep shapes sheared about their own corner, or they would leave the window.
            let whole = if class == Class::ScaleOne { shift.round() } else { shift };
            let moved = x0 + scale * (x as f64 - x0) + shear * (y as f64 - y0);
            (moved.round() as i64) + self.px(whole)
        })
    }
}
