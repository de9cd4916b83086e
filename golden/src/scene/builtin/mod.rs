//! The built-in scenes.
//!
//! `teapot`, `room` and `village` are pictures to look at, in centimetres in front of a screen of at
//! least 32 × 24 cm, as are the two of perception; `atoms` is a height field, in inches; `office` is
//! in metres. The others are small and each show one thing; their lengths are pixels of a
//! 640 × 480 picture, scaled with the size, except in `ties`, where they are pixels at any size.

mod diagnostic;
mod edges;
mod empty;
mod mason;
pub mod office;
mod paint;
mod perception;
mod quads;
mod room;
mod shapes;
mod teapot;
mod village;

use super::error::{check_size, SceneError, SIZE_LIMIT};
use super::place::Placement;
use super::{height_field, Scene};

pub use teapot::{teapot, DEFAULT_LEVEL};

/// Name of the height field.
pub const ATOMS: &str = "atoms";

/// A scene made in code.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its line in `wheatstone list`.
    pub description: &'static str,
    build: fn(u32, u32) -> Scene,
}

/// All built-in scenes.
pub const SCENES: [Builtin; 14] = [
    Builtin {
        name: "teapot",
        description: "the Utah teapot, from its 32 patches: 6,320 smooth, glossy triangles",
        build: teapot::scene,
    },
    Builtin {
        name: "room",
        description:
            "a textured room with glossy and mirroring things before and behind the screen",
        build: room::scene,
    },
    Builtin {
        name: "village",
        description:
            "a model village of eight buildings, a church among them: about 1,100 triangles",
        build: village::scene,
    },
    Builtin {
        name: ATOMS,
        description: "atoms on a 200 x 200 height field: 79,202 flat-shaded triangles",
        build: atoms,
    },
    Builtin {
        name: "ramp",
        description:
            "bars from 32 pixels of crossed to 32 of uncrossed disparity, and a floor through both",
        build: diagnostic::ramp,
    },
    Builtin {
        name: "ratio",
        description: "panels turned so that G1 runs from 1 to 1/29, past it, to 0 and below",
        build: diagnostic::ratio,
    },
    Builtin {
        name: "slivers",
        description: "thin triangles, upright, flat and radial, from 4 pixels down to 1/16",
        build: diagnostic::slivers,
    },
    Builtin {
        name: "exclusive",
        description: "wedges and columns with faces that one eye sees and the other does not",
        build: edges::exclusive,
    },
    Builtin {
        name: "ties",
        description: "corners and edges on pixel centres, and surfaces of equal depth",
        build: edges::ties,
    },
    Builtin {
        name: "polygons",
        description: "flat convex polygons of four, five and six corners, turned and tilted",
        build: diagnostic::polygons,
    },
    Builtin {
        name: "windows",
        description:
            "polygons that leave the windows, the guard bands and the near plane on all sides",
        build: edges::windows,
    },
    Builtin {
        name: "office",
        description:
            "fifteen office rooms of 3,652 polygons; office-1 to office-14 have fewer rooms",
        build: |width, height| office::scene(width, height, office::ROOMS),
    },
    Builtin {
        name: "perception-cylinder",
        description:
            "a blue cylinder behind a red one: the right eye sees it, the left one does not",
        build: perception::cylinder,
    },
    Builtin {
        name: "perception-solid",
        description: "a block with a slot, whose end the right eye sees and the left one does not",
        build: perception::solid,
    },
];

/// Makes a built-in scene for views of this size.
pub fn scene(name: &str, width: u32, height: u32) -> Result<Scene, SceneError> {
    check_size(width, height, SIZE_LIMIT)?;
    if let Some(rooms) = office::rooms(name) {
        return Ok(office::scene(width, height, rooms));
    }
    let builtin = SCENES.iter().find(|s| s.name == name).ok_or_else(|| SceneError::Unknown {
        name: name.into(),
        builtin: SCENES.iter().map(|s| s.name).collect(),
    })?;
    Ok((builtin.build)(width, height))
}

/// The height field.
fn atoms(width: u32, height: u32) -> Scene {
    let empty = height_field::empty_scene(width, height);
    height_field::scene(&height_field::atoms(), empty, &Placement::default())
}
