//! Interfaces of the hardware: which streams a module has, and the fields of a beat.
//!
//! The streams are declared once, beside the unit they belong to (see [`crate::pipeline`]).
//! The driver of the simulator, the vector packs, the replay benches, the waveform views and
//! the documentation are all made from the tables here.
//!
//! A port of Verilog is named `<stream>_<field>_i` or `_o`; every stream has `valid` and
//! `ready` beside its fields, with the rules of AXI4-Stream.

use crate::config::Config;
use crate::formats::{Eye, Formats, Quantity, Rgba};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// Type of the bits of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number: two's complement if `signed`, with `fraction` fraction bits.
    Number {
        /// True if the number is two's complement.
        signed: bool,
        /// Fraction bits.
        fraction: u32,
    },
    /// A code with a name for each value, counted from 0.
    Code(&'static [&'static str]),
    /// A colour, red in the lowest byte.
    Colour,
    /// A single bit that is a condition.
    Flag,
}

/// One field of a beat, or a static input or output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name, as in the Verilog port.
    pub name: &'static str,
    /// Width in bits, 1 to 64.
    pub bits: u32,
    /// Type of the bits.
    pub kind: Kind,
    /// Meaning, one line.
    pub doc: &'static str,
}

impl Field {
    /// All bits of the field.
    pub fn mask(&self) -> u64 {
        u64::MAX >> (64 - self.bits)
    }

    /// The raw bits as a number, sign extended where the field is signed.
    pub fn number(&self, bits: u64) -> i64 {
        let signed = matches!(self.kind, Kind::Number { signed: true, .. });
        crate::formats::reduce(bits as i64, self.bits, signed)
    }

    /// The value as a person reads it: scaled, named or hexadecimal.
    pub fn display(&self, bits: u64) -> String {
        let bits = bits & self.mask();
        match self.kind {
            Kind::Number { fraction: 0, .. } => self.number(bits).to_string(),
            Kind::Number { fraction, .. } => {
                let scale = (1u64 << fraction) as f64;
                format!("{:.5} ({:#x})", self.number(bits) as f64 / scale, bits)
            }
            Kind::Code(names) => match names.get(bits as usize) {
                Some(name) => (*name).to_string(),
                None => format!("code {bits}"),
            },
            Kind::Colour => format!("#{bits:0width$x}", width = self.bits as usize / 4),
            Kind::Flag => bits.to_string(),
        }
    }
}

/// A value that can stand in a field.
pub trait Bits: Copy {
    /// The value's bits, sign extended.
    fn to_bits(self) -> u64;
    /// The value of sign-extended bits.
    fn from_bits(bits: u64) -> Self;
    /// The field that holds it.
    fn field(name: &'static str, doc: &'static str, formats: &Formats) -> Field;
}

macro_rules! quantity_bits {
    ($($name:ident)*) => {$(
        impl Bits for crate::formats::$name {
            #[inline]
            fn to_bits(self) -> u64 {
                self.raw() as u64
            }
            #[inline]
            fn from_bits(bits: u64) -> Self {
                // Widest formats: the declared width is checked where values are made.
                const WIDEST: Formats = Formats::minimal(&Config::FULL);
                Self::wrap(bits as i64, &WIDEST)
            }
            fn field(name: &'static str, doc: &'static str, formats: &Formats) -> Field {
                let kind = Kind::Number { signed: Self::SIGNED, fraction: Self::FRACTION };
                Field { name, bits: Self::bits(formats), kind, doc }
            }
        }
    )*};
}

quantity_bits! {
    SecondaryX Scale Slant PixelX Coordinate DisplayStep Move EdgeValue Slope Bound LowBits DepthPlane
    ColourPlane Depth Area Mask Count SampleData Tag
}

impl Bits for bool {
    fn to_bits(self) -> u64 {
        self.into()
    }
    fn from_bits(bits: u64) -> bool {
        bits & 1 == 1
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        Field { name, bits: 1, kind: Kind::Flag, doc }
    }
}

impl Bits for Rgba {
    fn to_bits(self) -> u64 {
        self.word().into()
    }
    fn from_bits(bits: u64) -> Rgba {
        Rgba::from_word(bits as u32)
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        Field { name, bits: 32, kind: Kind::Colour, doc }
    }
}

/// Red, green, blue: 24 bits, red lowest.
impl Bits for [u8; 3] {
    fn to_bits(self) -> u64 {
        u64::from(u32::from_le_bytes([self[0], self[1], self[2], 0]))
    }
    fn from_bits(bits: u64) -> [u8; 3] {
        let [r, g, b, _] = (bits as u32).to_le_bytes();
        [r, g, b]
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        Field { name, bits: 24, kind: Kind::Colour, doc }
    }
}

impl Bits for u8 {
    fn to_bits(self) -> u64 {
        self.into()
    }
    fn from_bits(bits: u64) -> u8 {
        bits as u8
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        let kind = Kind::Number { signed: false, fraction: 0 };
        Field { name, bits: 8, kind, doc }
    }
}

impl Bits for Eye {
    fn to_bits(self) -> u64 {
        self as u64
    }
    fn from_bits(bits: u64) -> Eye {
        Eye::BOTH[bits as usize & 1]
    }
    fn field(name: &'static str, doc: &'static str, _: &Formats) -> Field {
        Field { name, bits: 1, kind: Kind::Code(&["left", "right"]), doc }
    }
}

