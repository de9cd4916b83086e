//! Number formats: the one definition of every width.
//!
//! [`Formats`] gives the widths of a configuration; the newtypes below are the quantities that
//! have them. A quantity is held in a wide integer and checked against its declared width in
//! debug builds. `rtl/sam_formats.vh` and the vector layouts are generated from here.

use crate::config::Config;

/// Fraction bits of secondary coordinates, scales and interpolated attributes.
pub const FRACTION_BITS: u32 = 14;
/// 1.0 as a [`Scale`].
pub const SCALE_ONE: i64 = 1 << FRACTION_BITS;
/// Most primary pixels that the filter averages into one secondary pixel (paper, section 5.6.1).
pub const FILTER_LIMIT: u32 = 29;
/// Smallest legal [`Scale`]: 1/29 rounded to nearest.
pub const SCALE_MIN: i64 = (2 * SCALE_ONE + FILTER_LIMIT as i64) / (2 * FILTER_LIMIT as i64);
/// Bits of a depth value: 0 is the near plane.
pub const DEPTH_BITS: u32 = 24;
/// Largest depth value, also the value depth buffers are cleared to.
pub const DEPTH_MAX: u32 = (1 << DEPTH_BITS) - 1;
/// Integer bits of an interpolated attribute beyond its range, for the sign and for values
/// extrapolated past the polygon.
pub const GUARD_BITS: u32 = 5;
/// Pixels by which anti-aliasing may widen a span on each side before a polygon is drawn
/// monocular.
pub const WIDENING_LIMIT: i64 = 32;
/// Bits of a [`Bound`] beyond those of a slope: it is at most `WIDENING_LIMIT` + 1 slopes.
pub const BOUND_BITS: u32 = 6;
/// Slack, in pixels, around the guard band within which a start coordinate is accepted.
pub const START_SLACK: i64 = 64;

/// The widths and ranges of one configuration.
///
/// | field | 8 subpixel bits | 4 subpixel bits |
/// | --- | --- | --- |
/// | `x_integer_bits` | 13 | 11 |
/// | `edge_bits` | 34 | 26 |
/// | `slope_bits` | 22 | 16 |
/// | `coordinate_bits` | 12 | 11 |
/// | `max_size` | 2048 | 640 |
/// | `guard_band` | 1024 | 192 |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formats {
    /// Fraction bits of a snapped vertex.
    pub subpixel_bits: u32,
    /// Integer bits of a signed pixel or vertex coordinate, sign included.
    pub x_integer_bits: u32,
    /// Bits of an edge function at a pixel centre, its constant low bits dropped.
    pub edge_bits: u32,
    /// Bits of an edge coefficient (a difference of two vertices, in subpixels).
    pub slope_bits: u32,
    /// Bits of an unsigned display coordinate.
    pub coordinate_bits: u32,
    /// Largest width and height of a view in pixels.
    pub max_size: u32,
    /// Pixels around a view within which polygons are left unclipped.
    pub guard_band: u32,
    /// Bits of a coverage mask.
    pub mask_bits: u32,
    /// Bits of a covered area, counted in samples.
    pub area_bits: u32,
    /// Bits that the sampler carries: colour, and depth where it is sampled.
    pub sample_bits: u32,
}

impl Formats {
    /// Formats of a configuration.
    pub const fn new(config: &Config) -> Formats {
        let wide = config.subpixel_bits == 8;
        Formats {
            subpixel_bits: config.subpixel_bits,
            x_integer_bits: if wide { 13 } else { 11 },
            edge_bits: if wide { 34 } else { 26 },
            slope_bits: if wide { 22 } else { 16 },
            coordinate_bits: if wide { 12 } else { 11 },
            max_size: if wide { 2048 } else { 640 },
            guard_band: if wide { 1024 } else { 192 },
            mask_bits: if config.antialias { 16 } else { 1 },
            area_bits: if config.antialias { 5 } else { 1 },
            sample_bits: if config.interpolated_depth { 32 } else { 32 + DEPTH_BITS },
        }
    }

    /// Formats of the minimal system, which always samples depth.
    pub const fn minimal(config: &Config) -> Formats {
        Formats { sample_bits: 32 + DEPTH_BITS, ..Formats::new(config) }
    }

    /// Subpixels in a pixel.
    pub const fn one_pixel(&self) -> i64 {
        1 << self.subpixel_bits
    }

    /// Subpixels from a pixel's centre to its outermost samples, along x or y.
    pub const fn sample_reach(&self) -> i64 {
        if self.mask_bits > 1 {
            3 * self.one_pixel() / 8
        } else {
            0
        }
    }

    /// Samples of a fully covered pixel.
    pub const fn full_area(&self) -> u32 {
        self.mask_bits
    }
}

/// A quantity with a declared format.
pub trait Quantity: Copy {
    /// Name of the quantity in messages.
    const NAME: &'static str;
    /// True if the raw value is two's complement.
    const SIGNED: bool;
    /// Fraction bits of the raw value.
    const FRACTION: u32;
    /// Width of the raw value.
    fn bits(formats: &Formats) -> u32;
    /// The value in units of the last place.
    fn raw(self) -> i64;
    /// The quantity of a raw value that fits; checked in debug builds.
    fn new(raw: i64, formats: &Formats) -> Self;
    /// The quantity of a raw value reduced modulo its width.
    fn wrap(raw: i64, formats: &Formats) -> Self;
    /// True if a raw value fits the format.
    fn fits(raw: i64, formats: &Formats) -> bool {
        raw == reduce(raw, Self::bits(formats), Self::SIGNED)
    }
}

