//! Writer of `rtl/sam_formats.vh`: every width and constant of the Verilog, from the Rust that
//! defines it.

use crate::config::Config;
use crate::formats::*;
use crate::interface::Bits;
use crate::pipeline::filter_tables::*;
use crate::pipeline::{Mode, Op};
use std::fmt::Write;

const PREAMBLE: &str = "\
// Number formats of the SAM hardware: widths in bits, codes, limits and filter tables.
// Generated from golden/src/{config,formats}.rs and golden/src/pipeline/ by
//     cargo run -p wheatstone-testbench -- generate
// Do not edit.
//
// SUB stands for the parameter SUBPIXEL_BITS, AA for ANTIALIAS.
`ifndef SAM_FORMATS_VH
`define SAM_FORMATS_VH
";

/// The text of `rtl/sam_formats.vh`.
pub fn formats_header() -> String {
    let mut text = String::from(PREAMBLE);
    widths(&mut text);
    codes(&mut text);
    limits(&mut text);
    filter(&mut text);
    text.push_str("\n`endif\n");
    text
}

/// A macro whose value depends on the configuration, with the arguments it needs.
fn define(text: &mut String, doc: &str, name: &str, value: impl Fn(&Formats) -> u32) {
    let of = |subpixel_bits, antialias| {
        value(&Formats::new(&Config { subpixel_bits, antialias, ..Config::DEFAULT }))
    };
    let [wide, narrow] = [of(8, false), of(4, false)];
    let [wide_aa, narrow_aa] = [of(8, true), of(4, true)];
    assert!(
        (wide == wide_aa && narrow == narrow_aa) || (wide == narrow && wide_aa == narrow_aa),
        "{name} depends on two parameters"
    );
    let definition = if wide != narrow {
        format!("{name}(SUB) ((SUB) == 8 ? {wide} : {narrow})")
    } else if wide != wide_aa {
        format!("{name}(AA) ((AA) == 1 ? {wide_aa} : {wide})")
    } else {
        format!("{name} {wide}")
    };
    let doc = if doc.is_empty() { String::new() } else { format!("// {doc}\n") };
    writeln!(text, "{doc}`define {definition}").expect("writing to a string");
}

/// The width of a quantity.
fn width<Q: Quantity>(text: &mut String, name: &str) {
    let sign = if Q::SIGNED { "signed" } else { "unsigned" };
    let doc = match Q::FRACTION {
        0 => format!("{}: {sign} integer", Q::NAME),
        fraction => format!("{}: {sign}, {fraction} fraction bits", Q::NAME),
    };
    define(text, &doc, &format!("SAM_{name}_BITS"), Q::bits);
}

fn widths(text: &mut String) {
    text.push_str("\n// Widths\n");
    width::<SecondaryX>(text, "X");
    width::<Scale>(text, "SCALE");
    width::<Slant>(text, "SLANT");
    width::<PixelX>(text, "PIXEL_X");
    width::<Coordinate>(text, "COORDINATE");
    width::<DisplayStep>(text, "DISPLAY_STEP");
    width::<Move>(text, "MOVE");
    width::<EdgeValue>(text, "EDGE");
    width::<Slope>(text, "SLOPE");
    width::<Bound>(text, "BOUND");
    width::<LowBits>(text, "LOW");
    width::<DepthPlane>(text, "DEPTH_PLANE");
    width::<ColourPlane>(text, "COLOUR_PLANE");
    width::<Depth>(text, "DEPTH");
    width::<Area>(text, "AREA");
    width::<Mask>(text, "MASK");
    width::<Count>(text, "COUNT");
    define(
        text,
        "Fraction bits of the quantities that have a fraction",
        "SAM_FRACTION_BITS",
        |_| FRACTION_BITS,
    );
    define(
        text,
        "Integer bits of a depth or colour plane beyond the range of the attribute",
        "SAM_GUARD_BITS",
        |_| GUARD_BITS,
    );
    define(text, "Op of a beat", "SAM_OP_BITS", |f| Op::field("", "", f).bits);
    define(text, "Mode of a polygon", "SAM_MODE_BITS", |f| Mode::field("", "", f).bits);
    define(text, "Colour with alpha, red in the lowest byte", "SAM_RGBA_BITS", |f| {
        Rgba::field("", "", f).bits
    });
    define(text, "Colour without alpha", "SAM_RGB_BITS", |f| <[u8; 3]>::field("", "", f).bits);
    define(text, "One channel of a colour", "SAM_CHANNEL_BITS", |f| u8::field("", "", f).bits);
}

