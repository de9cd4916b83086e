//! `wheatstone cover`.

use super::builder::builder;
use super::failure::{Failure, MISMATCH, OK};
use super::folders::{output_folder, rtl_folder};
use super::options::parse_target;
use super::places::Places;
use super::progress::{is_terminal, Spinner};
use super::records::{checked, update_record, verification_record};
use super::words::called;
use crate::cover::{self, Counts, Report, Waiver};
use crate::regression::{Event, Plan, Waves, BEATS_LIMIT};
use crate::settings::Settings;
use crate::verification::{self, Record};
use crate::workspace;
use clap::Args;
use std::path::{Path, PathBuf};
use wheatstone_golden::files::{self, Set};
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::printable_path;

/// Empty bins and missing points that are named on the terminal.
const SHOWN: usize = 40;

#[derive(Debug, Args)]
pub(super) struct CoverArgs {
    /// Units and systems (see `wheatstone list`); none means all, and that everything must be covered
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Random beats of each target in each configuration
    #[arg(long, default_value_t = cover::BEATS, value_parser = clap::value_parser!(u64).range(1..=BEATS_LIMIT))]
    beats: u64,
    /// Seed of random beats and stalls
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a JSON report
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write what is covered into the record; `wheatstone generate` then renews the tables
    #[arg(long, conflicts_with_all = ["targets", "beats", "seed", "rtl"])]
    record: bool,
    /// Compare with the committed record: exit status 1 if a file has fewer lines or bits covered, or more that
    /// are waived, if fewer bins are hit, or if something is not recorded or no longer there
    #[arg(long, conflicts_with_all = ["record", "targets", "beats", "seed"])]
    check: bool,
    /// Write every Verilog file with its counts to this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

pub(super) fn run(args: &CoverArgs) -> Result<u8, Failure> {
    Places::default().file("--json", &args.json).folder("--out", args.out.as_deref()).check()?;
    let rtl = rtl_folder(&args.rtl)?;
    let waivers = waivers()?;
    let recorded = args.check.then(verification_record).transpose()?;
    let plans = plans(args, &rtl)?;
    let spinner = Spinner::new();
    let (counts, bins) = cover::measure(builder(is_terminal())?, &plans, &|event| {
        if let Event::Begin(target, case) = event {
            spinner.tell(target.name(), case);
        }
    })?;
    drop(spinner);
    let whole = args.targets.is_empty();
    let mut report = Report::new(&counts, &waivers);
    if !whole {
        // What other targets or configurations would cover is not missing here.
        report.stale.clear();
    }
    let bins = whole.then_some(&bins);
    say!("{}", cover::table(&report, bins));
    let command = called();
    if let Some(file) = &args.json {
        files::write(file, cover::json(&report, bins, &command).as_bytes())?;
    }
    if let Some(out) = &args.out {
        annotate(out, &rtl, &counts, &report)?;
    }
    if let (true, Some(bins)) = (args.record, bins) {
        update_record(|record| record.cover(&report, bins))?;
    }
    let status = verdict(&report, bins);
    let (Some(recorded), Some(bins)) = (recorded, bins) else { return Ok(status) };
    let mut now = Record::default();
    now.cover(&report, bins);
    Ok(status.max(checked(&recorded.cover_faults(&now), verification::FILE)))
}

/// The list of the workspace; without one nothing is waived.
fn waivers() -> Result<Vec<Waiver>, Failure> {
    let Some(file) = workspace::find().map(|root| root.join(cover::WAIVERS)) else {
        return Ok(Vec::new());
    };
    let text = files::read_own(&file)
        .map_err(|error| Failure::Input(format!("{}: {error}", printable_path(&file))))?;
    Ok(Waiver::parse(&text).map_err(cover::CoverError::from)?)
}

/// One plan a configuration.
fn plans(args: &CoverArgs, rtl: &Path) -> Result<Vec<Plan<'static>>, Failure> {
    let targets = match &args.targets[..] {
        [] => Target::ALL.to_vec(),
        some => some.to_vec(),
    };
    let plan = |(name, parameters): (&str, &[&str])| {
        Ok(Plan {
            targets: targets.clone(),
            settings: Settings::new(name, parameters)?,
            program: "wheatstone".into(),
            words: Vec::new(),
            case: None,
            scenes: Vec::new(),
            scenes_only: false,
            seed: args.seed,
            beats: Some(args.beats),
            jobs: std::thread::available_parallelism().map_or(1, usize::from),
            waves: Waves::Never,
            rtl: rtl.to_owned(),
            out: output_folder("cover"),
        })
    };
    cover::CONFIGURATIONS.into_iter().map(plan).collect()
}

/// Writes every file with its counts.
fn annotate(out: &Path, rtl: &Path, counts: &Counts, report: &Report) -> Result<(), Failure> {
    let set = Set::new(out)?;
    for name in report.files.keys() {
        let source = rtl.join(name);
        let text = files::read_own(&source)
            .map_err(|error| Failure::Input(format!("{}: {error}", printable_path(&source))))?;
        let file = set.path().join(format!("{name}.txt"));
        files::write(&file, cover::annotated(name, &text, counts, report).as_bytes())?;
    }
    // The counts of an older run are of other stimulus.
    Ok(set.finish("", |name| name.ends_with(".v.txt"))?)
}

/// Tells what is missing; of some targets alone much may be.
fn verdict(report: &Report, bins: Option<&cover::Bins>) -> u8 {
    let missing = report
        .missing
        .iter()
        .map(|p| format!("missing {} line {}: {} {}", p.file, p.line, p.kind.name(), p.name));
    let empty = bins.into_iter().flat_map(|bins| bins.empty());
    let empty = empty.map(|bin| format!("empty bin: {bin}"));
    let stale = report.stale.iter().map(|w| {
        let kind = w.kind.name();
        format!("{}: nothing needs the waiver {} {kind} {}", cover::WAIVERS, w.file, w.name)
    });
    let faults: Vec<String> = missing.chain(empty).chain(stale).collect();
    if faults.is_empty() {
        return OK;
    }
    say!("");
    faults.iter().take(SHOWN).for_each(|fault| say!("{fault}"));
    if faults.len() > SHOWN {
        say!("and {} more, see --json FILE", faults.len() - SHOWN);
    }
    MISMATCH
}
