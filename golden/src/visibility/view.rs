//! One view of a scene as a linear map, from where the rig puts an eye or from where a viewer has
//! walked to.

use crate::formats::{Eye, DEPTH_MAX};
use crate::scene::vector::{add, cross, dot, rotate, scale, sub, Vec3};
use crate::scene::{HalfSpace, Rig, Scene};

/// Position and direction of a viewer, relative to the place that the rig gives the viewer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Movement of the viewer, in units of the scene.
    pub moved: Vec3,
    /// Turn of the viewer to the right, in degrees.
    pub turned: f64,
}

/// A view by two centres of projection (Heo, Jung and Wohn 1998, equation 1; see errata): a point p is
/// seen at the pixel (X/W, Y/W), where X, Y and W are affine in p and W is the distance from the plane
/// of the eyes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Factors of x, y, z and 1 in X, Y and W.
    rows: [[f64; 4]; 3],
    /// W of the near plane, and 1/W.
    near: [f64; 2],
    /// Depth for a unit of 1/W.
    depth_scale: f64,
}

impl View {
    /// The view of an eye of the scene's rig.
    pub fn of(scene: &Scene, eye: Eye) -> View {
        View::from(scene, scene.rig.eye(eye))
    }

    /// The view of a single eye between the two.
    pub fn between(scene: &Scene) -> View {
        View::from(scene, scene.rig.middle())
    }

    /// The line from the eye (a, b, −d) to (x, y, z) meets the screen at a + (x − a)·d/(z + d) =
    /// (x·d + a·z)/(z + d), and so for y.
    fn from(scene: &Scene, [a, b, _]: Vec3) -> View {
        let Rig { pixels_per_unit: ppu, viewing_distance: d, .. } = scene.rig;
        let [half_width, half_height] = [scene.width, scene.height].map(|n| f64::from(n) / 2.0);
        let (near, far) = (scene.rig.near(), scene.rig.far());
        View {
            size: [scene.width, scene.height],
            rows: [
                [ppu * d, 0.0, half_width + ppu * a, half_width * d],
                [0.0, -ppu * d, half_height - ppu * b, half_height * d],
                [0.0, 0.0, 1.0, d],
            ],
            near: [near, 1.0 / near],
            depth_scale: f64::from(DEPTH_MAX) / (1.0 / near - 1.0 / far),
        }
    }

    /// The same eye after the viewer of a rig has moved and turned about the middle of the head.
    pub fn at(&self, pose: &Pose, rig: &Rig) -> View {
        let seen = |p: Vec3| {
            let from_head = sub(p, add(rig.middle(), pose.moved));
            add(rotate(from_head, 1, -pose.turned), rig.middle())
        };
        let origin = seen([0.0; 3]);
        let axes =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| sub(seen(axis), origin));
        let linear = |row: &[f64; 4], v: Vec3| dot([row[0], row[1], row[2]], v);
        let rows = self.rows.map(|row| {
            let [x, y, z] = axes.map(|axis| linear(&row, axis));
            [x, y, z, linear(&row, origin) + row[3]]
        });
        View { rows, ..*self }
    }

    /// X, Y and W of a point.
    #[inline]
    pub fn homogeneous(&self, [x, y, z]: Vec3) -> [f64; 3] {
        self.rows.map(|row| row[0] * x + row[1] * y + row[2] * z + row[3])
    }

    /// Depth at a distance: 24 bits, affine in 1/W, 0 at the near plane.
    #[inline]
    pub fn depth(&self, distance: f64) -> u32 {
        self.depth_of_inverse(1.0 / distance)
    }

    /// Depth where 1/W is `inverse`.
    #[inline]
    pub fn depth_of_inverse(&self, inverse: f64) -> u32 {
        ((self.near[1] - inverse) * self.depth_scale + 0.5).clamp(0.0, DEPTH_MAX.into()) as u32
    }

    /// 1/W at a depth.
    #[inline]
    pub fn inverse_distance(&self, depth: u32) -> f64 {
        self.near[1] - f64::from(depth) / self.depth_scale
    }

    /// W of the near plane.
    pub fn near(&self) -> f64 {
        self.near[0]
    }

    /// Behind the near plane, and within a band of so many pixels around the window.
    pub fn planes(&self, band: f64) -> [HalfSpace; 5] {
        let [x, y, w] = self.rows;
        let [width, height] = self.size.map(|n| f64::from(n) + band);
        let plane = |of: [f64; 4], k: f64, limit: f64, near: f64| {
            let sum: [f64; 4] = core::array::from_fn(|n| k * of[n] + limit * w[n]);
            HalfSpace { normal: [sum[0], sum[1], sum[2]], offset: sum[3] - near }
        };
        [
            plane(w, 0.0, 1.0, self.near()),
            plane(x, 1.0, band, 0.0),
            plane(x, -1.0, width, 0.0),
            plane(y, 1.0, band, 0.0),
            plane(y, -1.0, height, 0.0),
        ]
    }

    /// The map from the pixels of this view to those of another.
    pub fn onto(&self, other: &View) -> Reprojection {
        // p = A⁻¹ (X, Y, W) − A⁻¹ t, with A the factors of p and t the constant parts.
        let [r0, r1, r2] = self.rows.map(|row| [row[0], row[1], row[2]]);
        let [c0, c1, c2] = [cross(r1, r2), cross(r2, r0), cross(r0, r1)];
        let inverse = [c0, c1, c2].map(|column| scale(column, 1.0 / dot(r0, c0)));
        let rows = other.rows.map(|row| {
            let [x, y, w] = inverse.map(|column| dot([row[0], row[1], row[2]], column));
            let [t0, t1, t2] = self.rows.map(|own| own[3]);
            [x, y, w, row[3] - dot([x, y, w], [t0, t1, t2])]
        });
        Reprojection { rows }
    }
}