/// A beat of a stream: a struct whose fields are the stream's fields.
pub trait Beat: Copy + 'static {
    /// The fields, in the order in which they are packed, lowest bits first.
    fn fields(formats: &Formats) -> Vec<Field>;
    /// Appends the bits of every field, sign extended.
    fn write(&self, row: &mut Vec<u64>);
    /// The beat of a row; each entry sign extended as by [`Field::number`].
    fn read(row: &[u64]) -> Self;
}

/// The name without Rust's mark for a keyword.
#[doc(hidden)]
pub fn plain(name: &'static str) -> &'static str {
    name.strip_prefix("r#").unwrap_or(name)
}

#[doc(hidden)]
pub use alloc::{vec as rows, vec::Vec as Rows};

/// Declares a beat: a struct and its [`Beat`] table in one place.
#[macro_export]
macro_rules! beat {
    ($(#[$doc:meta])* pub struct $name:ident { $($(#[doc = $fdoc:literal])+ $field:ident : $type:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name {
            $($(#[doc = $fdoc])+ pub $field: $type,)*
        }

        impl $crate::interface::Beat for $name {
            fn fields(formats: &$crate::formats::Formats) -> $crate::interface::Rows<$crate::interface::Field> {
                $crate::interface::rows![$(<$type as $crate::interface::Bits>::field(
                    $crate::interface::plain(stringify!($field)), concat!($($fdoc),+).trim_ascii(), formats),)*]
            }
            #[inline]
            fn write(&self, row: &mut $crate::interface::Rows<u64>) {
                $(row.push($crate::interface::Bits::to_bits(self.$field));)*
            }
            fn read(row: &[u64]) -> Self {
                let mut row = row.iter().copied();
                $(let $field = <$type as $crate::interface::Bits>::from_bits(row.next().unwrap_or(0));)*
                $name { $($field),* }
            }
        }
    };
}

/// Which way a stream flows, seen from the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Into the module.
    Input,
    /// Out of the module.
    Output,
}

/// A stream of beats at a module's port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    /// Name, the prefix of its ports.
    pub name: &'static str,
    /// Which way it flows.
    pub direction: Direction,
    /// Fields of a beat, lowest bits first.
    pub fields: Vec<Field>,
    /// For an answer: the output stream whose n-th beat must have been accepted before beat n of
    /// this one may be offered.
    pub answers: Option<&'static str>,
}

impl Stream {
    fn of<B: Beat>(name: &'static str, direction: Direction, formats: &Formats) -> Stream {
        Stream { name, direction, fields: B::fields(formats), answers: None }
    }

    /// An input stream of beats `B`.
    pub fn input<B: Beat>(name: &'static str, formats: &Formats) -> Stream {
        Stream::of::<B>(name, Direction::Input, formats)
    }

    /// An output stream of beats `B`.
    pub fn output<B: Beat>(name: &'static str, formats: &Formats) -> Stream {
        Stream::of::<B>(name, Direction::Output, formats)
    }

    /// Bits of a packed beat.
    pub fn bits(&self) -> u32 {
        self.fields.iter().map(|f| f.bits).sum()
    }
}

/// Everything a test bench must know of a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interface {
    /// Name of the target on the command line.
    pub target: &'static str,
    /// Name of the Verilog module; its file is `rtl/<module>.v`.
    pub module: &'static str,
    /// Verilog parameters and their values.
    pub parameters: Vec<(&'static str, u32)>,
    /// Inputs that do not change while beats flow; ports `<name>_i`.
    pub statics: Vec<Field>,
    /// The streams, in the order of the module's ports.
    pub streams: Vec<Stream>,
    /// Outputs looked at when everything has drained; ports `<name>_o`.
    pub flags: Vec<Field>,
}

impl Interface {
    /// The stream of that name.
    pub fn stream(&self, name: &str) -> Option<&Stream> {
        self.streams.iter().find(|s| s.name == name)
    }
}

/// Beats of one stream, row by row, each entry masked to the width of its field.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    masks: Vec<u64>,
    values: Vec<u64>,
}

impl Table {
    /// An empty table for beats with these fields.
    pub fn new(fields: &[Field]) -> Table {
        Table { masks: fields.iter().map(Field::mask).collect(), values: Vec::new() }
    }

    /// An empty table for beats `B`.
    pub fn of<B: Beat>(formats: &Formats) -> Table {
        Table::new(&B::fields(formats))
    }

    /// Appends a beat.
    #[inline]
    pub fn push<B: Beat>(&mut self, beat: &B) {
        let start = self.values.len();
        beat.write(&mut self.values);
        for (value, mask) in self.values[start..].iter_mut().zip(&self.masks) {
            *value &= mask;
        }
    }

    /// Appends a beat given as a row of field values.
    pub fn push_row(&mut self, row: &[u64]) {
        debug_assert_eq!(row.len(), self.masks.len());
        self.values.extend(row.iter().zip(&self.masks).map(|(v, m)| v & m));
    }

    /// Number of beats.
    pub fn len(&self) -> usize {
        self.values.len() / self.masks.len().max(1)
    }

    /// True if there is no beat.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Number of fields of a beat.
    pub fn width(&self) -> usize {
        self.masks.len()
    }

    /// The fields of beat `index`.
    #[inline]
    pub fn row(&self, index: usize) -> &[u64] {
        let width = self.masks.len();
        &self.values[index * width..(index + 1) * width]
    }

    /// All rows, one after another.
    pub fn values(&self) -> &[u64] {
        &self.values
    }

    /// An empty table for the same beats.
    pub fn emptied(&self) -> Table {
        Table { masks: self.masks.clone(), values: Vec::new() }
    }
}
