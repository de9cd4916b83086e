//! The projections as matrices for row vectors (NASA 1992, appendices A and B).
//!
//! Their coordinates are right-handed: x right, y up, z behind the viewer, whose eyes are in the
//! plane z = 0. A point (x, y, z, 1) times the matrix gives clip coordinates; divided by the last of
//! them, the window is −1 to 1 across and up, and z is −1 at the near and +1 at the far plane.

use super::map::{DistanceMap, Viewer};
use crate::formats::Eye;

/// A matrix by rows, to be multiplied by row vectors from the left.
pub type Matrix = [[f64; 4]; 4];

/// Parameters of a projection matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectionMatrix {
    /// Eyes and screen.
    pub viewer: Viewer,
    /// Map from distances in the scene to perceived distances.
    pub map: DistanceMap,
    /// NCP, the distance of the near plane in the scene.
    pub near: f64,
    /// FCP, the distance of the far plane in the scene.
    pub far: f64,
    /// W, width of the screen.
    pub width: f64,
    /// H, height of the screen.
    pub height: f64,
}

impl ProjectionMatrix {
    /// ZCT = −(FCP + NCP)/(2 FCP NCP): minus the mean of the planes' inverse distances (NASA 1992,
    /// appendix A, "z-clip translation").
    pub fn z_clip_translation(&self) -> f64 {
        -(self.far + self.near) / (2.0 * self.far * self.near)
    }

    /// ZCS = −2 FCP NCP/(FCP − NCP): makes the inverse distances run from −1 to 1 (NASA 1992, appendix A,
    /// "z-clip scale").
    pub fn z_clip_scale(&self) -> f64 {
        -2.0 * self.far * self.near / (self.far - self.near)
    }

    /// POT or LPOT, VPT or LVPT for an eye.
    fn offsets(&self, eye: Eye) -> [f64; 2] {
        let offsets =
            [self.viewer.projection_offset(&self.map), self.viewer.viewport_offset(&self.map)];
        offsets.map(|offset| if eye == Eye::Left { offset } else { -offset })
    }

    /// The eight steps whose product is the matrix (A1 to A8, B1 to B8).
    pub fn steps(&self, eye: Eye) -> [Matrix; 8] {
        let [pot, vpt] = self.offsets(eye);
        let sd = self.viewer.screen_distance;
        // The division: z and w change places.
        let division = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
        [
            translation([pot, 0.0, 0.0]),
            scaling([1.0, 1.0, -1.0]),
            scaling([sd, sd, 1.0]),
            division,
            translation([0.0, 0.0, self.z_clip_translation()]),
            scaling([1.0, 1.0, self.z_clip_scale()]),
            translation([vpt, 0.0, 0.0]),
            scaling([2.0 / self.width, 2.0 / self.height, 1.0]),
        ]
    }

    /// The matrix (NASA 1992, A9 and B9; errata: row 4).
    pub fn matrix(&self, eye: Eye) -> Matrix {
        let [pot, vpt] = self.offsets(eye);
        let sd = self.viewer.screen_distance;
        let [fovx, fovy] = [2.0 / self.width, 2.0 / self.height];
        let (zct, zcs) = (self.z_clip_translation(), self.z_clip_scale());
        [
            [sd * fovx, 0.0, 0.0, 0.0],
            [0.0, sd * fovy, 0.0, 0.0],
            [-vpt * fovx, 0.0, -zct * zcs, -1.0],
            [pot * sd * fovx, 0.0, zcs, 0.0],
        ]
    }

    /// The point (x, y) at distance d', projected without a matrix: across, up and z as above.
    pub fn point(&self, [x, y, distance]: [f64; 3], eye: Eye) -> [f64; 3] {
        let [pot, vpt] = self.offsets(eye);
        let sd = self.viewer.screen_distance;
        let across = sd * (x + pot) / distance + vpt;
        let up = sd * y / distance;
        let z = (1.0 / distance + self.z_clip_translation()) * self.z_clip_scale();
        [2.0 * across / self.width, 2.0 * up / self.height, z]
    }
}

fn scaling([x, y, z]: [f64; 3]) -> Matrix {
    [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

fn translation([x, y, z]: [f64; 3]) -> Matrix {
    let [unit_x, unit_y, unit_z, _] = scaling([1.0; 3]);
    [unit_x, unit_y, unit_z, [x, y, z, 1.0]]
}

/// The matrix that does first what `a` and then what `b` does.
pub fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    let cell = |row: usize, column: usize| (0..4).map(|k| a[row][k] * b[k][column]).sum();
    core::array::from_fn(|row| core::array::from_fn(|column| cell(row, column)))
}

/// A point times a matrix, divided by its last coordinate.
pub fn transform([x, y, z]: [f64; 3], matrix: &Matrix) -> [f64; 3] {
    let [x, y, z, w] = core::array::from_fn(|column| {
        x * matrix[0][column] + y * matrix[1][column] + z * matrix[2][column] + matrix[3][column]
    });
    [x / w, y / w, z / w]
}
