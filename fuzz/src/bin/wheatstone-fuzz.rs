//! `wheatstone-fuzz`: damaged input of every kind, as much of it as is asked for.

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;
use wheatstone_fuzz::{kinds, Kind, Plan, Tally};

#[derive(Debug, Parser)]
#[command(
    about = "Feed damaged input of every kind to wheatstone; exit status 1 if it does what it must not"
)]
struct Args {
    /// Kinds of input, for example obj or manifest; none means all
    kinds: Vec<String>,
    /// Inputs of each kind
    #[arg(long, default_value_t = 2000)]
    inputs: usize,
    /// Seed of the damage
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The program [default: wheatstone beside this one]
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
    /// Keep the inputs of what is found
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Whether nothing was found.
fn run(args: &Args) -> std::io::Result<bool> {
    let beside = std::env::current_exe()?.with_file_name("wheatstone");
    let program = std::path::absolute(args.program.as_ref().unwrap_or(&beside))?;
    let workspace = std::path::absolute(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))?;
    let folder = tempfile::tempdir()?;
    let all = kinds::all(&program, &workspace, folder.path())?;
    let mut names: Vec<&str> = all.iter().map(|kind| kind.name).collect();
    names.dedup();
    if let Some(unknown) = args.kinds.iter().find(|name| !names.contains(&&name[..])) {
        let why = format!("no kind “{unknown}”; there are: {}", names.join(", "));
        return Err(std::io::Error::other(why));
    }
    let plan = Plan { program, inputs: args.inputs, seed: args.seed, keep: args.keep.clone() };
    let mut total = 0;
    for name in names {
        if !args.kinds.is_empty() && !args.kinds.iter().any(|wanted| wanted == name) {
            continue;
        }
        let of_name: Vec<Kind> = all.iter().filter(|kind| kind.name == name).cloned().collect();
        let Tally { inputs, read, findings } = plan.run(&of_name)?;
        println!("{name}: {inputs} inputs, {read} read, {} findings", findings.len());
        for finding in &findings {
            println!(
                "  {}: {}\n    {}",
                finding.number,
                finding.what,
                finding.said.replace('\n', "\n    ")
            );
        }
        total += findings.len();
    }
    println!("{total} findings");
    Ok(total == 0)
}
