//! `wheatstone mutate`.

use super::builder::builder;
use super::failure::{Failure, MISMATCH, OK};
use super::folders::{cache_folder, root, rtl_folder};
use super::ignored::refuse_unbuilt;
use super::options::parse_target;
use super::places::Places;
use super::progress::{is_terminal, Spinner};
use super::records::{checked, recorded};
use crate::mutation::record::{Reviews, Score, Scores, FILE, HEADINGS, REVIEWED_FILE};
use crate::mutation::{
    golden, is_usual, regression, usual_config, Fate, Mutated, Tested, COUNT, SEED,
};
use crate::regression::BEATS_LIMIT;
use crate::settings::Settings;
use crate::synth::Synthesiser;
use crate::{workspace, Builder};
use clap::Args;
use std::path::{Path, PathBuf};
use wheatstone_golden::files;
use wheatstone_golden::targets::Target;

/// Most mutants of a target: the netlist chooses by 16 bits.
const MOST: i64 = 60_000;

#[derive(Debug, Args)]
pub(super) struct MutateArgs {
    /// Units and systems (see `wheatstone list`); none means all but mono, hybrid and stereo
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Mutants of each target
    #[arg(long, value_name = "N", default_value_t = COUNT, value_parser = clap::value_parser!(u32).range(1..=MOST))]
    count: u32,
    /// Seed of the choice of mutants
    #[arg(long, default_value_t = SEED)]
    seed: u64,
    /// Number of random beats of each target [default: as in the default regression]
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=BEATS_LIMIT))]
    beats: Option<u64>,
    /// Change the golden models of units instead, with cargo mutants, and run the units' own tests; none means
    /// all units
    #[arg(long, conflicts_with_all = ["count", "seed", "beats", "config", "parameters", "rtl"])]
    golden: bool,
    /// Named set of build parameters [default: default; of coverage full, as there is little of it without
    /// samples]
    #[arg(long, value_name = "default|paper|full")]
    config: Option<String>,
    /// Change one parameter (see `wheatstone list`); may be repeated
    #[arg(long = "param", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// Write all mutants, and what became of them, as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the scores into the record; `wheatstone generate` then renews the table
    #[arg(long, conflicts_with_all = ["count", "seed", "beats", "rtl"])]
    record: bool,
    /// Compare with the committed record: exit status 1 if a target is not in it, or its score is lower than
    /// there or below 95 %
    #[arg(long, conflicts_with_all = ["record", "count", "seed", "beats"])]
    check: bool,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

impl MutateArgs {
    fn targets(&self) -> Vec<Target> {
        let usual = |target: &Target| match self.golden {
            true => golden::is_unit(*target),
            false => is_usual(*target),
        };
        match &self.targets[..] {
            [] => Target::ALL.into_iter().filter(usual).collect(),
            some => some.to_vec(),
        }
    }

    /// Name of the configuration of a target.
    fn config(&self, target: Target) -> &str {
        let usual = if self.golden { golden::CONFIG } else { usual_config(target) };
        self.config.as_deref().unwrap_or(usual)
    }

    /// The configuration, with the parameters that were changed.
    fn label(&self, target: Target) -> String {
        let changed = self.parameters.iter().map(|text| format!(" {text}"));
        format!("{}{}", self.config(target), changed.collect::<String>())
    }
}

/// The result for a target.
struct Found {
    score: Score,
    tested: Vec<Tested<String>>,
    json: serde_json::Value,
    stale: Vec<String>,
}

pub(super) fn run(args: &MutateArgs) -> Result<u8, Failure> {
    Places::default().file("--json", &args.json).check()?;
    let root = root()?;
    if let Some(system) =
        args.targets.iter().find(|target| args.golden && !golden::is_unit(**target))
    {
        let why = format!("{}: only golden models of units have mutants", system.name());
        return Err(Failure::Input(why));
    }
    for target in args.targets().into_iter().filter(|_| !args.golden) {
        let config = Settings::new(args.config(target), &args.parameters)?.config;
        refuse_unbuilt(&args.parameters, &config, &args.targets())?;
    }
    let reviews = Reviews::read(&root)?;
    let scores = args.check.then(|| Scores::read(&root)).transpose()?;
    // Golden models are tested without a simulator.
    let builder = (!args.golden).then(|| builder(is_terminal())).transpose()?;
    let spinner = Spinner::new();
    let found = args.targets().into_iter().map(|target| {
        let found = test(args, &root, target, builder.as_ref(), &reviews)?;
        let [mutants, .., score] = found.score.cells();
        spinner.tell(target.name(), &format!("{score} of {mutants} mutants"));
        if args.record {
            record(&root, &found.score)?;
        }
        Ok(found)
    });
    let found = found.collect::<Result<Vec<Found>, Failure>>()?;
    drop(spinner);
    print(&found);
    if let Some(file) = &args.json {
        let targets = found
            .iter()
            .map(|found| serde_json::json!({ "score": found.score, "mutants": found.json }));
        let content = serde_json::json!({
            "format": "wheatstone-mutation/1",
            "targets": targets.collect::<Vec<_>>(),
        });
        files::write(file, format!("{content:#}\n").as_bytes())?;
    }
    if args.record {
        say!("{FILE}: written; now run: wheatstone generate");
    }
    Ok(verdict(&found, scores.as_ref()))
}

