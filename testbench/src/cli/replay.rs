//! `wheatstone replay`.

use super::failure::{Failure, MISMATCH, OK};
use super::folders::{cache_folder, rtl_folder};
use super::options::parse_target;
use super::places::Places;
use super::progress::Spinner;
use super::records::{checked, update_record, verification_record};
use super::words::called;
use crate::numbers::counted;
use crate::pack::{self, Checked, Origin, BEATS_LIMIT};
use crate::replay::{ReplayError, Replayed, Replayer, Way};
use crate::settings::Settings;
use crate::synth::Synthesiser;
use crate::verification::{self, Replay};
use crate::{cases, workspace};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use wheatstone_golden::files::{self, Scratch};
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::printable_path;

/// Random beats of a pack, beside what is rare: what the netlist of a system takes in some minutes.
const BEATS: u64 = 1_000;

#[derive(Debug, Args)]
pub(super) struct ReplayArgs {
    /// Units and systems (see `wheatstone list`); none means all
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Replay the packs in this folder [default: packs as `vectors` writes them, made for the occasion]
    #[arg(long, value_name = "DIR", conflicts_with_all = ["config", "beats", "seed"])]
    packs: Option<PathBuf>,
    /// Ways to replay, several with commas
    #[arg(
        long = "with",
        value_enum,
        value_delimiter = ',',
        value_name = "WAY",
        default_value = "icarus,cocotb,gates,osu035"
    )]
    ways: Vec<WayChoice>,
    /// Named sets of build parameters, several with commas
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "default,paper",
        value_name = "default|paper|full"
    )]
    config: Vec<String>,
    /// Number of random beats of each pack
    #[arg(long, default_value_t = BEATS, value_parser = clap::value_parser!(u64).range(1..=BEATS_LIMIT))]
    beats: u64,
    /// Seed of random beats
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a JSON report
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write what was equal into the record; `wheatstone generate` then renews the tables
    #[arg(long, conflicts_with_all = ["packs", "beats", "seed", "rtl"])]
    record: bool,
    /// Compare with the committed record: exit status 1 if a pack is not in it, differs from it in its number of
    /// beats, or is not equal any more
    #[arg(long, conflicts_with_all = ["record", "packs", "beats", "seed"])]
    check: bool,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WayChoice {
    /// The Verilog in Icarus
    Icarus,
    /// The Verilog in Icarus, driven from Python (scripts/replay.py)
    Cocotb,
    /// The netlist of gates in Icarus
    Gates,
    /// The netlist of OSU 0.35 µm standard cells in Icarus
    Osu035,
}

impl WayChoice {
    fn way(self) -> Way {
        match self {
            WayChoice::Icarus => Way::Icarus,
            WayChoice::Cocotb => Way::Cocotb,
            WayChoice::Gates => Way::Gates,
            WayChoice::Osu035 => Way::Osu035,
        }
    }
}

/// A pack and how it is called in the table.
struct Named {
    label: String,
    /// The configuration it was made in, if it was made here.
    config: String,
    pack: Checked,
}

