//! `wheatstone-fuzz`: damaged input of every kind, as much of it as is asked for.

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;
use wheatstone_fuzz::{kinds, program, Kind, Plan, Tally};

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
    /// Keep the inputs of what is found
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    #[command(flatten)]
    options: program::Options,
}

fn main() -> ExitCode {
    let args = Args::parse();
    program::main(|| run(&args))
}

/// Runs the inputs; true if nothing was found.
fn run(args: &Args) -> std::io::Result<bool> {
    let program = args.options.program()?;
    let folder = tempfile::tempdir()?;
    let all = kinds::all(&program, &program::workspace()?, folder.path())?;
    let mut names: Vec<&str> = all.iter().map(|kind| kind.name).collect();
    names.dedup();
    let keep = args.keep.as_ref().map(std::path::absolute).transpose()?;
    let plan = Plan { program, inputs: args.inputs, seed: args.options.seed, keep };
    let mut total = 0;
    for name in program::chosen(&args.kinds, &names, "kind")? {
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
