//! Walls, roofs and cones, each polygon painted at its corners.

use crate::scene::vector::{add, cross, outward, rotate, scale, sub, turn, unit, Vec3};
use crate::scene::{Colours, Mesh};

/// Red, green and blue of a corner.
pub type Paint = [u8; 3];

/// A paint made darker or lighter.
pub fn toned(paint: Paint, factor: f64) -> Paint {
    paint.map(|n| (f64::from(n) * factor).min(255.0) as u8)
}

/// Puts up polygons where it stands, turned about the vertical.
#[derive(Default)]
pub struct Mason {
    mesh: Mesh,
    paint: Vec<Paint>,
    at: Vec3,
    yaw: f64,
}

impl Mason {
    /// Goes to a place and turns by an angle in degrees; what follows is built there.
    pub fn stand(&mut self, at: Vec3, yaw: f64) {
        (self.at, self.yaw) = (at, yaw);
    }

    /// The mesh that was built.
    pub fn finish(self) -> Mesh {
        Mesh { colours: Colours::Vertex(self.paint), ..self.mesh }
    }

    /// A flat convex polygon, counter-clockwise as seen from outside. Paints repeat.
    pub fn polygon(&mut self, corners: &[Vec3], paints: &[Paint]) {
        let normal = unit(outward(corners[0], corners[1], corners[2]));
        self.curved(corners, &vec![normal; corners.len()], paints);
    }

    /// A polygon with a normal for each corner.
    fn curved(&mut self, corners: &[Vec3], normals: &[Vec3], paints: &[Paint]) {
        let first = self.mesh.positions.len() as u32;
        for (n, (&corner, &normal)) in corners.iter().zip(normals).enumerate() {
            self.mesh.positions.push(add(rotate(corner, 1, self.yaw), self.at));
            self.mesh.normals.push(rotate(normal, 1, self.yaw));
            self.paint.push(paints[n % paints.len()]);
        }
        for n in 1..corners.len() as u32 - 1 {
            self.mesh.triangles.push([first, first + n, first + n + 1]);
        }
    }

    /// An upright box without a bottom between two corners.
    pub fn block(&mut self, low: Vec3, high: Vec3, paint: Paint) {
        for wall in Wall::around([low[0], low[2]], [high[0], high[2]], low[1]) {
            let size = [wall.length, high[1] - low[1]];
            wall.panel(self, [0.0, 0.0], size, 0.0, [toned(paint, 0.78), paint]);
        }
        let top = |x: f64, z: f64| [x, high[1], z];
        let corners = [
            top(low[0], low[2]),
            top(high[0], low[2]),
            top(high[0], high[2]),
            top(low[0], high[2]),
        ];
        self.polygon(&corners, &[paint]);
    }

    /// A pyramid, or a cone if it is to look round, without a base.
    pub fn cone(
        &mut self,
        base: Vec3,
        radius: f64,
        height: f64,
        sides: u32,
        round: bool,
        paint: Paint,
    ) {
        let direction = |k: f64| turn((k + 0.5) / f64::from(sides));
        let foot = |k: f64| {
            let [x, z] = direction(k);
            add(base, scale([x, 0.0, z], radius))
        };
        let normal = |k: f64| {
            let [x, z] = direction(k);
            unit([height * x, radius, height * z])
        };
        let apex = add(base, [0.0, height, 0.0]);
        let dark = toned(paint, 0.62);
        for side in 0..sides {
            let (k, middle) = (f64::from(side), normal(f64::from(side) + 0.5));
            let corners = [foot(k), foot(k + 1.0), apex];
            let normals = if round { [normal(k), normal(k + 1.0), middle] } else { [middle; 3] };
            self.curved(&corners, &normals, &[dark, dark, paint]);
        }
    }

