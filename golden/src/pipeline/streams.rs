//! The streams of the complete systems, and the codes in them.

use crate::beat;
use crate::formats::*;
use crate::interface::{Bits, Field, Kind};

/// Effect of a beat on the secondary state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Op {
    /// First pixel of a polygon or of a part of it: state is loaded from the setup.
    #[default]
    Load = 0,
    /// One pixel to the right.
    Step = 1,
    /// Next scan line, from the saved row start.
    Row = 2,
    /// Not a legal beat: draws nothing and raises the error flag.
    Reserved = 3,
}

impl Op {
    /// Names, by code.
    pub const NAMES: [&'static str; 4] = ["LOAD", "STEP", "ROW", "RESERVED"];
    const ALL: [Op; 4] = [Op::Load, Op::Step, Op::Row, Op::Reserved];
}

impl Bits for Op {
    fn to_bits(self) -> u64 {
        self as u64
    }
    fn from_bits(bits: u64) -> Op {
        Op::ALL[bits as usize & 3]
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        Field { name, bits: 2, kind: Kind::Code(&Op::NAMES), doc }
    }
}

/// Which eyes a polygon is drawn for, and by which pipeline: a 3-bit code, 0 to 3 are legal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mode(pub u8);

impl Mode {
    /// Names of the legal codes.
    pub const NAMES: [&'static str; 4] =
        ["MONO_LEFT", "MONO_RIGHT", "LEFT_TO_RIGHT", "RIGHT_TO_LEFT"];

    /// Drawn for one eye, by the primary pipeline.
    pub fn monocular(eye: Eye) -> Mode {
        Mode(eye as u8)
    }

    /// Drawn for both eyes, the secondary derived from this primary.
    pub fn binocular(primary: Eye) -> Mode {
        Mode(2 + primary as u8)
    }

    /// True if the code is one of the four.
    pub fn is_legal(self) -> bool {
        self.0 < 4
    }

    /// True if a secondary is derived.
    pub fn is_binocular(self) -> bool {
        self.0 & 2 != 0
    }

    /// The eye that the primary pipeline draws for.
    pub fn primary(self) -> Eye {
        Eye::BOTH[usize::from(self.0 & 1)]
    }
}

impl Bits for Mode {
    fn to_bits(self) -> u64 {
        self.0.into()
    }
    fn from_bits(bits: u64) -> Mode {
        Mode(bits as u8 & 7)
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        Field { name, bits: 3, kind: Kind::Code(&Mode::NAMES), doc }
    }
}

beat! {
    /// One polygon, or a part of one, for the coordinate interpolators: stream `setup`.
    pub struct Setup {
        /// eyes and direction of derivation
        mode: Mode,
        /// monocular only: the three edge interpolators test further edges of the primary polygon
        lend: bool,
        /// colour of a secondary pixel: average of its primary pixels (1) or the nearest one (0)
        average: bool,
        /// colour from the colour planes (needs INTEGRATED)
        planes: bool,
        /// secondary x of the first pixel's centre
        x_start: SecondaryX,
        /// G1: movement of the secondary x for one primary pixel
        x_step: Scale,
        /// row shear: movement of the secondary x from row start to row start
        x_row: SecondaryX,
        /// display row of the first scan line; with TILT the display row of view row 0
        y_start: Coordinate,
        /// display rows from one scan line to the next
        y_step: DisplayStep,
        /// exchange x and y on the display
        swap: bool,
        /// count display x from the right
        mirror: bool,
        /// secondary y of the first pixel's centre (TILT)
        y_view: SecondaryX,
        /// movement of the secondary y for one primary pixel (TILT)
        y_slant: Slant,
        /// movement of the secondary y from row start to row start (TILT)
        y_row: SecondaryX,
    }
}

beat! {
    /// The interpolants at whole secondary pixels of one polygon or part: stream `edges`.
    ///
    /// `row` holds the movement for one scan line down and the whole-pixel part of the row shear.
    pub struct Edges {
        /// edge 0 at the first pixel
        e0_start: EdgeValue,
        /// edge 0, one pixel to the right
        e0_a: Slope,
        /// edge 0, one pixel down (ANTIALIAS or TILT)
        e0_b: Slope,
        /// edge 0, from row start to row start
        e0_row: EdgeValue,
        /// edge 0, dropped bits (ANTIALIAS)
        e0_low: LowBits,
        /// edge 1 at the first pixel
        e1_start: EdgeValue,
        /// edge 1, one pixel to the right
        e1_a: Slope,
        /// edge 1, one pixel down (ANTIALIAS or TILT)
        e1_b: Slope,
        /// edge 1, from row start to row start
        e1_row: EdgeValue,
        /// edge 1, dropped bits (ANTIALIAS)
        e1_low: LowBits,
        /// edge 2 at the first pixel
        e2_start: EdgeValue,
        /// edge 2, one pixel to the right
        e2_a: Slope,
        /// edge 2, one pixel down (ANTIALIAS or TILT)
        e2_b: Slope,
        /// edge 2, from row start to row start
        e2_row: EdgeValue,
        /// edge 2, dropped bits (ANTIALIAS)
        e2_low: LowBits,
        /// depth at the first pixel, half a unit added (DEPTH_INTERPOLATED)
        z_start: DepthPlane,
        /// depth, one pixel to the right
        z_a: DepthPlane,
        /// depth, one pixel down (TILT)
        z_b: DepthPlane,
        /// depth, from row start to row start
        z_row: DepthPlane,
        /// red at the first pixel, half a unit added (INTEGRATED)
        red_start: ColourPlane,
        /// red, one pixel to the right
        red_a: ColourPlane,
        /// red, one pixel down (TILT)
        red_b: ColourPlane,
        /// red, from row start to row start
        red_row: ColourPlane,
        /// green at the first pixel, half a unit added (INTEGRATED)
        green_start: ColourPlane,
        /// green, one pixel to the right
        green_a: ColourPlane,
        /// green, one pixel down (TILT)
        green_b: ColourPlane,
        /// green, from row start to row start
        green_row: ColourPlane,
        /// blue at the first pixel, half a unit added (INTEGRATED)
        blue_start: ColourPlane,
        /// blue, one pixel to the right
        blue_a: ColourPlane,
        /// blue, one pixel down (TILT)
        blue_b: ColourPlane,
        /// blue, from row start to row start
        blue_row: ColourPlane,
    }
}

beat! {
    /// One polygon, or a part of one, for the traversal of the primary pipeline: stream `walk`.
    ///
    /// From one row to the next the row start moves by `x_row` pixels, or by one more.
    pub struct Walk {
        /// no part of the polygon follows
        last: bool,
        /// the one pixel more is a beat of its own, which the secondary pipeline can follow
        creep: bool,
        /// scan lines after the first
        rows: Coordinate,
        /// first pixel of the first scan line
        x: PixelX,
        /// least movement of the row start from one scan line to the next
        x_row: PixelX,
        /// no row begins left of this column
        left: PixelX,
        /// no row goes on right of this column
        right: PixelX,
        /// display row of the first scan line
        y: Coordinate,
        /// display rows from one scan line to the next
        y_step: DisplayStep,
        /// exchange x and y on the display
        swap: bool,
        /// count display x from the right
        mirror: bool,
        /// edge 0 at the first pixel, its bound subtracted
        e0_start: EdgeValue,
        /// edge 0, one pixel to the right
        e0_a: Slope,
        /// edge 0, one pixel down (ANTIALIAS)
        e0_b: Slope,
        /// edge 0, from row start to one pixel right of where the next row starts
        e0_row: EdgeValue,
        /// edge 0, dropped bits (ANTIALIAS)
        e0_low: LowBits,
        /// edge 0 is below this from the end of a row's span on
        e0_bound: Bound,
        /// edge 1 at the first pixel, its bound subtracted
        e1_start: EdgeValue,
        /// edge 1, one pixel to the right
        e1_a: Slope,
        /// edge 1, one pixel down (ANTIALIAS)
        e1_b: Slope,
        /// edge 1, from row start to one pixel right of where the next row starts
        e1_row: EdgeValue,
        /// edge 1, dropped bits (ANTIALIAS)
        e1_low: LowBits,
        /// edge 1 is below this from the end of a row's span on
        e1_bound: Bound,
        /// edge 2 at the first pixel, its bound subtracted
        e2_start: EdgeValue,
        /// edge 2, one pixel to the right
        e2_a: Slope,
        /// edge 2, one pixel down (ANTIALIAS)
        e2_b: Slope,
        /// edge 2, from row start to one pixel right of where the next row starts
        e2_row: EdgeValue,
        /// edge 2, dropped bits (ANTIALIAS)
        e2_low: LowBits,
        /// edge 2 is below this from the end of a row's span on
        e2_bound: Bound,
    }
}

beat! {
    /// Colour and depth of one polygon, or a part of one, for the primary pipeline: stream `planes`.
    pub struct Planes {
        /// depth at the first pixel, half a unit added
        z_start: DepthPlane,
        /// depth, one pixel to the right
        z_a: DepthPlane,
        /// depth, from row start to row start
        z_row: DepthPlane,
        /// red at the first pixel, half a unit added
        red_start: ColourPlane,
        /// red, one pixel to the right
        red_a: ColourPlane,
        /// red, from row start to row start
        red_row: ColourPlane,
        /// green at the first pixel, half a unit added
        green_start: ColourPlane,
        /// green, one pixel to the right
        green_a: ColourPlane,
        /// green, from row start to row start
        green_row: ColourPlane,
        /// blue at the first pixel, half a unit added
        blue_start: ColourPlane,
        /// blue, one pixel to the right
        blue_a: ColourPlane,
        /// blue, from row start to row start
        blue_row: ColourPlane,
        /// alpha at the first pixel, half a unit added
        alpha_start: ColourPlane,
        /// alpha, one pixel to the right
        alpha_a: ColourPlane,
        /// alpha, from row start to row start
        alpha_row: ColourPlane,
    }
}

beat! {
    /// One primary pixel: stream `beat`.
    pub struct PrimaryBeat {
        /// what the beat does to the secondary state
        op: Op,
        /// the state after this beat becomes the row start
        save: bool,
        /// last beat of the polygon
        last: bool,
        /// the primary polygon covers this pixel's centre (inside the window or not)
        centre: bool,
        /// samples that the primary polygon covers; 0 outside the primary's window
        mask: Mask,
        /// primary x on the display
        x: Coordinate,
        /// primary y on the display
        y: Coordinate,
        /// unblended primary colour
        rgba: Rgba,
        /// primary depth
        depth: Depth,
    }
}

beat! {
    /// A read of the frame buffer: stream `request`.
    pub struct Request {
        /// whose frame buffer
        eye: Eye,
        /// display x
        x: Coordinate,
        /// display y
        y: Coordinate,
    }
}

beat! {
    /// Content of the frame buffer: stream `response`.
    pub struct Response {
        /// background colour
        rgb: [u8; 3],
        /// depth stored there
        depth: Depth,
    }
}

beat! {
    /// A pixel to be written: streams `left` and `right`.
    pub struct Pixel {
        /// whose pixel it is
        eye: Eye,
        /// display x
        x: Coordinate,
        /// display y
        y: Coordinate,
        /// colour; its alpha still to be applied unless `blended`
        rgba: Rgba,
        /// covered samples; to be applied unless `blended`
        area: Area,
        /// depth
        depth: Depth,
        /// the pixel's centre is covered: its depth is to be written
        write: bool,
        /// the colour is final
        blended: bool,
    }
}