/// `raw` modulo 2^`bits`, as a signed or unsigned number.
#[inline]
pub const fn reduce(raw: i64, bits: u32, signed: bool) -> i64 {
    let shift = 64 - bits;
    if signed {
        (raw << shift) >> shift
    } else {
        (((raw as u64) << shift) >> shift) as i64
    }
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident($repr:ty), $signed:literal, $fraction:expr, |$f:ident| $bits:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name($repr);

        impl Quantity for $name {
            const NAME: &'static str = stringify!($name);
            const SIGNED: bool = $signed;
            const FRACTION: u32 = $fraction;
            #[inline]
            fn bits($f: &Formats) -> u32 {
                $bits
            }
            #[inline]
            fn raw(self) -> i64 {
                self.0 as i64
            }
            #[inline]
            fn new(raw: i64, formats: &Formats) -> Self {
                debug_assert!(Self::fits(raw, formats), "{} {raw} exceeds {} bits", Self::NAME, Self::bits(formats));
                $name(raw as $repr)
            }
            #[inline]
            fn wrap(raw: i64, formats: &Formats) -> Self {
                $name(reduce(raw, Self::bits(formats), $signed) as $repr)
            }
        }
    )*};
}

impl SampleData {
    /// Colour and depth as the sampler carries them.
    #[inline]
    pub fn pack(rgba: Rgba, depth: Depth, formats: &Formats) -> SampleData {
        SampleData::wrap(i64::from(rgba.word()) | (depth.raw() << 32), formats)
    }

    /// The colour.
    #[inline]
    pub fn rgba(self) -> Rgba {
        Rgba::from_word(self.0 as u32)
    }

    /// The depth, 0 where it is not sampled.
    #[inline]
    pub fn depth(self, formats: &Formats) -> Depth {
        Depth::new(self.raw() >> 32, formats)
    }
}

quantities! {
    /// Secondary x (or y, with a tilted head) and the row shear, in pixels: signed 13.14 or 11.14;
    /// accumulators wrap.
    SecondaryX(i32), true, FRACTION_BITS, |f| f.x_integer_bits + FRACTION_BITS;
    /// G1, the secondary's scale along x: unsigned 1.14, at most 1.0.
    Scale(i32), false, FRACTION_BITS, |_f| 1 + FRACTION_BITS;
    /// Movement of the secondary y for one primary pixel, with a tilted head: signed 2.14.
    Slant(i32), true, FRACTION_BITS, |_f| 2 + FRACTION_BITS;
    /// Whole pixel coordinate in a view, signed.
    PixelX(i32), true, 0, |f| f.x_integer_bits;
    /// Pixel coordinate on a display, unsigned.
    Coordinate(u16), false, 0, |f| f.coordinate_bits;
    /// Movement of a display coordinate from one scan line to the next: -2 to 2.
    DisplayStep(i8), true, 0, |_f| 3;
    /// Whole-pixel movement of the secondary y: -1, 0 or 1.
    Move(i8), true, 0, |_f| 2;
    /// Edge function at a pixel centre, its constant low bits dropped; accumulators wrap.
    EdgeValue(i64), true, 0, |f| f.edge_bits;
    /// Coefficient A or B of an edge function, in subpixels.
    Slope(i32), true, 0, |f| f.slope_bits;
    /// Exclusive upper bound of an edge function from the end of a row's span on (primary pipeline).
    Bound(i64), true, 0, |f| f.slope_bits + BOUND_BITS;
    /// The three highest dropped bits of an edge function, in eighths of its last place.
    LowBits(u8), false, 0, |_f| 3;
    /// Interpolated depth: 24 bits, guard bits and a 14-bit fraction; accumulators wrap.
    DepthPlane(i64), true, FRACTION_BITS, |_f| DEPTH_BITS + GUARD_BITS + FRACTION_BITS;
    /// Interpolated colour channel: 8 bits, guard bits and a 14-bit fraction; accumulators wrap.
    ColourPlane(i32), true, FRACTION_BITS, |_f| 8 + GUARD_BITS + FRACTION_BITS;
    /// Depth: 24 bits, 0 at the near plane, affine on the screen.
    Depth(u32), false, 0, |_f| DEPTH_BITS;
    /// Covered area in samples: 0 or 1, with anti-aliasing 0 to 16.
    Area(u8), false, 0, |f| f.area_bits;
    /// Coverage mask, one bit a sample, rows of four from the top; bit 0 is top left.
    Mask(u16), false, 0, |f| f.mask_bits;
    /// Data of the sampler: colour lowest, above it depth where that is sampled.
    SampleData(u64), false, 0, |f| f.sample_bits;
    /// Bit that goes beside a colour through blending: whether the pixel passed the depth test.
    Tag(u8), false, 0, |_f| 1;
    /// Number of pixels averaged by the filter: 0 to 29.
    Count(u8), false, 0, |_f| 5;
}

/// A colour with 8 bits a channel; red is the lowest byte of the raw word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rgba(pub [u8; 4]);

impl Rgba {
    /// The colour as a 32-bit word, red lowest.
    pub fn word(self) -> u32 {
        u32::from_le_bytes(self.0)
    }

    /// The colour of a 32-bit word, red lowest.
    pub fn from_word(word: u32) -> Rgba {
        Rgba(word.to_le_bytes())
    }

    /// Red, green and blue.
    pub fn rgb(self) -> [u8; 3] {
        [self.0[0], self.0[1], self.0[2]]
    }
}

/// One of the two eyes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Eye {
    /// The left eye.
    #[default]
    Left = 0,
    /// The right eye.
    Right = 1,
}

impl Eye {
    /// Both eyes, left first.
    pub const BOTH: [Eye; 2] = [Eye::Left, Eye::Right];

    /// The other eye.
    pub fn other(self) -> Eye {
        match self {
            Eye::Left => Eye::Right,
            Eye::Right => Eye::Left,
        }
    }

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        ["left", "right"][self as usize]
    }
}
