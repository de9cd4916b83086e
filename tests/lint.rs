//! Lint: Verilator, Icarus and Yosys take every module in every configuration without a word, and
//! refuse illegal parameters with a message that names module and parameter.

use std::collections::BTreeSet;
use std::process::Command;
use wheatstone_golden::config::{Config, PARAMETERS};
use wheatstone_golden::targets::Target;
use wheatstone_tests::*;

/// Parameters of an instance.
type Values = Vec<(String, u32)>;

fn verilator(module: &str, values: &Values) -> Command {
    let mut command = tool("verilator");
    command.args(["--lint-only", "-Wall", "-Irtl", "-y", "rtl", "--top-module", module]);
    command.args(values.iter().map(|(name, value)| format!("-G{name}={value}")));
    command.arg(format!("rtl/{module}.v"));
    command
}

fn icarus(module: &str, values: &Values) -> Command {
    let mut command = tool("iverilog");
    command.args(["-g2005", "-Wall", "-I", "rtl", "-o", "/dev/null", "-s", module]);
    command.args(values.iter().map(|(name, value)| format!("-P{module}.{name}={value}")));
    command.args(modules().iter().map(|module| format!("rtl/{module}.v")));
    command
}

fn yosys(module: &str, values: &Values) -> Command {
    let set = values.iter().map(|(name, value)| format!(" -chparam {name} {value}"));
    let mut command = tool("yosys");
    command.arg("-q").arg("-p").arg(format!(
        "read_verilog -I rtl rtl/*.v; hierarchy -check -top {module}{}; proc; check -assert",
        set.collect::<String>()
    ));
    command
}

/// The complaint of a command about a module; none if it passes and prints nothing.
fn complaint(mut command: Command) -> Option<String> {
    let (passed, text) = said(command.current_dir(workspace()));
    (!passed || !text.is_empty()).then_some(text)
}

/// The parameters of a module in a configuration.
fn values(module: &str, config: &Config) -> Values {
    let target = Target::ALL.into_iter().find(|target| target.module() == module);
    match target {
        Some(target) => {
            let parameters = target.interface(config).parameters.into_iter();
            parameters.map(|(name, value)| (name.to_owned(), value)).collect()
        }
        None => parameters(module)
            .into_iter()
            .filter_map(|(name, _)| Some((name.clone(), config.get(&name)?)))
            .collect(),
    }
}

/// Every module in the named configurations, and the systems with each single parameter changed.
fn builds() -> BTreeSet<(String, Values)> {
    let mut builds = BTreeSet::new();
    for config in Config::NAMES.into_iter().filter_map(Config::named) {
        builds.extend(modules().into_iter().map(|module| {
            let values = values(&module, &config);
            (module, values)
        }));
    }
    for parameter in &PARAMETERS {
        for value in parameter.values {
            let mut config = Config::DEFAULT;
            config.set(parameter.name, value).expect("a legal value");
            for module in ["sam_minimal", "sam_hybrid", "sam_primary", "sam_stereo"] {
                builds.insert((module.to_owned(), values(module, &config)));
            }
        }
    }
    builds
}

fn all_are_clean(tool: fn(&str, &Values) -> Command) {
    let complaints: Vec<String> = builds()
        .iter()
        .filter_map(|(module, values)| {
            let text = complaint(tool(module, values))?;
            Some(format!("{module} {values:?}:\n{text}"))
        })
        .collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n\n"));
}

#[test]
fn verilator_has_nothing_to_say() {
    all_are_clean(verilator);
}

#[test]
fn icarus_has_nothing_to_say() {
    all_are_clean(icarus);
    // As the command in the README has it: everything at once.
    let mut command = tool("iverilog");
    command.args(["-g2005", "-Wall", "-I", "rtl", "-o", "/dev/null"]);
    command.args(modules().iter().map(|module| format!("rtl/{module}.v")));
    assert_eq!(complaint(command), None);
}

#[test]
fn yosys_has_nothing_to_say() {
    all_are_clean(yosys);
}

/// Values just outside the legal range of a parameter.
fn illegal(module: &str, parameter: &str) -> Vec<u32> {
    match (module, parameter) {
        (_, "SUBPIXEL_BITS") => vec![0, 5, 16],
        (_, "FILTER_TERMS") => vec![1, 4],
        (_, "ANTIALIAS" | "INTEGRATED" | "DEPTH_INTERPOLATED") => vec![2],
        (_, "DEPTH_EXTERNAL" | "TILT" | "LEND") => vec![2],
        (_, "SLOTS") => vec![1, 3, 64],
        (_, "WIDTH" | "TAG_BITS") => vec![0],
        ("sam_clamp", "BITS") => vec![0],
        ("sam_edge_interpolator", "BITS") => vec![2, 65],
        ("sam_edge_interpolator", "SLOPE_BITS") => vec![1, 35],
        _ => panic!("{module}: this test knows no illegal value of {parameter}"),
    }
}

fn all_are_refused(tool: fn(&str, &Values) -> Command) {
    let mut faults = Vec::new();
    for module in modules() {
        for (parameter, _) in parameters(&module) {
            for value in illegal(&module, &parameter) {
                let values = vec![(parameter.clone(), value)];
                let (passed, text) = said(tool(&module, &values).current_dir(workspace()));
                // A parameter that is handed down is refused by the module that uses it.
                let message = format!("_{parameter}_must_be_");
                let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let mut words = text.split(|c| !is_part(c));
                if passed {
                    faults.push(format!("{module} takes {parameter} = {value}"));
                } else if !words.any(|w| w.starts_with("sam_") && w.contains(&message)) {
                    faults.push(format!("{module} does not name {parameter} = {value}:\n{text}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn verilator_stops_at_illegal_parameters() {
    all_are_refused(verilator);
}

#[test]
fn icarus_stops_at_illegal_parameters() {
    all_are_refused(icarus);
}

#[test]
fn yosys_stops_at_illegal_parameters() {
    all_are_refused(yosys);
}
