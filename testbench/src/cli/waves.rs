//! `wheatstone waves`.

use super::builder::builder;
use super::failure::{Failure, OK};
use super::folders::output_folder;
use super::ignored::refuse;
use super::options::{parse_target, Common, Stimulus};
use super::places::Places;
use crate::regression::{record_waves, Focus};
use crate::shell::{command_line, operand};
use crate::tools::GTKWAVE;
use clap::Args;
use std::ffi::OsStr;
use std::io::{Read, Seek};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;
use wheatstone_golden::files::{Tidy, WriteError};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::printable_path;
use wheatstone_process::Process;

/// Time that GTKWave must live to count as open.
const PATIENCE: Duration = Duration::from_secs(1);
/// Bytes of what it says that are read.
const SAID: u64 = 1 << 16;

#[derive(Debug, Args)]
pub(super) struct WavesArgs {
    /// Unit or system (see `wheatstone list`)
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    target: Target,
    /// Waveforms around the clock on which this pixel of a scene leaves a system, or on which a
    /// unit works on it
    #[arg(long, value_name = "EYE,X,Y", value_parser = parse_pixel, conflicts_with = "polygon")]
    pixel: Option<(Eye, u32, u32)>,
    /// Waveforms of this polygon of a scene
    #[arg(long, value_name = "N")]
    polygon: Option<u32>,
    /// Folder for the files [default: target/wheatstone/waves]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Open the view in GTKWave
    #[arg(long)]
    open: bool,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    stimulus: Stimulus,
}

fn parse_pixel(text: &str) -> Result<(Eye, u32, u32), String> {
    let mut parts = text.split(',');
    let eye = match parts.next() {
        Some("left") => Some(Eye::Left),
        Some("right") => Some(Eye::Right),
        _ => None,
    };
    let mut number = || parts.next().and_then(|n| n.trim().parse::<u32>().ok());
    match (eye, number(), number()) {
        (Some(eye), Some(x), Some(y)) => Ok((eye, x, y)),
        _ => Err("expected EYE,X,Y, for example right,320,200".into()),
    }
}

pub(super) fn run(args: &WavesArgs) -> Result<u8, Failure> {
    Places::of_view(&args.common.view).folder("--out", args.out.as_deref()).check()?;
    let settings = args.common.settings()?;
    args.common.refuse_foreign(&[args.target])?;
    let why = "waveforms show the beats around their focus, or the first ones";
    refuse("--beats", args.stimulus.beats.is_some(), why)?;
    let focus = match (args.pixel, args.polygon) {
        (Some((eye, x, y)), _) => Focus::Pixel(eye, x, y),
        (None, Some(id)) => Focus::Polygon(id),
        (None, None) => Focus::Start,
    };
    let needs_scene = focus != Focus::Start || args.common.view.scene.is_some();
    let name = args.common.view.scene.as_deref().unwrap_or("teapot");
    let geometry = if needs_scene {
        Some(args.common.geometry(name, args.common.view.size, &settings)?)
    } else {
        args.common.refuse_scene_options()?;
        None
    };
    let job = geometry.as_ref().map(|geometry| settings.job(geometry));
    let out = args.out.clone().unwrap_or_else(|| output_folder("waves"));
    let _tidy = Tidy::new(&out);
    std::fs::create_dir_all(&out).map_err(|source| WriteError { file: out.clone(), source })?;
    let rtl = args.stimulus.rtl()?;
    let builder = builder(false)?;
    let waves = record_waves(
        args.target,
        &settings,
        job.as_ref(),
        focus,
        args.stimulus.seed(),
        &rtl,
        &builder,
        &out,
    )?;
    let Some(waves) = waves else {
        return Err(Failure::Input(match focus {
            Focus::Pixel(eye, x, y) => {
                format!("--pixel {},{x},{y}: {name} draws nothing there", eye.name())
            }
            _ => format!("--polygon: {name} does not draw this polygon"),
        }));
    };
    say!(
        "{}: cycles {} to {}",
        printable_path(&waves.file),
        waves.cycles.start(),
        waves.cycles.end()
    );
    if let Some(marker) = waves.marker {
        say!("marker on cycle {marker}");
    }
    let view = waves.file.with_extension("gtkw");
    say!("open with:  {}", command_line([OsStr::new("gtkwave"), &operand(&view)]));
    if args.open {
        open(&view)?;
    }
    Ok(OK)
}

/// Opens a view in GTKWave, and waits until it would have said that it cannot: without a display it
/// prints why and how it is used, and ends as if all were well.
fn open(view: &Path) -> Result<(), Failure> {
    let gtkwave = GTKWAVE.find_in(&std::env::var_os("PATH").unwrap_or_default())?;
    let at = |source| WriteError { file: gtkwave.program.clone(), source };
    let mut said = tempfile::tempfile().map_err(at)?;
    let mut command = std::process::Command::new(&gtkwave.program);
    command.arg(view).stdout(Stdio::null()).stderr(said.try_clone().map_err(at)?);
    let status = Process::new(GTKWAVE.program, &mut command).launch(PATIENCE);
    let status = status.map_err(|error| Failure::Input(error.to_string()))?;
    let Some(status) = status else { return Ok(()) };
    let mut text = Vec::new();
    let _ = said.rewind().and_then(|()| said.take(SAID).read_to_end(&mut text));
    let text = String::from_utf8_lossy(&text);
    let why = match text.lines().map(str::trim).find(|line| !line.is_empty()) {
        None if status.success() => return Ok(()),
        None => status.to_string(),
        Some(line) => line.to_owned(),
    };
    Err(Failure::Input(format!("{} ended at once: {why}", gtkwave.program.display())))
}
