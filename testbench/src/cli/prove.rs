//! `wheatstone prove`.

use super::failure::{Failure, MISMATCH, OK};
use super::folders::{cache_folder, root, rtl_folder};
use super::places::Places;
use super::progress::Spinner;
use super::records::{checked, recorded};
use super::words::called;
use crate::prove::record::{self, shown, Compared, Extent, Proved, Record};
use crate::prove::{name, properties, Bug, Catch, Effort, Prover, Verdict, BUGS, LIMIT};
use crate::workspace;
use clap::Args;
use rayon::prelude::*;
use std::path::PathBuf;
use std::time::Instant;
use wheatstone_golden::config::Config;
use wheatstone_golden::files::{self, Scratch};
use wheatstone_golden::targets::Target;

#[derive(Debug, Args)]
pub(super) struct ProveArgs {
    /// Modules, for example filter or slot_queue; none means all
    #[arg(value_name = "MODULE")]
    modules: Vec<String>,
    /// Only the default configuration of what is proved in seconds: about a minute
    #[arg(long, conflicts_with_all = ["record", "bugs", "netlist"])]
    quick: bool,
    /// Plant each property's bugs and see the property fail; exit status 1 if one does not
    #[arg(long, conflicts_with = "netlist")]
    bugs: bool,
    /// Compare the netlists of gates with the Verilog instead, in the configurations paper and default; exit
    /// status 1 if one differs. One that is not decided in a minute of processor time counts as not different
    #[arg(long)]
    netlist: bool,
    /// Prove anew what was proved before, and keep nothing of it
    #[arg(long)]
    fresh: bool,
    /// Write a JSON report
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Compare with the committed record: exit status 1 if something is proved for less than it says, or
    /// everything took more than 40 minutes of processor time, or a prover of the short set more than a fifth of
    /// the minute that each of them has
    #[arg(long, conflicts_with_all = ["bugs", "record"])]
    check: bool,
    /// Write what was proved into the record; `wheatstone generate` then renews docs/formal.md
    #[arg(long, conflicts_with = "bugs")]
    record: bool,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR", conflicts_with = "record")]
    rtl: Option<PathBuf>,
}

pub(super) fn run(args: &ProveArgs) -> Result<u8, Failure> {
    Places::default().file("--json", &args.json).check()?;
    let rtl = rtl_folder(&args.rtl)?;
    let cache = cache_folder(workspace::find(), Prover::CACHE, |name| std::env::var_os(name));
    let fresh = args.fresh.then(|| Scratch::below(&cache)).transpose()?;
    let cache = fresh.as_ref().map_or(cache, |folder| folder.path().to_owned());
    let prover = Prover::new(rtl, cache);
    let modules = chosen(args, &prover)?;
    match (args.bugs, args.netlist) {
        (true, _) => bugs(args, &prover, &modules),
        (_, true) => netlists(args, &prover, &modules),
        _ => proofs(args, &prover, &modules),
    }
}

/// The modules that were named, or all.
fn chosen(args: &ProveArgs, prover: &Prover) -> Result<Vec<String>, Failure> {
    let all = prover.modules()?;
    let name = |text: &String| {
        let name = text.strip_prefix("sam_").unwrap_or(text);
        let known = all.iter().any(|module| module == name);
        let there_are = || format!("no properties of “{text}”; there are: {}", all.join(", "));
        known.then(|| name.to_owned()).ok_or_else(|| Failure::Input(there_are()))
    };
    match &args.modules[..] {
        [] => Ok(all.clone()),
        some => some.iter().map(name).collect(),
    }
}