fn codes(text: &mut String) {
    text.push_str("\n// Codes\n");
    let mut code = |prefix: &str, bits: u32, names: &[&str]| {
        for (value, name) in names.iter().enumerate() {
            writeln!(text, "`define SAM_{prefix}_{name} {bits}'d{value}")
                .expect("writing to a string");
        }
    };
    let formats = Formats::new(&Config::DEFAULT);
    code("OP", Op::field("", "", &formats).bits, &Op::NAMES);
    code("MODE", Mode::field("", "", &formats).bits, &Mode::NAMES);
}

fn limits(text: &mut String) {
    text.push_str("\n// Limits\n");
    define(text, "1.0 as a Scale, the largest legal G1", "SAM_SCALE_ONE", |_| SCALE_ONE as u32);
    define(text, "Smallest legal G1", "SAM_SCALE_MIN", |_| SCALE_MIN as u32);
    define(text, "Largest width and height of a view", "SAM_MAX_SIZE", |f| f.max_size);
    define(
        text,
        "Pixels around a view in which polygons are left unclipped",
        "SAM_GUARD_BAND",
        |f| f.guard_band,
    );
    define(
        text,
        "Pixels around the guard band in which a start is accepted",
        "SAM_START_SLACK",
        |_| START_SLACK as u32,
    );
    define(text, "Samples of a fully covered pixel", "SAM_FULL_AREA", |f| f.full_area());
    define(text, "Largest depth", "SAM_DEPTH_MAX", |_| DEPTH_MAX);
    define(text, "Most pixels the filter averages", "SAM_FILTER_LIMIT", |_| FILTER_LIMIT);
}

/// Entries of a table of the Verilog: every value of a count has one, so that no index is out of
/// range.
const TABLE_ENTRIES: usize = 32;

/// Writes a table as one wide constant; entry n is the `bits` bits from bit n·`bits`.
fn table(text: &mut String, name: &str, bits: u32, entry: impl Fn(usize) -> u32) {
    let limit = FILTER_LIMIT as usize;
    let value = |n| if n <= limit { entry(n) } else { 0 };
    let all: Vec<bool> =
        (0..TABLE_ENTRIES).flat_map(|n| (0..bits).map(move |b| value(n) >> b & 1 == 1)).collect();
    let digits = all.chunks(4).rev().map(|nibble| {
        let digit = nibble.iter().rev().fold(0, |digit, bit| digit * 2 + u32::from(*bit));
        char::from_digit(digit, 16).expect("four bits")
    });
    let digits: String = digits.collect();
    writeln!(text, "`define {name}_BITS {bits}\n`define {name} {}'h{digits}", all.len())
        .expect("writing to a string");
}

fn filter(text: &mut String) {
    text.push_str(
        "\n// Filter tables: entry n is the part-select [n*<table>_BITS +: <table>_BITS]\n",
    );
    text.push_str("// 1/n as 2^-P + 2^-Q\n");
    define(text, "", "SAM_TWO_TERM_SHIFT", |_| TWO_TERM_SHIFT);
    table(text, "SAM_TWO_TERM_P", 4, |n| TWO_TERM[n].0);
    table(text, "SAM_TWO_TERM_Q", 4, |n| TWO_TERM[n].1);
    text.push_str("// 1/n as 2^-P + 2^-Q + 2^-R\n");
    define(text, "", "SAM_THREE_TERM_SHIFT", |_| THREE_TERM_SHIFT);
    table(text, "SAM_THREE_TERM_P", 4, |n| THREE_TERM[n].0);
    table(text, "SAM_THREE_TERM_Q", 4, |n| THREE_TERM[n].1);
    table(text, "SAM_THREE_TERM_R", 4, |n| THREE_TERM[n].2);
    text.push_str("// ceil(2^SHIFT / n), so wide that no multiplication is in an index\n");
    define(text, "", "SAM_RECIPROCAL_SHIFT", |_| RECIPROCAL_SHIFT);
    table(text, "SAM_RECIPROCAL", 32, |n| reciprocal(n as u32));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_header_is_current() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../rtl/sam_formats.vh");
        let committed = std::fs::read_to_string(path).expect("rtl/sam_formats.vh can be read");
        assert_eq!(committed, formats_header(), "run: {}", crate::document::COMMAND);
    }

    #[test]
    fn the_header_names_the_command_that_writes_it() {
        assert!(PREAMBLE.contains(crate::document::COMMAND));
    }

    #[test]
    fn tables_are_packed_from_entry_0_upwards() {
        let mut text = String::new();
        table(&mut text, "T", 4, |n| n as u32 & 15);
        let digits = "00dcba9876543210fedcba9876543210";
        assert_eq!(text, format!("`define T_BITS 4\n`define T 128'h{digits}\n"));
    }
}
