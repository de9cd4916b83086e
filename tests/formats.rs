//! Formats: the Verilog has the widths, tables and parameters that the Rust defines.

use std::fs;
use wheatstone_golden::config::{Config, PARAMETERS};
use wheatstone_golden::document::COMMAND;
use wheatstone_golden::formats::{Formats, FRACTION_BITS};
use wheatstone_golden::header::formats_header;
use wheatstone_golden::targets::Target;
use wheatstone_tests::*;

#[test]
fn the_verilog_header_is_the_generated_one() {
    let committed = fs::read_to_string(rtl().join("sam_formats.vh")).expect("the header");
    let generated = formats_header();
    let lines = committed.lines().zip(generated.lines()).enumerate();
    let different = lines.filter(|(_, (committed, generated))| committed != generated);
    for (number, (committed, generated)) in different.take(5) {
        println!("line {}: {committed}\n    expected: {generated}", number + 1);
    }
    assert!(
        committed == generated,
        "rtl/sam_formats.vh is not what the formats say; write it again with\n    {COMMAND}"
    );
}

#[test]
fn the_hybrid_has_the_build_parameters_with_the_default_values() {
    let mut expected: Vec<(String, u32)> = PARAMETERS
        .iter()
        .map(|p| (p.verilog.to_owned(), Config::DEFAULT.get(p.verilog).expect("a value")))
        .collect();
    let mut found = parameters("sam_hybrid");
    expected.sort();
    found.sort();
    assert_eq!(found, expected);
}

#[test]
fn modules_agree_on_the_defaults_of_the_parameters() {
    for module in modules() {
        for (name, value) in parameters(&module) {
            // LEND and the widths are the instance's own business.
            let expected = Config::DEFAULT.get(&name).unwrap_or(value);
            assert_eq!(value, expected, "{module} {name}");
        }
    }
}

#[test]
fn targets_set_parameters_that_their_modules_have() {
    for target in Target::ALL {
        let known = parameters(target.module());
        for (name, _) in target.interface(&Config::FULL).parameters {
            assert!(known.iter().any(|(n, _)| n == name), "{} has no {name}", target.module());
        }
    }
}

#[test]
fn the_named_configurations_are_those_of_the_documentation() {
    // Order of the columns: default, paper, full.
    let table = [
        ("SUBPIXEL_BITS", [8, 4, 8]),
        ("FILTER_TERMS", [0, 2, 0]),
        ("ANTIALIAS", [0, 1, 1]),
        ("INTEGRATED", [0, 0, 1]),
        ("DEPTH_INTERPOLATED", [1, 0, 1]),
        ("DEPTH_EXTERNAL", [0, 0, 0]),
        ("TILT", [0, 0, 1]),
        ("SLOTS", [16, 4, 16]),
    ];
    for (column, name) in Config::NAMES.into_iter().enumerate() {
        let config = Config::named(name).expect("it has a name");
        for (parameter, values) in table {
            assert_eq!(config.get(parameter), Some(values[column]), "{parameter} of {name}");
        }
    }
    assert_eq!(table.len(), PARAMETERS.len(), "a parameter is missing in the table");
    // The paper's secondary x is 11.14.
    assert_eq!(Formats::new(&Config::PAPER).x_integer_bits, 11);
    assert_eq!(FRACTION_BITS, 14);
}
