//! `wheatstone vectors` and `wheatstone check`.

use super::failure::{Failure, MISMATCH, OK};
use super::ignored::refuse;
use super::options::{builtin_names, drawn, parse_target, Common, CullChoice, Stimulus};
use super::places::Places;
use crate::cases::{self, Case};
use crate::numbers::counted;
use crate::pack::{self, Drawn, Manifest, Origin, SceneOrigin};
use crate::settings::Settings;
use crate::shell::{command_line, operand};
use clap::Args;
use std::path::{Path, PathBuf};
use wheatstone_golden::scene;
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::{printable, printable_path};

/// Random beats of a pack.
const BEATS: u64 = 4_000;

#[derive(Debug, Args)]
pub(super) struct VectorsArgs {
    /// Units and systems (see `wheatstone list`); none means all, or with --case all that have it
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Folder for the packs; each is a folder in it, named like its target
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// The directed case of this name in place of random beats
    #[arg(long, value_name = "NAME", conflicts_with_all = ["scene", "beats", "seed"])]
    case: Option<String>,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    stimulus: Stimulus,
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    /// A pack, or a folder of packs
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Write what was checked of one pack to this new folder, byte for byte: what is replayed from there
    /// is what was checked
    #[arg(long, value_name = "NEW")]
    copy: Option<PathBuf>,
    /// Folder of the Verilog that the packs must match [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

pub(super) fn write(args: &VectorsArgs) -> Result<u8, Failure> {
    Places::of_view(&args.common.view).folder("--out", Some(&args.out)).check()?;
    let settings = args.common.settings()?;
    let targets = targets(args, &settings)?;
    refuse_ignored(args, &targets)?;
    for target in &targets {
        pack::replaceable(&args.out.join(target.name()))?;
    }
    let rtl = args.stimulus.rtl()?;
    let mut written = Vec::new();
    for &target in &targets {
        let hash = pack::rtl_hash(&rtl, target.module())?;
        for (case, origin) in packs(args, &settings, target)? {
            let info = pack::write(&case, &origin, &hash, &args.out)?;
            let folder = printable_path(&info.folder);
            let cut = origin.scene.as_ref().filter(|scene| scene.beats < scene.beats_of);
            let of = cut.map_or(String::new(), |scene| {
                let [first, all] = [scene.beats, scene.beats_of].map(|n| counted(n, "beat"));
                format!(": the first {first} of the primary pipeline's {all}")
            });
            let beats = beats_of(&info.manifest);
            say!("{folder}: {}, {beats}{of}", printable(&case.name));
            written.push(info.folder);
        }
    }
    let words = |folder: &Path| command_line([operand(folder)]);
    say!("verify with:  wheatstone check {}", words(&args.out));
    if let Some(folder) = written.first() {
        let bench = words(&folder.join("replay.v"));
        let (folder, rtl) = (words(folder), words(&rtl));
        say!("replay with:  iverilog -g2005 -I {folder} -o t {bench} {rtl}/*.v && vvp t");
    }
    Ok(OK)
}

/// The number of a pack's beats, and the outputs that have none.
fn beats_of(manifest: &Manifest) -> String {
    let beats = counted(manifest.beats(), "beat");
    manifest.uncompared().map_or(beats.clone(), |none| format!("{beats}, {none}"))
}

/// The targets that packs are written of.
fn targets(args: &VectorsArgs, settings: &Settings) -> Result<Vec<Target>, Failure> {
    let named = if args.targets.is_empty() { Target::ALL.to_vec() } else { args.targets.clone() };
    let Some(name) = &args.case else { return Ok(named) };
    let names = |target: Target| -> Vec<String> {
        cases::directed(target, &settings.config).into_iter().map(|case| case.name).collect()
    };
    let (with, without): (Vec<Target>, Vec<Target>) =
        named.iter().partition(|&&target| names(target).contains(name));
    if with.is_empty() || (!without.is_empty() && !args.targets.is_empty()) {
        let lacking = without.into_iter().next().filter(|_| !args.targets.is_empty());
        let of = lacking.map_or(String::new(), |target| format!(" of {}", target.name()));
        let mut there: Vec<String> = Vec::new();
        for name in lacking.map_or(named, |target| vec![target]).into_iter().flat_map(names) {
            let name = format!("“{name}”");
            if !there.contains(&name) {
                there.push(name);
            }
        }
        let (name, there) = (printable(name), there.join(", "));
        return Err(Failure::Input(format!("--case {name}: no such case{of}; there are: {there}")));
    }
    Ok(with)
}

/// Refuses what would make no difference.
fn refuse_ignored(args: &VectorsArgs, targets: &[Target]) -> Result<(), Failure> {
    let Stimulus { seed, beats, .. } = args.stimulus;
    let latency = args.common.named().any(|name| name == "latency");
    refuse("--param latency", latency, "a pack has no clocks: an answer waits for its read alone")?;
    if args.common.view.scene.is_none() {
        args.common.refuse_scene_options()?;
    } else {
        refuse("--seed", seed.is_some(), "nothing of a scene is random")?;
    }
    args.common.refuse_foreign(targets)?;
    if beats.is_some_and(|beats| beats > pack::BEATS_LIMIT) {
        let limit = pack::BEATS_LIMIT;
        return Err(Failure::Input(format!("--beats: a pack has {limit} at most; ask for fewer")));
    }
    Ok(())
}

/// The cases of a target's packs, and where they come from: the head of a scene if one is named, a
/// directed case, or random beats.
fn packs(
    args: &VectorsArgs,
    settings: &Settings,
    target: Target,
) -> Result<Vec<(Case, Origin)>, Failure> {
    let config = args.common.config.clone();
    let beats = args.stimulus.beats.unwrap_or(BEATS) as usize;
    if let Some(name) = &args.common.view.scene {
        let (case, scene) = scene(args, settings, target, name, beats)?;
        return Ok(vec![(case, Origin { config, scene: Some(scene), ..Origin::default() })]);
    }
    if let Some(name) = &args.case {
        let directed = cases::directed(target, &settings.config).into_iter();
        let origin = Origin { config, ..Origin::default() };
        return Ok(directed.filter(|c| c.name == *name).map(|c| (c, origin.clone())).collect());
    }
    let seed = args.stimulus.seed();
    let packs = cases::for_packs(target, &settings.config, seed, beats).into_iter();
    let origin = Origin { config, ..Origin::random(seed) };
    Ok(packs.map(|(suffix, case)| (case, Origin { suffix, ..origin.clone() })).collect())
}

/// The beginning of a scene.
fn scene(
    args: &VectorsArgs,
    settings: &Settings,
    target: Target,
    name: &str,
    beats: usize,
) -> Result<(Case, SceneOrigin), Failure> {
    let common = &args.common;
    let opened = common.open(name, common.view.size)?;
    let is_file = builtin_names().all(|builtin| builtin != name);
    let file = is_file.then(|| scene::read(Path::new(name))).transpose()?;
    let rig_file = common.view.rig.as_deref().map(scene::read_text).transpose()?;
    let geometry = drawn(name, common.geometry_of(&opened, settings)?)?;
    let whole = settings.job(&geometry);
    let job = target.job(&whole);
    let head = cases::scene_head(target, &job, name, beats)
        .ok_or_else(|| Failure::Input(format!("--scene {name}: nothing of it is drawn")))?;
    let drawn = Drawn {
        name,
        file: file.as_deref(),
        rig: &opened.rig,
        rig_file: rig_file.as_deref(),
        settings,
        cull: common.cull == CullChoice::Back,
        wire: common.wire,
        job: &job,
    };
    let origin = SceneOrigin::new(&drawn, &head);
    Ok((head.case, origin))
}

pub(super) fn check(args: &CheckArgs) -> Result<u8, Failure> {
    // One that is there is refused in any case.
    let copy = args.copy.as_deref().filter(|copy| !copy.exists());
    Places::default().folder("--copy", copy).check()?;
    let packs = match &args.copy {
        Some(copy) => vec![pack::copy(&args.folder, copy)?],
        None => pack::check(&args.folder)?,
    };
    let stimulus = Stimulus { seed: None, beats: None, rtl: args.rtl.clone() };
    let rtl = stimulus.rtl().ok();
    let mut status = OK;
    for checked in &packs {
        let manifest = &checked.manifest;
        let folder = printable_path(&checked.folder);
        let sound = format!("{folder}: sound, {}", beats_of(manifest));
        match &rtl {
            None => say!("{sound}; no Verilog here to compare with"),
            Some(rtl) if pack::rtl_hash(rtl, &manifest.module)? == manifest.rtl_blake3 => {
                let file = rtl.join(&manifest.module).with_extension("v");
                say!("{sound}, matches {}", printable_path(&file));
            }
            Some(rtl) => {
                say!(
                    "{sound}, but made for other Verilog than {}: write it again with wheatstone vectors",
                    rtl.display()
                );
                status = MISMATCH;
            }
        }
    }
    Ok(status)
}
