//! `wheatstone synth`.

use super::failure::{Failure, OK};
use super::folders::{cache_folder, root, rtl_folder};
use super::ignored::refuse_unbuilt;
use super::options::parse_target;
use super::places::Places;
use super::progress::Spinner;
use super::records::{checked, recorded};
use super::words::called;
use crate::settings::Settings;
use crate::synth::record::{self, published, Entry, Record};
use crate::synth::{Figure, Synthesiser, Tech};
use crate::workspace;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::PathBuf;
use wheatstone_golden::config::Config;
use wheatstone_golden::files;
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::Grouped;

#[derive(Debug, Args)]
pub(super) struct SynthArgs {
    /// Units and systems (see `wheatstone list`); none means all
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Technologies to synthesise for, several with commas
    #[arg(long, value_enum, value_delimiter = ',', default_value = "gates")]
    tech: Vec<TechChoice>,
    /// Named set of build parameters [default: each of the three]
    #[arg(long, value_name = "default|paper|full")]
    config: Option<String>,
    /// Change one parameter (see `wheatstone list`); may be repeated
    #[arg(long = "param", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// Write a JSON report
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Compare with the committed record: exit status 1 if an area differs by more than 2 %, a clock has
    /// fallen by more than 10 % or below what is asked for, or something is not recorded
    #[arg(long, conflicts_with_all = ["record", "parameters"])]
    check: bool,
    /// Write what was measured into the record; `wheatstone generate` then renews the tables
    #[arg(long, conflicts_with_all = ["parameters", "rtl"])]
    record: bool,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TechChoice {
    /// NAND2-equivalent gates in two libraries
    Gates,
    /// Lattice iCE40 HX8K
    Ice40,
    /// Lattice ECP5-45, speed grade 6
    Ecp5,
}

pub(super) fn run(args: &SynthArgs) -> Result<u8, Failure> {
    Places::default().file("--json", &args.json).check()?;
    let tasks = tasks(args)?;
    let rtl = rtl_folder(&args.rtl)?;
    let cache = cache_folder(workspace::find(), Synthesiser::CACHE, |name| std::env::var_os(name));
    let synthesiser = Synthesiser { rtl, cache };
    let spinner = Spinner::new();
    let entries: Result<Vec<Entry>, Failure> = tasks
        .par_iter()
        .map(|task| {
            let Task { target, label, config, tech } = task;
            let figures = synthesiser.measure(*target, config, *tech)?;
            spinner.tell(&format!("{} {label}", target.name()), tech.name());
            let (target, config) = (target.name().to_owned(), label.clone());
            Ok(Entry { target, config, tech: *tech, figures })
        })
        .collect();
    drop(spinner);
    let entries = entries?;
    for tech in Tech::ALL {
        print_table(&entries, tech);
    }
    if let Some(file) = &args.json {
        let content = serde_json::json!({
            "command": called(),
            "measured": entries,
        });
        files::write(file, format!("{content:#}\n").as_bytes())?;
    }
    match (args.record, args.check) {
        (true, _) => write_record(&entries).map(|()| OK),
        (_, true) => check(&entries),
        _ => Ok(OK),
    }
}

/// One target, built in one way for one technology.
struct Task {
    target: Target,
    label: String,
    config: Config,
    tech: Tech,
}

fn tasks(args: &SynthArgs) -> Result<Vec<Task>, Failure> {
    let targets = match &args.targets[..] {
        [] => Target::ALL.to_vec(),
        some => some.to_vec(),
    };
    let names = match &args.config {
        Some(name) => vec![name.as_str()],
        None => Config::NAMES.to_vec(),
    };
    let mut tasks = Vec::new();
    for tech in &args.tech {
        let tech = match tech {
            TechChoice::Gates => Tech::Gates,
            TechChoice::Ice40 => Tech::Ice40,
            TechChoice::Ecp5 => Tech::Ecp5,
        };
        for name in &names {
            let config = Settings::new(name, &args.parameters)?.config;
            refuse_unbuilt(&args.parameters, &config, &targets)?;
            let changed = args.parameters.iter().map(|text| format!(" {text}"));
            let label = format!("{name}{}", changed.collect::<String>());
            let task = |&target| Task { target, label: label.clone(), config, tech };
            tasks.extend(targets.iter().map(task));
        }
    }
    // The largest first, so that none is left over at the end.
    tasks.sort_by_key(|task| !task.target.is_system());
    Ok(tasks)
}

fn print_table(entries: &[Entry], tech: Tech) {
    let entries: Vec<&Entry> = entries.iter().filter(|entry| entry.tech == tech).collect();
    if entries.is_empty() {
        return;
    }
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::NOTHING);
    let mut heading = vec![tech.name(), "configuration"];
    heading.extend(tech.figures().iter().map(|figure| figure.heading()));
    if tech == Tech::Gates {
        heading.push("paper");
    }
    table.set_header(heading);
    for entry in entries {
        let mut cells = vec![entry.target.clone(), entry.config.clone()];
        cells.extend(tech.figures().iter().map(|figure: &Figure| entry.shown(*figure)));
        let gates = Target::named(&entry.target).and_then(published);
        if let (Tech::Gates, Some(gates)) = (tech, gates) {
            cells.push(Grouped(gates.into()).to_string());
        }
        table.add_row(cells);
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(comfy_table::CellAlignment::Right);
    }
    say!("{table}\n");
}

fn write_record(entries: &[Entry]) -> Result<(), Failure> {
    let root = root()?;
    let mut record = recorded(&root, record::FILE, Record::read)?;
    record.update(entries);
    record.write(&root)?;
    say!("{}: written; now run: wheatstone generate", record::FILE);
    Ok(())
}

fn check(entries: &[Entry]) -> Result<u8, Failure> {
    let faults = Record::read(&root()?)?.faults(entries);
    Ok(checked(&faults, record::FILE))
}
