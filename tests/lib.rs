//! Shared helpers of the tests; the tests themselves are the files beside this one.

pub mod visibility;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use tempfile::TempDir;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::regression::{self, Entry, Plan, Waves};
use wheatstone_testbench::settings::Settings;
use wheatstone_testbench::tools::{Doctor, Toolchain};
use wheatstone_testbench::Builder;

/// The folder of the workspace.
pub fn workspace() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The folder of the Verilog.
pub fn rtl() -> PathBuf {
    workspace().join("rtl")
}

/// The tools that build models.
fn toolchain() -> Toolchain {
    static TOOLS: OnceLock<Toolchain> = OnceLock::new();
    let find = || Toolchain::find().unwrap_or_else(|missing| panic!("{missing}"));
    TOOLS.get_or_init(find).clone()
}

/// A builder whose models are kept from one test run to the next.
pub fn builder() -> Builder {
    Builder::new(toolchain(), workspace().join(Builder::CACHE))
}

/// A builder of models that are run once: quickly built, slow.
pub fn quick_builder() -> Builder {
    Builder::new(toolchain(), workspace().join("target/wheatstone/quick")).unoptimised()
}

/// A folder that goes when it is dropped.
pub fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Settings of a named configuration with parameters changed, each `NAME=VALUE`.
pub fn settings(config: &str, parameters: &[&str]) -> Settings {
    Settings::new(config, parameters).unwrap_or_else(|error| panic!("{error}"))
}

/// The regression of some targets, without scenes and without waveforms, on one thread.
pub fn plan(targets: &[Target], settings: Settings, beats: u64) -> Plan<'static> {
    Plan {
        targets: targets.to_vec(),
        settings,
        program: "wheatstone".into(),
        words: Vec::new(),
        case: None,
        scenes: Vec::new(),
        scenes_only: false,
        seed: 1,
        beats: Some(beats),
        jobs: 1,
        waves: Waves::Never,
        rtl: rtl(),
        out: workspace().join("target/wheatstone/tests"),
    }
}

/// Runs a plan.
pub fn run(plan: &Plan, builder: &Builder) -> Vec<Entry> {
    regression::run(plan, builder, &|_| ()).unwrap_or_else(|error| panic!("{error}"))
}

/// A copy of the Verilog that a test may change.
pub fn copy_of_rtl() -> TempDir {
    let copy = folder();
    for entry in fs::read_dir(rtl()).expect("the folder rtl") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name");
        fs::copy(&path, copy.path().join(name)).expect("copied");
    }
    copy
}

/// Replaces a text that must occur exactly once in the hardware of a file: what comes before its formal
/// properties.
pub fn plant(rtl: &Path, file: &str, find: &str, replace: &str) {
    let path = rtl.join(file);
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    let hardware = text.split("`ifdef FORMAL").next().unwrap_or_default();
    let times = hardware.matches(find).count();
    assert!(times == 1, "{file}: “{find}” occurs {times} times, not once: mend the test's table");
    fs::write(&path, text.replacen(find, replace, 1)).expect("written");
}

/// Makes a program of a shell script. Another process writes it: one that this process begins meanwhile would
/// have it open, and what is open for writing cannot be run.
pub fn script(folder: &Path, name: &str, text: &str) {
    let mut command = Command::new("sh");
    command.args(["-c", "printf '#!/bin/sh\\n%s\\n' \"$2\" >\"$1\" && chmod +x \"$1\"", "sh"]);
    let status = command.arg(folder.join(name)).arg(text).status().expect("sh runs");
    assert!(status.success(), "{name}: not written");
}

/// A program that the tests call; a missing one fails the test, with the command that installs it.
pub fn tool(program: &str) -> Command {
    static DOCTOR: OnceLock<Doctor> = OnceLock::new();
    let rows = &DOCTOR.get_or_init(Doctor::examine).rows;
    let row = rows.iter().find(|row| row.tool.program == program);
    match &row.unwrap_or_else(|| panic!("{program} is no tool of the test bench")).result {
        Ok(found) => Command::new(&found.program),
        Err(missing) => panic!("{missing}"),
    }
}

/// Runs a command; whether it succeeded, and all that it said.
pub fn said(command: &mut Command) -> (bool, String) {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).trim().to_owned())
}

/// The modules of the Verilog, sorted.
pub fn modules() -> Vec<String> {
    let entries = fs::read_dir(rtl()).expect("the folder rtl");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut modules: Vec<String> =
        names.filter_map(|name| Some(name.to_str()?.strip_suffix(".v")?.to_owned())).collect();
    modules.sort();
    modules
}

/// The parameters of a module with their defaults, read from its file.
pub fn parameters(module: &str) -> Vec<(String, u32)> {
    let path = rtl().join(module).with_extension("v");
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{module}: {error}"));
    let lines = text.lines().filter_map(|line| line.trim().strip_prefix("parameter "));
    let parse = |line: &str| {
        let (name, value) = line.trim_end_matches(',').split_once(" = ")?;
        Some((name.to_owned(), value.parse().ok()?))
    };
    lines.map(|line| parse(line).unwrap_or_else(|| panic!("{module}: parameter {line}"))).collect()
}
