//! Vector packs: stimulus and expected beats of one target, for other simulators and for boards.
//!
//! A pack is a folder: `manifest.json` says what is in it; each stream has its beats as a `.mem`
//! file for `$readmemh` (one packed beat a line) and as a `.bin` file (little-endian, each beat
//! padded to whole bytes); `vec.vh` and `replay.v` replay it without this program.

mod check;
mod error;
mod replay;
mod write;

pub use check::{check, Checked};
pub use error::PackError;
pub use write::{rtl_hash, write, PackInfo};

use serde::{Deserialize, Serialize};
use wheatstone_golden::interface::{Direction, Field, Kind, Stream};

/// Version of the layout; a pack with a greater one is refused.
pub const SCHEMA: u32 = 1;

/// Name of the manifest.
pub const MANIFEST: &str = "manifest.json";

/// What a pack says of itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Always `wheatstone-vectors`.
    pub format: String,
    /// Version of the layout.
    pub schema: u32,
    /// Program that wrote it.
    pub generator: String,
    /// Unit or system.
    pub target: String,
    /// Verilog module.
    pub module: String,
    /// What the vectors are.
    pub case: String,
    /// Seed of random vectors.
    pub seed: u64,
    /// Verilog parameters.
    pub parameters: Vec<Value>,
    /// Static inputs.
    pub statics: Vec<Value>,
    /// Flags when everything has drained.
    pub flags: Vec<Value>,
    /// BLAKE3 of the Verilog that the vectors match.
    pub rtl_blake3: String,
    /// The streams.
    pub ports: Vec<Port>,
    /// Files that replay the pack, with their hashes.
    pub bench: Vec<HashedFile>,
    /// BLAKE3 of the manifest as compact JSON with this field empty: no field changes unnoticed.
    pub hash: String,
}

impl Manifest {
    /// What the field `hash` must say.
    pub fn digest(&self) -> String {
        let emptied = Manifest { hash: String::new(), ..self.clone() };
        // Text and numbers cannot fail to be written.
        let json = serde_json::to_vec(&emptied).unwrap_or_default();
        blake3::hash(&json).to_hex().to_string()
    }
}

/// A name and a number.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Value {
    /// Name of the parameter or port.
    pub name: String,
    /// Its value.
    pub value: u64,
}

/// A file and what its content must hash to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HashedFile {
    /// Name in the pack's folder.
    pub file: String,
    /// BLAKE3 of the content.
    pub blake3: String,
}

/// A stream of the module.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Port {
    /// Prefix of the Verilog ports.
    pub name: String,
    /// `input` is driven, `output` is expected.
    pub direction: String,
    /// For a response: beat n may be offered once beat n of this stream was taken.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub answers: Option<String>,
    /// Number of beats.
    pub beats: u64,
    /// Bits of a packed beat.
    pub bits: u32,
    /// Bytes of a beat in the binary file.
    pub bytes: u32,
    /// Hexadecimal beats, for `$readmemh`.
    pub mem: HashedFile,
    /// Binary beats.
    pub bin: HashedFile,
    /// CRC-32/ISO-HDLC of the binary file, eight hexadecimal digits.
    pub crc32: String,
    /// Where the fields are.
    pub fields: Vec<PackedField>,
}

/// A field of a packed beat.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackedField {
    /// Name, the rest of the Verilog port's.
    pub name: String,
    /// Lowest bit in the beat.
    pub lsb: u32,
    /// Width.
    pub bits: u32,
    /// Two's complement.
    pub signed: bool,
    /// Fraction bits.
    pub fraction: u32,
    /// Meaning.
    pub doc: String,
}

/// `input` or `output`.
fn direction_name(stream: &Stream) -> &'static str {
    match stream.direction {
        Direction::Input => "input",
        Direction::Output => "output",
    }
}

/// Fields of a stream, with their places in a packed beat.
fn packed_fields(fields: &[Field]) -> Vec<PackedField> {
    let mut lsb = 0;
    let mut place = |field: &Field| {
        let (signed, fraction) = match field.kind {
            Kind::Number { signed, fraction } => (signed, fraction),
            _ => (false, 0),
        };
        lsb += field.bits;
        let (name, doc) = (field.name.into(), field.doc.into());
        PackedField { name, lsb: lsb - field.bits, bits: field.bits, signed, fraction, doc }
    };
    fields.iter().map(&mut place).collect()
}

/// Packs one beat into little-endian bytes.
fn pack(row: &[u64], fields: &[PackedField], bytes: &mut Vec<u8>) {
    use bitvec::prelude::*;
    let bits: u32 = fields.iter().map(|f| f.bits).sum();
    let mut beat = bitvec![u8, Lsb0; 0; bits.next_multiple_of(8) as usize];
    for (value, field) in row.iter().zip(fields) {
        let range = field.lsb as usize..(field.lsb + field.bits) as usize;
        beat[range].store_le::<u64>(*value);
    }
    bytes.extend_from_slice(beat.as_raw_slice());
}

/// CRC-32/ISO-HDLC, the one of zlib and of the replay bench.
fn crc32(bytes: &[u8]) -> String {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    format!("{:08x}", crc.checksum(bytes))
}

/// Packed beats as `$readmemh` reads them, most significant digit first.
fn mem_text(bytes: &[u8], beat_bytes: usize, bits: u32) -> String {
    use std::fmt::Write;
    let digits = bits.div_ceil(4) as usize;
    let mut text = String::with_capacity(bytes.len() / beat_bytes * (digits + 1));
    for beat in bytes.chunks(beat_bytes) {
        let start = text.len();
        beat.iter().rev().for_each(|byte| {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        });
        if text.len() - start > digits {
            text.remove(start);
        }
        text.push('\n');
    }
    text
}
