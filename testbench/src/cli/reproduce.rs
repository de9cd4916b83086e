//! `wheatstone reproduce`.

use super::failure::{Failure, MISMATCH, OK};
use super::places::Places;
use super::progress::Spinner;
use super::words::called;
use clap::Args;
use std::path::PathBuf;
use wheatstone_golden::files;
use wheatstone_golden::text::printable_path;
use wheatstone_studies::reproduce::{json, run as run_experiments, Event, Summary};
use wheatstone_studies::{Experiment, EXPERIMENTS};

/// The name that stands for all experiments.
const ALL: &str = "all";

/// Exit status: 0 all figures hold, 1 a figure differs, 2 bad input.
#[derive(Debug, Args)]
pub(super) struct ReproduceArgs {
    /// Experiment (see `wheatstone list`), or all of them
    #[arg(value_name = "EXPERIMENT|all", default_value = ALL, value_parser = parse_experiments)]
    experiments: Experiments,
    /// Folder for tables, plots and pictures, a folder an experiment; it is made if need be
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Write all reports into this JSON file too
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug)]
struct Experiments(&'static [Experiment]);

fn parse_experiments(text: &str) -> Result<Experiments, String> {
    if text == ALL {
        return Ok(Experiments(EXPERIMENTS));
    }
    let one = EXPERIMENTS.iter().find(|e| e.name == text).map(std::slice::from_ref);
    one.map(Experiments).ok_or_else(|| {
        let names: Vec<&str> = EXPERIMENTS.iter().map(|e| e.name).collect();
        format!("no such experiment; there are: {}, {ALL}", names.join(", "))
    })
}

pub(super) fn run(args: &ReproduceArgs) -> Result<u8, Failure> {
    Places::default().file("--json", &args.json).folder("--out", Some(&args.out)).check()?;
    let spinner = Spinner::new();
    let reports = run_experiments(args.experiments.0, &args.out, |event| match event {
        Event::Begin(experiment) => spinner.tell(experiment.name, experiment.description),
        Event::End(report, time) => spinner.print(|| {
            say!("{}, {}: {time:.1?}\n", report.experiment, report.publication);
            report.tables.iter().for_each(|table| say!("{table}"));
            report.files.iter().for_each(|file| say!("file {}", printable_path(file)));
        }),
    });
    drop(spinner);
    let reports = reports?;
    let command = called();
    let content = json(&reports, &command);
    for file in [Some(&args.out.join("reproduce.json")), args.json.as_ref()].into_iter().flatten() {
        files::write(file, content.as_bytes())?;
    }
    for row in reports.iter().flat_map(|report| report.differing()) {
        say!("DIFFERS {}", row.what);
    }
    let Summary { holds, differs, trend, quoted } = Summary::of(&reports);
    let all = holds + differs + trend + quoted;
    say!("{all} figures: {holds} hold, {differs} differ, {trend} trend, {quoted} quoted");
    Ok(if differs > 0 { MISMATCH } else { OK })
}
