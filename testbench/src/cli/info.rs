//! `wheatstone list` and `wheatstone doctor`.

use super::failure::{Failure, MISSING_TOOL, OK};
use crate::settings::RUN_PARAMETERS;
use crate::tools::Doctor;
use clap::Args;
use wheatstone_golden::config::{Config, Parameter, PARAMETERS};
use wheatstone_golden::projection::Kind;
use wheatstone_golden::scene::builtin;
use wheatstone_golden::targets::Target;
use wheatstone_studies::EXPERIMENTS;

#[derive(Debug, Args)]
pub(super) struct ListArgs {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
pub(super) struct DoctorArgs {}

pub(super) fn list(args: &ListArgs) -> Result<u8, Failure> {
    if args.json {
        say!("{:#}", list_json());
        return Ok(OK);
    }
    say!("Targets");
    for target in Target::ALL {
        say!("  {:<20}{}", target.name(), target.purpose());
    }
    say!(
        "\nBuild parameters (--param NAME=VALUE){:>23} {:>13} {:>13}",
        Config::NAMES[0],
        Config::NAMES[1],
        Config::NAMES[2]
    );
    let configs = [Config::DEFAULT, Config::PAPER, Config::FULL];
    for parameter in &PARAMETERS {
        let name = format!("{}={}", parameter.name, parameter.values.join("|"));
        let values = configs.map(|c| format!("{:>13}", c.value(parameter)));
        say!("  {name:<45}{:>13} {} {}", values[0].trim(), values[1], values[2]);
        say!("      {}", parameter.help);
    }
    say!("\nRun parameters (--param NAME=VALUE), the first value is the usual one");
    for parameter in &RUN_PARAMETERS {
        say!("  {}={}\n      {}", parameter.name, parameter.values.join("|"), parameter.help);
    }
    say!("\nScenes (--scene NAME), or a file: .obj mesh, .json scene, or .png, .txt or .grid heights");
    for scene in &builtin::SCENES {
        say!("  {:<20}{}", scene.name, scene.description);
    }
    say!("\nProjections (--projection NAME, or in a rig file), the first is the usual one");
    for kind in Kind::ALL {
        say!("  {:<20}{}", kind.name(), kind.description());
    }
    say!("\nExperiments (wheatstone reproduce NAME)");
    for experiment in EXPERIMENTS {
        say!("  {:<20}{}", experiment.name, experiment.description);
    }
    Ok(OK)
}

fn list_json() -> serde_json::Value {
    let parameter = |p: &Parameter| serde_json::json!({ "name": p.name, "verilog": p.verilog, "values": p.values, "help": p.help });
    serde_json::json!({
        "targets": Target::ALL.map(|t| serde_json::json!({
            "name": t.name(), "module": t.module(), "system": t.is_system(), "purpose": t.purpose(),
        })),
        "build_parameters": PARAMETERS.iter().map(parameter).collect::<Vec<_>>(),
        "run_parameters": RUN_PARAMETERS.iter().map(parameter).collect::<Vec<_>>(),
        "configurations": Config::NAMES,
        "scenes": builtin::SCENES.iter().map(|s| serde_json::json!({
            "name": s.name, "description": s.description,
        })).collect::<Vec<_>>(),
        "projections": Kind::ALL.map(|kind| serde_json::json!({
            "name": kind.name(), "description": kind.description(),
        })),
        "experiments": EXPERIMENTS.iter().map(|e| serde_json::json!({
            "name": e.name, "description": e.description,
        })).collect::<Vec<_>>(),
    })
}

pub(super) fn doctor(_: &DoctorArgs) -> Result<u8, Failure> {
    let doctor = Doctor::examine();
    say!("{doctor}");
    Ok(if doctor.is_ready() { OK } else { MISSING_TOOL })
}
