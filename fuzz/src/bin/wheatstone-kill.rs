//! `wheatstone-kill`: runs of the program, killed wherever they change a file.

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;
use wheatstone_fuzz::kill::{Killer, CASES};

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
    /// Seed of these places
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The program [default: wheatstone beside this one]
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
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

/// Whether all was whole.
fn run(args: &Args) -> std::io::Result<bool> {
    let beside = std::env::current_exe()?.with_file_name("wheatstone");
    let program = std::path::absolute(args.program.as_ref().unwrap_or(&beside))?;
    let workspace = std::path::absolute(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))?;
    let scratch = tempfile::tempdir()?;
    let killer = Killer { program, workspace, scratch: scratch.path().to_owned() };
    killer.prepare()?;
    let names = CASES.map(|case| case.name);
    if let Some(unknown) = args.cases.iter().find(|name| !names.contains(&&name[..])) {
        let why = format!("no case “{unknown}”; there are: {}", names.join(", "));
        return Err(std::io::Error::other(why));
    }
    let mut total = 0;
    for case in &CASES {
        if !args.cases.is_empty() && !args.cases.iter().any(|name| name == case.name) {
            continue;
        }
        // Packs and pictures are made by the program alone.
        let children = if case.out.is_none() { args.children } else { 0 };
        let (faults, kills) = killer.run(case, children, args.seed)?;
        println!("{}: {kills} kills, {} faults", case.name, faults.len());
        faults.iter().for_each(|fault| println!("  {fault}"));
        total += faults.len();
    }
    Ok(total == 0)
}