fn proofs(args: &ProveArgs, prover: &Prover, modules: &[String]) -> Result<u8, Failure> {
    let mut builds = Vec::new();
    for module in modules {
        let (effort, number) = match args.quick {
            true => (Effort::quick(module), 1),
            false => (Some(Effort::of(module)), usize::MAX),
        };
        let Some(effort) = effort else { continue };
        builds.extend(prover.builds(module)?.into_iter().take(number).map(|build| (build, effort)));
    }
    if builds.is_empty() {
        let why = format!("{}: not in the short set; leave out --quick", modules.join(", "));
        return Err(Failure::Input(why));
    }
    // The longest first, so that none is left over at the end.
    builds.sort_by_key(|(build, effort)| {
        (std::cmp::Reverse(effort.bound), !build.label.contains("full"))
    });
    let (spinner, started) = (Spinner::new(), Instant::now());
    let proved: Result<Vec<Proved>, Failure> = builds
        .par_iter()
        .with_max_len(1)
        .map(|(build, effort)| {
            let proof = prover.prove(build, *effort)?;
            spinner.tell(&build.module, &format!("{}, {:.1} s", build.label, proof.seconds));
            Ok(Proved::of(build, proof))
        })
        .collect();
    drop(spinner);
    let mut proved = proved?;
    proved.sort_by_key(|entry| entry.module.clone());
    print_proofs(prover, &proved)?;
    let proving: f64 = proved.iter().map(|entry| entry.proof.seconds).sum();
    let seconds = started.elapsed().as_secs_f64().round();
    let when = if args.fresh { "" } else { ", some of it maybe earlier" };
    say!("{seconds:.0} s on the clock; provers took {proving:.0} s of processor time{when}");
    write_json(args, "proofs", &proved)?;
    if args.record {
        update(&proved, &[])?;
    }
    let fails = |entry: &Proved| entry.proof.failed().next().is_some();
    let lost = if args.check { lost(args, &proved)? } else { OK };
    Ok(if proved.iter().any(fails) { MISMATCH } else { lost })
}

/// Tells what is proved for less than the record says, or too slowly, and gives the exit status.
fn lost(args: &ProveArgs, proved: &[Proved]) -> Result<u8, Failure> {
    let extent = if args.quick { Extent::Short } else { Extent::All };
    let mut faults = Record::read(&root()?)?.faults(proved, extent);
    faults.extend(record::slow(proved, extent));
    Ok(checked(&faults, record::FILE))
}

fn print_proofs(prover: &Prover, proved: &[Proved]) -> Result<(), Failure> {
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::NOTHING);
    table.set_header(["module", "property", "proved", "build", "seconds"]);
    let (mut always, mut bounded, mut stopped, mut failed) = (0, 0, 0, 0);
    for entry in proved {
        for property in properties(&prover.text(&entry.module)?) {
            let Some(verdict) = entry.verdict(&property.name) else { continue };
            match verdict {
                Verdict::Induction(_) => always += 1,
                Verdict::Bounded(_) => bounded += 1,
                Verdict::Stopped(_) => stopped += 1,
                Verdict::Fails(_) => failed += 1,
            }
            let seconds = format!("{:.1}", entry.proof.seconds);
            let row = [&entry.module, &property.name, &shown(verdict), &entry.build, &seconds];
            table.add_row(row.map(String::as_str));
        }
        // A lemma that fails leaves what rests on it unproved.
        let lemmas = entry.proof.verdicts.iter().filter(|(label, _)| name(label).is_none());
        for (label, verdict) in lemmas.filter(|(_, verdict)| matches!(verdict, Verdict::Fails(_))) {
            table.add_row([&entry.module, label, &shown(*verdict), &entry.build, ""]);
            failed += 1;
        }
    }
    say!("{table}\n");
    let stopped = match stopped {
        0 => String::new(),
        _ => format!(", {stopped} stopped after {} s of processor time", LIMIT.as_secs()),
    };
    say!("{always} proved for any number of clocks, {bounded} for so many{stopped}, {failed} fail");
    Ok(())
}

