//! Tables for the documentation: interfaces, from the definitions that the hardware and its tests
//! use. The pages of `docs/` carry them between marks; the rest is written by hand.

use crate::config::{Config, PARAMETERS};
use crate::interface::{Direction, Field, Interface, Kind, Stream};
use crate::targets::{probes, Target};
use std::fmt::Write;

/// The command that writes everything generated anew.
pub const COMMAND: &str = "cargo run -p wheatstone-testbench -- generate";

/// The configurations whose widths stand beside each other, in the order of [`Config::NAMES`].
const CONFIGS: [Config; 3] = [Config::DEFAULT, Config::PAPER, Config::FULL];

/// Parameters of modules that are no build parameters: a system sets them from those.
const WIDTH_PARAMETERS: [(&str, &str); 4] = [
    ("BITS", "bits of the value"),
    ("SLOPE_BITS", "bits of the changes for one pixel"),
    ("WIDTH", "bits of the data"),
    ("TAG_BITS", "bits of the tag"),
];

/// Parameters, ports and streams of a target as Markdown tables, the three named configurations
/// side by side.
pub fn interface_tables(target: Target) -> String {
    let all = CONFIGS.map(|config| target.interface(&config));
    let mut text = String::new();
    parameters(&mut text, &all);
    if target == Target::EdgeInterpolator {
        instances(&mut text);
    }
    ports(&mut text, &all);
    text
}

/// One value where the configurations agree, else all three.
fn side_by_side(values: [u32; 3]) -> String {
    match values {
        [a, b, c] if a == b && b == c => a.to_string(),
        [a, b, c] => format!("{a} / {b} / {c}"),
    }
}

/// Writing to a string cannot fail.
fn line(text: &mut String, line: impl AsRef<str>) {
    writeln!(text, "{}", line.as_ref()).expect("writing to a string");
}

fn parameters(text: &mut String, all: &[Interface; 3]) {
    line(
        text,
        "\n| parameter | default | paper | full | meaning |\n| --- | --- | --- | --- | --- |",
    );
    for (n, (name, _)) in all[0].parameters.iter().enumerate() {
        let [a, b, c] = [0, 1, 2].map(|k: usize| all[k].parameters[n].1);
        let built = PARAMETERS.iter().find(|p| p.verilog == *name);
        let meaning = match built {
            Some(p) => format!("{} (`--param {}={}`)", p.help, p.name, p.values.join("\\|")),
            None => {
                let known = WIDTH_PARAMETERS.iter().find(|(width, _)| width == name);
                known.map_or("", |(_, meaning)| meaning).to_string()
            }
        };
        line(text, format!("| `{name}` | {a} | {b} | {c} | {meaning} |"));
    }
}

/// The widths of the edge interpolator wherever the hybrid has one.
fn instances(text: &mut String) {
    let all = CONFIGS.map(|config| probes(Target::Hybrid, &config));
    let module = Target::EdgeInterpolator.module();
    line(text, "\n| in `sam_hybrid` | default | paper | full |\n| --- | --- | --- | --- |");
    // The last configuration has every option.
    for probe in all[2].iter().filter(|p| p.module == module) {
        let widths = |probes: &Vec<_>| {
            let same = |p: &&crate::targets::Probe| p.unit == probe.unit;
            probes.iter().find(same).map_or("not built".into(), |p| {
                format!("{}, {}", p.stream.fields[0].bits, p.stream.fields[1].bits)
            })
        };
        let [a, b, c] = [0, 1, 2].map(|k| widths(&all[k]));
        line(text, format!("| `{}` | {a} | {b} | {c} |", probe.path));
    }
    line(text, "\nThe numbers are `BITS`, `SLOPE_BITS`.");
}

fn ports(text: &mut String, all: &[Interface; 3]) {
    line(
        text,
        "\n| stream | | field | bits | format | meaning |\n| --- | --- | --- | --- | --- | --- |",
    );
    let mut streams: Vec<(String, usize)> = Vec::new();
    for (n, stream) in all[0].streams.iter().enumerate() {
        match streams.last_mut() {
            // Two streams of the same beats need one description.
            Some((names, before)) if alike(&all[0].streams[*before], stream) => {
                names.push_str(&format!(", `{}`", stream.name));
            }
            _ => streams.push((format!("`{}`", stream.name), n)),
        }
    }
    for (names, n) in &streams {
        let fields = [0, 1, 2].map(|k: usize| all[k].streams[*n].fields.as_slice());
        rows(text, names, arrow(all[0].streams[*n].direction), fields);
    }
    rows(text, "static", "in", [0, 1, 2].map(|k: usize| all[k].statics.as_slice()));
    rows(text, "flag", "out", [0, 1, 2].map(|k: usize| all[k].flags.as_slice()));
    let beat = |(names, n): &(String, usize)| {
        format!("{names} {}", side_by_side([0, 1, 2].map(|k: usize| all[k].streams[*n].bits())))
    };
    let beats = streams.iter().map(beat).collect::<Vec<_>>().join("; ");
    line(text, format!("\nBits of a beat: {beats}. Three numbers are default / paper / full."));
}

fn alike(a: &Stream, b: &Stream) -> bool {
    a.direction == b.direction && a.fields == b.fields
}

fn arrow(direction: Direction) -> &'static str {
    match direction {
        Direction::Input => "in",
        Direction::Output => "out",
    }
}

fn rows(text: &mut String, names: &str, direction: &str, fields: [&[Field]; 3]) {
    for (n, field) in fields[0].iter().enumerate() {
        let bits = side_by_side(fields.map(|f| f[n].bits));
        let [names, direction] = if n == 0 { [names, direction] } else { ["", ""] };
        let format = format_of(field);
        line(
            text,
            format!(
                "| {names} | {direction} | `{}` | {bits} | {format} | {} |",
                field.name, field.doc
            ),
        );
    }
}

fn format_of(field: &Field) -> String {
    match field.kind {
        Kind::Number { signed, fraction } => {
            let sign = if signed { "signed" } else { "unsigned" };
            match fraction {
                0 => sign.into(),
                _ => format!("{sign}, {fraction} fraction bits"),
            }
        }
        Kind::Code(names) => {
            let codes = names.iter().enumerate().map(|(code, name)| format!("{code} {name}"));
            codes.collect::<Vec<_>>().join(", ")
        }
        Kind::Colour if field.bits == 32 => "R, G, B, A, red lowest".into(),
        Kind::Colour => "R, G, B, red lowest".into(),
        Kind::Flag => "flag".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_has_a_meaning() {
        for target in Target::ALL {
            for config in CONFIGS {
                for (name, _) in target.interface(&config).parameters {
                    let built = PARAMETERS.iter().any(|p| p.verilog == name);
                    let width = WIDTH_PARAMETERS.iter().any(|(width, _)| *width == name);
                    assert!(built || width, "{}: {name}", target.name());
                }
            }
        }
    }
}
