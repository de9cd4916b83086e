//! `wheatstone vectors` and `wheatstone check`.

use super::*;
use crate::cases::{self, Case};
use crate::pack;
use crate::regression::{counted, scene_head};

/// Random beats of a pack.
const BEATS: u64 = 4_000;

#[derive(Debug, Args)]
pub(super) struct VectorsArgs {
    /// Units and systems (see `wheatstone list`); none means all
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Folder for the packs; each is a folder in it, named like its target
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
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
    /// Folder of the Verilog that the packs must match [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

pub(super) fn write(args: &VectorsArgs) -> Result<u8, Failure> {
    let settings = args.common.settings()?;
    if args.common.view.scene.is_none() {
        args.common.view.refuse_eyes()?;
    }
    let targets = if args.targets.is_empty() { Target::ALL.to_vec() } else { args.targets.clone() };
    let rtl = args.stimulus.rtl()?;
    let (seed, beats) = (args.stimulus.seed, args.stimulus.beats.unwrap_or(BEATS) as usize);
    for &target in &targets {
        let case = case(args, &settings, target, seed, beats)?;
        let hash = pack::rtl_hash(&rtl, target.module())?;
        let info = pack::write(&case, seed, &hash, &args.out)?;
        say!("{}: {}, {}", info.folder.display(), case.name, counted(info.beats, "beat"));
    }
    let folder = args.out.display();
    say!("verify with:  wheatstone check {folder}");
    say!(
        "replay with:  iverilog -g2005 -I {folder}/{0} -o t {folder}/{0}/replay.v {1}/*.v && vvp t",
        targets[0].name(),
        rtl.display()
    );
    Ok(OK)
}

/// The case of a pack: the head of a scene if one is named, or random beats.
fn case(
    args: &VectorsArgs,
    settings: &Settings,
    target: Target,
    seed: u64,
    beats: usize,
) -> Result<Case, Failure> {
    let Some(name) = &args.common.view.scene else {
        return Ok(cases::random(target, &settings.config, seed, beats));
    };
    let geometry = args.common.geometry(name, args.common.view.size, settings)?;
    let job = job(settings, &geometry, settings.options);
    scene_head(target, &job, name, beats)
        .ok_or_else(|| Failure::Input(format!("--scene {name}: nothing of it is drawn")))
}

pub(super) fn check(args: &CheckArgs) -> Result<u8, Failure> {
    let packs = pack::check(&args.folder)?;
    let stimulus = Stimulus { seed: 0, beats: None, rtl: args.rtl.clone() };
    let rtl = stimulus.rtl().ok();
    let mut status = OK;
    for checked in &packs {
        let manifest = &checked.manifest;
        let beats: u64 = manifest.ports.iter().map(|p| p.beats).sum();
        let sound = format!("{}: sound, {}", checked.folder.display(), counted(beats, "beat"));
        match &rtl {
            None => say!("{sound}; no Verilog here to compare with"),
            Some(rtl) if pack::rtl_hash(rtl, &manifest.module)? == manifest.rtl_blake3 => {
                let file = rtl.join(&manifest.module).with_extension("v");
                say!("{sound}, matches {}", file.display());
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
