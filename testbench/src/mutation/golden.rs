//! Mutants of the golden units: cargo mutants changes the model's Rust, and the unit's own test must notice.
//!
//! The tests are those of the golden crate, `tests/<unit>.rs`: no Verilog is there to compare with.

use super::{Fate, MutationError, Tested};
use crate::tools::{search_path, CARGO_MUTANTS};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::Command;
use wheatstone_golden::files;
use wheatstone_golden::targets::Target;
use wheatstone_process::Process;

/// Folder in which cargo mutants works and reports, seen from the workspace's folder.
const FOLDER: &str = "target/wheatstone/mutants";
/// Name of the golden model in the place of a configuration.
pub const CONFIG: &str = "golden";
/// Command that runs a test: one that needs more than two minutes of processor time, a hundred times what the slowest
/// needs, never ends, and fails.
const RUNNER: &str =
    r#"target."cfg(unix)".runner=["sh", "-c", "ulimit -t 120; exec \"$@\"", "sh"]"#;
/// Seconds on the clock after which cargo mutants gives up; nothing is known of such a mutant.
const PATIENCE: &str = "3600";

/// True if a target is a unit with a test of the golden crate.
pub fn is_unit(target: Target) -> bool {
    !target.is_system() && !matches!(target, Target::Primary | Target::Mono)
}

/// The report of cargo mutants, as far as it is used.
#[derive(Deserialize)]
struct Report {
    outcomes: Vec<Outcome>,
}

#[derive(Deserialize)]
struct Outcome {
    scenario: Scenario,
    summary: Summary,
}

#[derive(Deserialize)]
enum Scenario {
    Baseline,
    Mutant { name: String },
}

#[derive(Clone, Copy, Deserialize)]
enum Summary {
    Success,
    Failure,
    CaughtMutant,
    MissedMutant,
    Timeout,
    Unviable,
}

/// Tests the mutants of a unit, of a workspace; progress is told on standard error. A mutant is told by
/// place and change.
pub fn test(
    root: &Path,
    unit: Target,
    reason: impl Fn(&str) -> Option<String>,
) -> Result<Vec<Tested<String>>, MutationError> {
    let name = unit.name();
    let (mutants, cargo) = (CARGO_MUTANTS.find()?, std::env::var_os("CARGO"));
    let output = root.join(FOLDER).join(name);
    let file = output.join("mutants.out/outcomes.json");
    let failed = |why: String| MutationError::Golden { unit: name, why };
    std::fs::create_dir_all(&output).map_err(|e| failed(format!("{}: {e}", output.display())))?;
    let mut command = Command::new(&mutants.program);
    command.args(["mutants", "--no-shuffle", "--colors=never", "--timeout", PATIENCE, "--output"]);
    command
        .arg(&output)
        .args(["--package=wheatstone-golden", &format!("--cargo-arg=--test={name}")])
        .arg(format!("--cargo-arg=--config={RUNNER}"));
    for source in sources(root, name).map_err(failed)? {
        command.arg("--file").arg(source);
    }
    command.current_dir(root).env("PATH", search_path());
    command.env("CARGO_TARGET_DIR", root.join(FOLDER).join("build"));
    // The cargo that runs this program may have been chosen by its caller.
    if let Some(cargo) = cargo {
        command.env("CARGO", cargo);
    }
    // Each test has a limit of its own; there are hundreds.
    let process = Process::new(CARGO_MUTANTS.program, &mut command).on(name).without_limit();
    let status = process.show().map_err(|error| failed(error.to_string()))?;
    // 2 and 3: mutants were missed, or hung; everything else but 0 is no result.
    if !matches!(status.code(), Some(0 | 2 | 3)) {
        return Err(failed(format!("cargo mutants ended with {status}")));
    }
    let text =
        files::read_own(&file).map_err(|error| failed(format!("{}: {error}", file.display())))?;
    let report: Report = serde_json::from_str(&text)
        .map_err(|error| failed(format!("{}: {error}", file.display())))?;
    Ok(report.outcomes.into_iter().filter_map(|outcome| tested(outcome, name, &reason)).collect())
}

/// The files of a unit's model: its own, and its tables.
fn sources(root: &Path, name: &str) -> Result<Vec<PathBuf>, String> {
    let of = |file: String| Path::new("golden/src/pipeline").join(file);
    let [own, tables] = [format!("{name}.rs"), format!("{name}_tables.rs")].map(of);
    if !root.join(&own).is_file() {
        return Err(format!("there is no {}", own.display()));
    }
    Ok([own, tables].into_iter().filter(|file| root.join(file).is_file()).collect())
}

/// The fate of a mutant; one that does not compile is none.
fn tested(
    outcome: Outcome,
    name: &str,
    reason: &impl Fn(&str) -> Option<String>,
) -> Option<Tested<String>> {
    let Scenario::Mutant { name: mutant } = outcome.scenario else { return None };
    let fate = match (outcome.summary, reason(&mutant)) {
        (Summary::Unviable | Summary::Success | Summary::Failure, _) => return None,
        (Summary::CaughtMutant, _) => Fate::Killed(format!("tests/{name}.rs")),
        (Summary::MissedMutant | Summary::Timeout, Some(reason)) => Fate::Reviewed(reason),
        (Summary::MissedMutant | Summary::Timeout, None) => Fate::Undecided,
    };
    Some(Tested { mutant, fate })
}