impl Named {
    /// Name of the pack: that of its folder.
    fn name(&self) -> String {
        self.pack.folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Its line in the record.
    fn replay(&self, way: Way) -> Replay {
        let (pack, config) = (self.name(), self.config.clone());
        let beats = self.pack.manifest.beats();
        Replay { pack, config, way: way.name().to_owned(), beats }
    }
}

pub(super) fn run(args: &ReplayArgs) -> Result<u8, Failure> {
    Places::default().file("--json", &args.json).check()?;
    let rtl = rtl_folder(&args.rtl)?;
    let recorded = args.check.then(verification_record).transpose()?;
    let cache = cache_folder(workspace::find(), Synthesiser::CACHE, |name| std::env::var_os(name));
    let made = Scratch::below(&std::env::temp_dir())?;
    let packs = match &args.packs {
        Some(folder) => found(folder, &args.targets)?,
        None => make(args, &rtl, made.path())?,
    };
    let replayer = Replayer { synthesiser: Synthesiser { rtl, cache } };
    let mut tasks: Vec<(&Named, Way)> = packs
        .iter()
        .flat_map(|named| args.ways.iter().map(move |choice| (named, choice.way())))
        .collect();
    // The largest first, so that none is left over at the end.
    tasks.sort_by_key(|(named, _)| {
        !Target::named(&named.pack.manifest.target).is_some_and(Target::is_system)
    });
    let spinner = Spinner::new();
    let results: Result<Vec<(&Named, Way, Replayed)>, ReplayError> = tasks
        .par_iter()
        .with_max_len(1)
        .map(|&(named, way)| {
            let replayed = replayer.replay(&named.pack, way)?;
            let what =
                format!("{} in {:.1} s", verdict(named, &replayed), replayed.time.as_secs_f64());
            spinner.tell(&format!("{} {}", named.label, way.name()), &what);
            Ok((named, way, replayed))
        })
        .collect();
    drop(spinner);
    let results = results?;
    print_table(&packs, &args.ways, &results);
    if let Some(file) = &args.json {
        files::write(file, json(&results).as_bytes())?;
    }
    let replays = results.iter().map(|(named, way, r)| (named.replay(*way), r.passed));
    let replays: Vec<(Replay, bool)> = replays.collect();
    if args.record {
        update_record(|record| record.replay(&replays))?;
    }
    let mut status = OK;
    for (named, way, replayed) in results.iter().filter(|(.., replayed)| !replayed.passed) {
        say!("\nMISMATCH {} {}\n{}", named.label, way.name(), replayed.said);
        status = MISMATCH;
    }
    if let Some(recorded) = recorded {
        status = status.max(checked(&recorded.replay_faults(&replays), verification::FILE));
    }
    Ok(status)
}

/// The packs of a folder, of these targets or of all.
fn found(folder: &Path, targets: &[Target]) -> Result<Vec<Named>, Failure> {
    let is_wanted = |pack: &Checked| {
        targets.is_empty() || targets.iter().any(|t| t.name() == pack.manifest.target)
    };
    let packs = pack::check(folder)?.into_iter().filter(is_wanted);
    let packs: Vec<Named> = packs
        .map(|pack| Named { label: printable_path(&pack.folder), config: String::new(), pack })
        .collect();
    if packs.is_empty() {
        let names = targets.iter().map(|t| t.name()).collect::<Vec<_>>().join(", ");
        return Err(Failure::Input(format!("{}: no pack of {names}", printable_path(folder))));
    }
    Ok(packs)
}

/// Packs as `wheatstone vectors` writes them.
fn make(args: &ReplayArgs, rtl: &Path, out: &Path) -> Result<Vec<Named>, Failure> {
    let targets = match &args.targets[..] {
        [] => Target::ALL.to_vec(),
        some => some.to_vec(),
    };
    let mut packs = Vec::new();
    for name in &args.config {
        let config = Settings::new::<&str>(name, &[])?.config;
        let origin = Origin { config: name.clone(), ..Origin::random(args.seed) };
        for &target in &targets {
            let hash = pack::rtl_hash(rtl, target.module())?;
            for (suffix, case) in cases::for_packs(target, &config, args.seed, args.beats as usize)
            {
                let origin = Origin { suffix, ..origin.clone() };
                let written = pack::write(&case, &origin, &hash, &out.join(name))?;
                for pack in pack::check(&written.folder)? {
                    let label = format!("{}{suffix} {name}", target.name());
                    packs.push(Named { label, config: name.clone(), pack });
                }
            }
        }
    }
    Ok(packs)
}

/// The result of a replay in a table: of a pack without output beats that its flags are equal.
fn verdict(named: &Named, replayed: &Replayed) -> &'static str {
    match (replayed.passed, named.pack.manifest.compared()) {
        (false, _) => "MISMATCH",
        (true, 0) => "flags equal",
        (true, _) => "equal",
    }
}

fn print_table(packs: &[Named], ways: &[WayChoice], results: &[(&Named, Way, Replayed)]) {
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::NOTHING);
    let ways: Vec<Way> = ways.iter().map(|choice| choice.way()).collect();
    let names = ways.iter().map(|way| way.name());
    table.set_header(["pack", "beats", "compared"].into_iter().chain(names));
    for named in packs {
        let cell = |way: &Way| {
            let result = results.iter().find(|(n, w, _)| std::ptr::eq(*n, named) && w == way);
            result.map_or(String::new(), |(.., replayed)| match replayed.passed {
                true => {
                    format!("{} {:.1} s", verdict(named, replayed), replayed.time.as_secs_f64())
                }
                false => verdict(named, replayed).into(),
            })
        };
        let manifest = &named.pack.manifest;
        let beats = [manifest.beats(), manifest.compared()].map(|beats| beats.to_string());
        let row = [named.label.clone()].into_iter().chain(beats);
        table.add_row(row.chain(ways.iter().map(cell)));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(comfy_table::CellAlignment::Right);
    }
    let failed = results.iter().filter(|(.., replayed)| !replayed.passed).count();
    let replays = counted(results.len() as u64, "replay");
    say!("{table}\n\n{replays}, mismatches {failed}");
}

fn json(results: &[(&Named, Way, Replayed)]) -> String {
    let entry = |(named, way, replayed): &(&Named, Way, Replayed)| {
        let manifest = &named.pack.manifest;
        let compared = manifest.outputs().map(|port| (&port.name, port.beats));
        let compared: BTreeMap<_, _> = compared.collect();
        serde_json::json!({
            "pack": named.label, "target": manifest.target, "with": way.name(),
            "beats": manifest.beats(), "passed": replayed.passed, "compared": compared,
            "flags": manifest.flags.iter().map(|flag| &flag.name).collect::<Vec<_>>(),
            "seconds": replayed.time.as_secs_f64(),
        })
    };
    let content = serde_json::json!({
        "command": called(),
        "replays": results.iter().map(entry).collect::<Vec<_>>(),
    });
    format!("{content:#}\n")
}
