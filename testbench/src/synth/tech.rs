//! Technologies and the figures that are measured on them.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The technology that a target is synthesised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tech {
    /// NAND2-equivalent gates in two libraries.
    Gates,
    /// Lattice iCE40 HX8K.
    Ice40,
    /// Lattice ECP5-45, speed grade 6.
    Ecp5,
}

impl Tech {
    /// All of them, in the order of tables.
    pub const ALL: [Tech; 3] = [Tech::Gates, Tech::Ice40, Tech::Ecp5];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Tech::Gates => "gates",
            Tech::Ice40 => "ice40",
            Tech::Ecp5 => "ecp5",
        }
    }

    /// Its figures, in the order of tables.
    pub fn figures(self) -> &'static [Figure] {
        match self {
            Tech::Gates => &[Figure::Osu035, Figure::Primitive],
            Tech::Ice40 | Tech::Ecp5 => {
                &[Figure::Luts, Figure::FlipFlops, Figure::Dsps, Figure::Memories, Figure::Fmax]
            }
        }
    }
}

/// A measured quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// NAND2 equivalents in the OSU 0.35 µm standard cells: cell area over the area of NAND2X1.
    Osu035,
    /// NAND2 equivalents in `synth/primitive.lib`.
    Primitive,
    /// Look-up tables of four inputs, those of carry chains included.
    Luts,
    /// Flip-flops.
    FlipFlops,
    /// Multipliers.
    Dsps,
    /// Memory blocks and, on ECP5, distributed memories of 16 times 4 bits.
    Memories,
    /// Highest clock in MHz: the median of three placements.
    Fmax,
}

impl Figure {
    /// Heading in a table.
    pub fn heading(self) -> &'static str {
        match self {
            Figure::Osu035 => "OSU 0.35 µm",
            Figure::Primitive => "INV, NAND2, NOR2",
            Figure::Luts => "LUT4",
            Figure::FlipFlops => "flip-flops",
            Figure::Dsps => "DSPs",
            Figure::Memories => "memories",
            Figure::Fmax => "MHz",
        }
    }
}

/// The measured figures; none where the target does not fit on the chip.
pub type Figures = BTreeMap<Figure, f64>;
