//! `wheatstone-kill`: runs of the program, killed wherever they change a file.

use clap::Parser;
use std::process::ExitCode;
use wheatstone_fuzz::kill::{Killer, CASES};
use wheatstone_fuzz::program;

#[derive(Debug, Parser)]
#[command(
    about = "Kill wheatstone at every call that changes a file; exit status 1 if something half is left. Needs strace"
)]
struct Args {
    /// Cases, for example vectors; none means all
    cases: Vec<String>,
    /// Random places at which the compilers of a regression are killed
    #[arg(long, default_value_t = 200)]
    children: usize,
    #[command(flatten)]
    options: program::Options,
}

fn main() -> ExitCode {
    let args = Args::parse();
    program::main(|| run(&args))
}

/// Kills the runs; true if all was whole.
fn run(args: &Args) -> std::io::Result<bool> {
    let scratch = tempfile::tempdir()?;
    let killer = Killer {
        program: args.options.program()?,
        workspace: program::workspace()?,
        scratch: scratch.path().to_owned(),
    };
    let names = program::chosen(&args.cases, &CASES.map(|case| case.name), "case")?;
    killer.prepare()?;
    let mut total = 0;
    for case in CASES.iter().filter(|case| names.contains(&case.name)) {
        let children = if case.calls { args.children } else { 0 };
        let (faults, kills) = killer.run(case, children, args.options.seed)?;
        println!("{}: {kills} kills, {} faults", case.name, faults.len());
        faults.iter().for_each(|fault| println!("  {fault}"));
        total += faults.len();
    }
    Ok(total == 0)
}
