//! Geometry of a scene, as drawing receives it, and the choices in making it.

use crate::formats::Rgba;
use crate::frame::Scissor;
use crate::setup::Polygon;
use crate::texture::Texture;
use std::fmt;

/// Which faces are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// For each eye the ones it sees clockwise.
    Back,
}

/// Choices in making geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Which faces are left out.
    pub cull: Cull,
    /// Difference between the eyes' colours of a corner, in any channel of 0 to 255, above which
    /// a polygon counts as [`Polygon::specular`].
    pub specular_threshold: u8,
}

impl Default for Options {
    /// Nothing is left out; a difference of 3 or more shows as a seam between smooth polygons.
    fn default() -> Options {
        Options { cull: Cull::None, specular_threshold: 2 }
    }
}

/// Fates of the triangles and faces of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangles in the meshes.
    pub triangles: usize,
    /// Polygons in the meshes.
    pub faces: usize,
    /// Polygons made.
    pub polygons: usize,
    /// Triangles and faces cut at the near or far plane of a partition, or above or below the guard
    /// band; one that crosses partitions counts in each.
    pub clipped: usize,
    /// Triangles and faces cut for each eye alone, because they leave the guard band.
    pub guard_band: usize,
    /// Triangles and faces culled for both eyes.
    pub culled: usize,
    /// Triangles and faces culled for one eye.
    pub half_culled: usize,
    /// Triangles and faces behind the eyes.
    pub behind: usize,
    /// Triangles and faces before the eyes, but nearer than what the rig draws.
    pub nearer: usize,
    /// Triangles and faces farther than what the rig draws.
    pub farther: usize,
    /// Triangles and faces at distances that no partition of a piecewise projection draws.
    pub between: usize,
    /// Triangles, faces and pieces of them beside, above or below the windows.
    pub outside: usize,
    /// Triangles, faces and pieces of them without area.
    pub empty: usize,
    /// Id of the first of those.
    pub first_empty: Option<u32>,
    /// Triangles, faces and pieces of them that have an area, but none as the eyes see them: edge-on,
    /// or too thin.
    pub edge_on: usize,
    /// Triangles, faces and pieces of them that are no larger than a subpixel.
    pub small: usize,
    /// Triangles, faces and pieces of them that are fully transparent.
    pub invisible: usize,
}

impl Counts {
    /// Number of polygons left out for each reason, and what helps against it.
    fn reasons(&self) -> [(usize, String, &'static str); 10] {
        const MOVE: &str = "move it, or change near and far, with a rig file";
        let empty = match self.first_empty {
            Some(id) => format!("without area (polygon {id} is the first)"),
            None => "without area".into(),
        };
        [
            (self.empty, empty, "give it corners that do not lie on a line"),
            (self.edge_on, "seen edge-on".into(), "turn it with a rig file"),
            (self.small, "smaller than a subpixel".into(), "enlarge it with a rig file"),
            (
                self.invisible,
                "fully transparent".into(),
                "give its material a d above 0, or a picture that is not transparent all over",
            ),
            (self.behind, "behind the eyes".into(), MOVE),
            (self.nearer, "nearer than the rig's near plane".into(), MOVE),
            (self.farther, "farther than the rig's far plane".into(), MOVE),
            (self.between, "at distances of no partition".into(), MOVE),
            (self.outside, "outside the views".into(), "move it, or fit it, with a rig file"),
            (self.culled, "culled for both eyes".into(), "leave out --cull back"),
        ]
    }

    /// The reason why nothing is drawn, and what helps against the reason that most polygons have; none if something
    /// is.
    pub fn nothing(&self) -> Option<String> {
        if self.polygons > 0 {
            return None;
        }
        let reasons = self.reasons();
        let (_, _, help) = reasons.iter().rev().max_by_key(|(count, ..)| *count)?;
        let whole = self.triangles + self.faces;
        if whole == 0 {
            return Some("there is no triangle and no face".into());
        }
        Some(format!("{self}; try: {help}"))
    }
}

impl fmt::Display for Counts {
    /// The numbers of polygons that are not drawn, with the reasons; empty if all are.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts: Vec<String> = Vec::new();
        let half = (self.half_culled, "culled for one eye".to_owned(), "");
        for (count, reason, _) in self.reasons().into_iter().chain([half]) {
            if count > 0 {
                parts.push(format!("{count} {reason}"));
            }
        }
        f.write_str(&parts.join(", "))
    }
}

/// Polygons for setup.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// Width of each view in pixels.
    pub width: u32,
    /// Height of each view in pixels.
    pub height: u32,
    /// Colour where nothing is drawn.
    pub background: Rgba,
    /// The polygons in the order to draw them: opaque ones by id, then the others, the farthest
    /// first.
    pub polygons: Vec<Polygon>,
    /// The textures that polygons refer to.
    pub textures: Vec<Texture>,
    /// Columns of each view that are drawn.
    pub scissor: Scissor,
    /// Fates of the triangles and faces.
    pub counts: Counts,
}
