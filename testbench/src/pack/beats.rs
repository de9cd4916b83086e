//! Beats as bytes and as text.

use super::PackedField;
use wheatstone_golden::interface::{Direction, Field, Kind, Stream, Table};

/// `input` or `output`.
pub(super) fn direction_name(stream: &Stream) -> &'static str {
    match stream.direction {
        Direction::Input => "input",
        Direction::Output => "output",
    }
}

/// Fields of a stream, with their places in a packed beat.
pub(super) fn packed_fields(fields: &[Field]) -> Vec<PackedField> {
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

/// All beats of a table, little-endian, each padded to whole bytes.
pub(super) fn pack_all(table: &Table, fields: &[PackedField], beat_bytes: usize) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(table.len() * beat_bytes);
    (0..table.len()).for_each(|index| pack(table.row(index), fields, &mut bytes));
    bytes
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
pub(super) fn crc32(bytes: &[u8]) -> String {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    format!("{:08x}", crc.checksum(bytes))
}

/// The first beat in whose last byte a bit beyond the beat's is 1.
pub(super) fn padded_with_ones(bytes: &[u8], beat_bytes: usize, bits: u32) -> Option<usize> {
    let used = bits - 8 * (beat_bytes as u32 - 1);
    bytes
        .chunks(beat_bytes)
        .position(|beat| beat.last().is_some_and(|byte| u32::from(*byte) >> used != 0))
}

/// Packed beats as `$readmemh` reads them, most significant digit first.
pub(super) fn mem_text(bytes: &[u8], beat_bytes: usize, bits: u32) -> String {
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
