//! Placing meshes and height fields in a scene.

use super::vector::{add, cross, dot, rotate, scale, sub, unit, Vec3};
use super::Scene;
use serde::{Deserialize, Deserializer};

/// Longest side of a placed mesh, in smaller sides of the screen, where nothing else is said.
const FIT: f64 = 0.8;

/// Orientation, size and position of a mesh or a height field.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Placement {
    /// Degrees about its x, y and z axes; y comes first, then x, then z.
    pub rotation: [f64; 3],
    /// From where it is seen, after that.
    pub view: Option<Viewpoint>,
    /// Longest side of the bounding box, in smaller sides of the screen ([`FIT`] where nothing is
    /// said); `Some(None)` leaves it where it is.
    #[serde(deserialize_with = "given")]
    pub fit: Option<Option<f64>>,
    /// Movement after fitting.
    pub offset: Vec3,
    /// Difference between the highest and the lowest point of a height field, in longer sides of
    /// it; none leaves the heights as they are.
    pub relief: Option<f64>,
}

/// Tells `null` from a field that is not there.
fn given<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Option<f64>>, D::Error> {
    Option::deserialize(value).map(Some)
}

impl Default for Placement {
    fn default() -> Placement {
        Placement { rotation: [0.0; 3], view: None, fit: None, offset: [0.0; 3], relief: Some(0.1) }
    }
}

/// From where something is looked at, towards the origin of its own, right-handed coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Viewpoint {
    /// A point on the line from the origin to the viewer.
    pub eye: Vec3,
    /// The direction that is upright for the viewer.
    pub up: Vec3,
}

impl Viewpoint {
    /// Directions of the viewer's x, y and z axes: right, up and backward.
    ///
    /// These are the rows of the rotation in a viewing matrix (Duvanenko & Robbins 1993, "Viewing
    /// Transformation", Listing Two), without its three angles, of which the first is undefined for
    /// an eye on the y axis. None where there is no line of sight, or `up` lies along it.
    pub fn axes(&self) -> Option<[Vec3; 3]> {
        let backward = unit(self.eye);
        let right = cross(unit(self.up), backward);
        // The sine of the angle between the two; less is mostly rounding.
        if dot(right, right) < 1e-18 {
            return None;
        }
        let right = unit(right);
        Some([right, cross(backward, right), backward])
    }
}

impl Placement {
    /// A point or direction turned as the placement says; before and after its z points away
    /// from the viewer, other than in its own coordinates.
    pub fn turn(&self, p: Vec3) -> Vec3 {
        // Mirrored in z, a turn about x or y goes the other way.
        let [x, y, z] = self.rotation;
        let p = rotate(rotate(rotate(p, 1, -y), 0, -x), 2, z);
        self.view.and_then(|view| view.axes()).map_or(p, |axes| {
            let [right, up, backward] = axes.map(|axis| dot(axis, [p[0], p[1], -p[2]]));
            [right, up, -backward]
        })
    }
}

/// Turns, centres, scales and moves the meshes of a scene.
pub fn place(scene: &mut Scene, placement: &Placement) {
    let turned = |p| placement.turn(p);
    scene.meshes.iter_mut().for_each(|mesh| mesh.transform(turned, turned));
    let mut least = [f64::MAX; 3];
    let mut most = [f64::MIN; 3];
    for position in scene.meshes.iter().flat_map(|mesh| &mesh.positions) {
        least = std::array::from_fn(|k| least[k].min(position[k]));
        most = std::array::from_fn(|k| most[k].max(position[k]));
    }
    let Some(fit) = placement.fit.unwrap_or(Some(FIT)) else {
        let moved = |p: Vec3| add(p, placement.offset);
        return scene.meshes.iter_mut().for_each(|mesh| mesh.transform(moved, |n| n));
    };
    let centre = scale(add(least, most), 0.5);
    let longest = sub(most, least).into_iter().fold(0.0, f64::max);
    let screen = f64::from(scene.width.min(scene.height)) / scene.rig.pixels_per_unit;
    // A mesh that is one point stays one.
    let factor = if longest > 1e-100 { fit * screen / longest } else { 1.0 };
    let moved = |p: Vec3| add(scale(sub(p, centre), factor), placement.offset);
    scene.meshes.iter_mut().for_each(|mesh| mesh.transform(moved, |n| n));
}