    /// Two slabs over a ground plan, given by two corners (x, z), that meet in a ridge along x at
    /// `rise` above `height` and overhang all round.
    pub fn saddle_roof(&mut self, plan: [[f64; 2]; 2], height: f64, rise: f64, paint: Paint) {
        const OVERHANG: f64 = 0.45;
        const THICKNESS: f64 = 0.22;
        let [[x0, z0], [x1, z1]] = plan;
        let (left, right) = (x0 - OVERHANG, x1 + OVERHANG);
        let (ridge, half) = ((z0 + z1) / 2.0, (z1 - z0) / 2.0);
        let dark = toned(paint, 0.72);
        for side in [-1.0, 1.0] {
            // A little lower than the walls, so that these end inside the slab.
            let low = |x: f64, part: f64| {
                let out = (half + OVERHANG) * part;
                [x, height - 0.06 + rise * (1.0 - out / half), ridge + side * out]
            };
            let high = |x: f64, part: f64| add(low(x, part), [0.0, THICKNESS, 0.0]);
            // As seen from this side of the house.
            let (l, r) = if side < 0.0 { (left, right) } else { (right, left) };
            self.polygon(
                &[high(l, 1.0), high(r, 1.0), high(r, 0.0), high(l, 0.0)],
                &[dark, dark, paint, paint],
            );
            self.polygon(&[low(l, 0.0), low(r, 0.0), low(r, 1.0), low(l, 1.0)], &[dark]);
            self.polygon(&[low(l, 1.0), low(r, 1.0), high(r, 1.0), high(l, 1.0)], &[paint]);
            self.polygon(&[low(r, 1.0), low(r, 0.0), high(r, 0.0), high(r, 1.0)], &[paint]);
            self.polygon(&[low(l, 0.0), low(l, 1.0), high(l, 1.0), high(l, 0.0)], &[paint]);
        }
    }
}

/// The outside of a wall.
pub struct Wall {
    origin: Vec3,
    right: Vec3,
    out: Vec3,
    /// Its length along the ground.
    pub length: f64,
}

impl Wall {
    /// Front, right, back and left wall between two corners (x, z) of a ground plan at height `y`.
    pub fn around(low: [f64; 2], high: [f64; 2], y: f64) -> [Wall; 4] {
        let ([x0, z0], [x1, z1]) = (low, high);
        let between = |[x, z]: [f64; 2], to: [f64; 2]| {
            let along = sub([to[0], y, to[1]], [x, y, z]);
            let right = unit(along);
            let length = along[0].abs() + along[2].abs();
            Wall { origin: [x, y, z], right, out: cross([0.0, 1.0, 0.0], right), length }
        };
        [
            between([x0, z0], [x1, z0]),
            between([x1, z0], [x1, z1]),
            between([x1, z1], [x0, z1]),
            between([x0, z1], [x0, z0]),
        ]
    }

    /// The point `u` to the right along the wall, `v` up and `out` before it.
    pub fn at(&self, u: f64, v: f64, out: f64) -> Vec3 {
        add(add(self.origin, scale(self.right, u)), add([0.0, v, 0.0], scale(self.out, out)))
    }

    /// A rectangle between two points (u, v), painted at its lower and its upper edge.
    pub fn panel(
        &self,
        mason: &mut Mason,
        low: [f64; 2],
        high: [f64; 2],
        out: f64,
        paints: [Paint; 2],
    ) {
        let at = |u: f64, v: f64| self.at(u, v, out);
        let corners =
            [at(low[0], low[1]), at(high[0], low[1]), at(high[0], high[1]), at(low[0], high[1])];
        mason.polygon(&corners, &[paints[0], paints[0], paints[1], paints[1]]);
    }

    /// The triangle above the wall, under a roof.
    pub fn gable(&self, mason: &mut Mason, height: f64, rise: f64, paint: Paint) {
        let corners = [
            self.at(0.0, height, 0.0),
            self.at(self.length, height, 0.0),
            self.at(self.length / 2.0, height + rise, 0.0),
        ];
        mason.polygon(&corners, &[paint]);
    }
}