/// Map from the pixels of one view to the places of the same points in another view.
///
/// With i = 1/W, the other view's X, Y and W are those of the pixel (x, y, 1, i), times W.
#[derive(Clone, Copy, Debug)]
pub struct Reprojection {
    rows: [[f64; 4]; 3],
}

impl Reprojection {
    /// x and y in pixels and 1/W in the other view of what is seen at (x, y) with 1/W = i; none
    /// if it is not in front of the other viewer.
    #[inline]
    pub fn at(&self, x: f64, y: f64, i: f64) -> Option<[f64; 3]> {
        let [across, down, w] = self.rows.map(|row| row[0] * x + row[1] * y + row[2] + row[3] * i);
        (w > 0.0).then(|| [across / w, down / w, i / w])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;
    use crate::formats::Formats;
    use crate::scene::{builtin, Camera};

    fn points() -> impl Iterator<Item = Vec3> {
        let mut random = fastrand::Rng::with_seed(3);
        (0..1000).map(move |_| {
            [random.f64() * 8.0 - 4.0, random.f64() * 3.0 - 1.5, random.f64() * 100.0 - 3.0]
        })
    }

    fn pixel(view: &View, p: Vec3) -> [f64; 3] {
        let [x, y, w] = view.homogeneous(p);
        [x / w, y / w, w]
    }

    #[test]
    fn eyes_see_what_the_camera_shows() {
        let scene = builtin::scene("office-1", 300, 300).expect("there is one");
        let camera = Camera::new(&scene.rig, 300, 300, &Formats::new(&Config::DEFAULT));
        for eye in Eye::BOTH {
            let view = View::of(&scene, eye);
            for p in points() {
                let ([x, y, w], [u, v]) = (pixel(&view, p), camera.pixel(p, eye));
                assert!((x - u).abs() < 1e-9 && (y - v).abs() < 1e-9, "{p:?}");
                assert!(view.depth(w).abs_diff(camera.depth(p)) <= 1);
                let back = view.inverse_distance(view.depth(w));
                assert!((back - 1.0 / w).abs() < 2e-6, "{back} {w}");
            }
        }
    }

    #[test]
    fn a_viewer_who_moves_sees_the_scene_move_the_other_way() {
        let scene = builtin::scene("office-1", 300, 300).expect("there is one");
        let view = View::between(&scene);
        let ahead = view.at(&Pose { moved: [0.5, 0.0, 2.0], turned: 0.0 }, &scene.rig);
        let turned = view.at(&Pose { moved: [0.0; 3], turned: 90.0 }, &scene.rig);
        for p in points() {
            let moved = sub(p, [0.5, 0.0, 2.0]);
            assert!(sub(pixel(&ahead, p), pixel(&view, moved)).iter().all(|n| n.abs() < 1e-9));
        }
        // To the right of the head, which is 4 units before the screen: straight ahead after a turn.
        let [x, y, w] = pixel(&turned, [7.0, 0.0, -4.0]);
        assert!((x - 150.0).abs() < 1e-9 && (y - 150.0).abs() < 1e-9 && (w - 7.0).abs() < 1e-9);
    }

    #[test]
    fn reprojection_is_projection_from_elsewhere() {
        let scene = builtin::scene("office-1", 300, 300).expect("there is one");
        let from = View::between(&scene);
        let to = from.at(&Pose { moved: [-0.2, 0.1, 0.4], turned: 3.0 }, &scene.rig);
        let map = from.onto(&to);
        for p in points().filter(|p| p[2] > 0.0) {
            let ([x, y, w], [u, v, w2]) = (pixel(&from, p), pixel(&to, p));
            let [a, b, i] = map.at(x, y, 1.0 / w).expect("in front of both");
            assert!((a - u).abs() < 1e-6 && (b - v).abs() < 1e-6 && (i * w2 - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn planes_bound_the_window() {
        let scene = builtin::scene("office-1", 300, 200).expect("there is one");
        let view = View::of(&scene, Eye::Left);
        for p in points() {
            let [x, y, w] = pixel(&view, p);
            let inside =
                w >= view.near() && (-10.0..=310.0).contains(&x) && (-10.0..=210.0).contains(&y);
            let distances = view.planes(10.0).map(|plane| plane.at(p));
            assert_eq!(distances.iter().all(|&n| n >= 0.0), inside, "{p:?} {distances:?}");
        }
    }
}