fn bugs(args: &ProveArgs, prover: &Prover, modules: &[String]) -> Result<u8, Failure> {
    let wanted: Vec<&Bug> =
        BUGS.iter().filter(|bug| modules.iter().any(|module| module == bug.module)).collect();
    let spinner = Spinner::new();
    let catches: Result<Vec<Catch>, Failure> = wanted
        .par_iter()
        .with_max_len(1)
        .map(|bug| {
            spinner.tell(bug.module, bug.property);
            Ok(prover.catches(bug)?)
        })
        .collect();
    drop(spinner);
    let catches = catches?;
    let mut report = Vec::new();
    for (bug, caught) in wanted.iter().zip(&catches) {
        let Bug { module, property, build, find, replace } = bug;
        let what = match caught {
            Catch::At(_) => None,
            Catch::Not => Some("not caught"),
            Catch::Stopped => Some("the prover was stopped"),
        };
        if let Some(what) = what {
            say!("{what}: {module} ({build}), {property}: {find} → {replace}");
        }
        report.push(serde_json::json!({
            "module": module, "property": property, "build": build, "find": find,
            "replace": replace, "caught": caught,
        }));
    }
    write_json(args, "bugs", &report)?;
    let caught = catches.iter().filter(|caught| matches!(caught, Catch::At(_))).count();
    say!("{caught} of {} bugs caught", wanted.len());
    Ok(if caught == wanted.len() { OK } else { MISMATCH })
}

fn netlists(args: &ProveArgs, prover: &Prover, modules: &[String]) -> Result<u8, Failure> {
    let targets = modules.iter().filter_map(|module| Target::named(module));
    let tasks: Vec<(Target, &str, Config)> = targets
        .flat_map(|target| {
            let configs = [("default", Config::DEFAULT), ("paper", Config::PAPER)];
            configs.map(|(name, config)| (target, name, config))
        })
        .collect();
    if tasks.is_empty() {
        let why = format!("{}: neither unit nor system (see wheatstone list)", modules.join(", "));
        return Err(Failure::Input(why));
    }
    let spinner = Spinner::new();
    let compared: Result<Vec<Compared>, Failure> = tasks
        .par_iter()
        .with_max_len(1)
        .map(|(target, name, config)| {
            let equivalence = prover.equivalence(*target, config)?;
            spinner.tell(target.name(), &format!("{name}, {:.1} s", equivalence.seconds));
            Ok(Compared {
                target: target.name().to_owned(),
                config: (*name).to_owned(),
                equivalence,
            })
        })
        .collect();
    drop(spinner);
    let compared = compared?;
    for Compared { target, config, equivalence } in &compared {
        let verdict = match (equivalence.closes(), equivalence.points) {
            (true, points) => format!("equal at {points} points"),
            (false, 0) => "stopped".into(),
            (false, points) => format!("{} of {points} points open", equivalence.open),
        };
        say!("{target} {config}: {verdict}, {:.1} s", equivalence.seconds);
    }
    write_json(args, "netlists", &compared)?;
    if args.record {
        update(&[], &compared)?;
    }
    // One that does not close in time is open, not different.
    let differ = compared.iter().filter(|entry| entry.equivalence.differs());
    let mut faults: Vec<String> = differ.map(Compared::difference).collect();
    if args.check {
        faults.extend(Record::read(&root()?)?.lost_netlists(&compared));
        return Ok(checked(&faults, record::FILE));
    }
    faults.iter().for_each(|fault| say!("{fault}"));
    Ok(if faults.is_empty() { OK } else { MISMATCH })
}

fn write_json(
    args: &ProveArgs,
    name: &str,
    entries: &impl serde::Serialize,
) -> Result<(), Failure> {
    let Some(file) = &args.json else { return Ok(()) };
    let content = serde_json::json!({
        "command": called(),
        name: entries,
    });
    Ok(files::write(file, format!("{content:#}\n").as_bytes())?)
}

/// Writes into the record of the workspace.
fn update(proofs: &[Proved], netlists: &[Compared]) -> Result<(), Failure> {
    let root = root()?;
    let mut record = recorded(&root, record::FILE, Record::read)?;
    record.update(proofs, netlists);
    record.write(&root)?;
    say!("{}: written; now run: wheatstone generate", record::FILE);
    Ok(())
}