/// Tells which scores are too low, or worse than those on record, and gives the exit status.
fn verdict(found: &[Found], recorded: Option<&Scores>) -> u8 {
    let scores: Vec<Score> = found.iter().map(|found| found.score.clone()).collect();
    let is_good = match recorded {
        Some(recorded) => checked(&recorded.faults(&scores), FILE) == OK,
        None => {
            scores.iter().filter_map(Score::low).for_each(|low| say!("{low}"));
            scores.iter().all(|score| score.low().is_none())
        }
    };
    match is_good && found.iter().all(|found| found.stale.is_empty()) {
        true => OK,
        false => MISMATCH,
    }
}

/// Writes a score into the record of the workspace, so that a run that is stopped loses none before it.
fn record(root: &Path, score: &Score) -> Result<(), Failure> {
    let mut scores = recorded(root, FILE, Scores::read)?;
    scores.update(std::slice::from_ref(score));
    Ok(scores.write(root)?)
}

fn test(
    args: &MutateArgs,
    root: &Path,
    target: Target,
    builder: Option<&Builder>,
    reviews: &Reviews,
) -> Result<Found, Failure> {
    let label = args.label(target);
    // There is none where it is golden models that are tested.
    let Some(builder) = builder else {
        let reason = |mutant: &str| reviews.reason(target, &label, &mutant);
        let tested = golden::test(root, target, reason)?;
        let json = serde_json::json!(tested);
        return Ok(found(args, target, reviews, tested, json));
    };
    let config = Settings::new(args.config(target), &args.parameters)?.config;
    let cache = cache_folder(workspace::find(), Synthesiser::CACHE, |name| std::env::var_os(name));
    let choice = (args.count, args.seed);
    let mutated =
        Mutated::new(builder, [rtl_folder(&args.rtl)?, cache], (target, &config), choice)?;
    let runs = regression(target, &config, args.beats);
    let tested = mutated.test(runs, |mutant| reviews.reason(target, &label, mutant))?;
    let json = serde_json::json!(tested);
    let told = |t: Tested| Tested { mutant: t.mutant.to_string(), fate: t.fate };
    Ok(found(args, target, reviews, tested.into_iter().map(told).collect(), json))
}

fn found(
    args: &MutateArgs,
    target: Target,
    reviews: &Reviews,
    tested: Vec<Tested<String>>,
    json: serde_json::Value,
) -> Found {
    let label = args.label(target);
    // Of another choice of mutants the list knows nothing.
    let usual = (args.count, args.seed) == (COUNT, SEED);
    let stale = reviews.stale(target, &label, &tested).into_iter().filter(|_| usual);
    let stale = stale.map(|review| review.mutant.clone()).collect();
    Found { score: Score::new(target, &label, args.seed, &tested), tested, stale, json }
}

fn print(found: &[Found]) {
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::NOTHING);
    table.set_header(["", "configuration"].into_iter().chain(HEADINGS));
    for Found { score, .. } in found {
        let names = [score.target.clone(), score.config.clone()];
        table.add_row(names.into_iter().chain(score.cells()));
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(comfy_table::CellAlignment::Right);
    }
    say!("{table}\n");
    for Found { tested, stale, score, .. } in found {
        let name = &score.target;
        for Tested { mutant, fate } in tested {
            match fate {
                Fate::Missed => say!("MISSED {name} {mutant}: some beats show it, none here did"),
                Fate::Undecided => say!("UNDECIDED {name} {mutant}"),
                Fate::Killed(_) | Fate::Equivalent | Fate::Reviewed(_) => {}
            }
        }
        for mutant in stale {
            say!("STALE {name} {mutant}: in {REVIEWED_FILE}, but none that is left undecided has this name");
        }
    }
}
