//! `wheatstone rig`.

use super::failure::{Failure, OK};
use super::options::View;
use super::places::Places;
use super::words::called;
use clap::Args;
use std::path::PathBuf;
use wheatstone_golden::files::{self, Set};
use wheatstone_golden::scene::RigFile;
use wheatstone_golden::text::printable_path;
use wheatstone_studies::volume::Volume;

const HELP: &str =
    "Distances are from the plane of the eyes: in the scene's unit, and as perceived in the
screen's unit, which is the same unless the projection has a screen distance of its own.
A point is perceived where the eyes' lines of sight through its two images meet.
Disparity is how far the right eye's image lies beside the left eye's: negative before the
screen, positive behind it. Fields of view are angles as seen from between the eyes, of what
is perceived at a distance: what both eyes see, and what one eye alone sees beside it.

Examples:
  wheatstone rig                                            the usual viewer and the teapot
  wheatstone rig --scene room --projection piecewise --out plots
  wheatstone rig --rig rig.json --at 100,250 --json rig-numbers.json";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(super) struct RigArgs {
    /// Distances in the scene that the map has too
    #[arg(long, value_name = "DISTANCE,…", value_delimiter = ',', value_parser = parse_distance)]
    at: Vec<f64>,
    /// Folder for plots of the map and of the fields of view (SVG); it is made if need be
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write all numbers as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    view: View,
}

fn parse_distance(text: &str) -> Result<f64, String> {
    let distance = text.trim().parse().ok().filter(|d| (1e-9..=1e9).contains(d));
    distance.ok_or_else(|| "expected distances from the eyes, numbers from 1e-9 to 1e9".into())
}

pub(super) fn run(args: &RigArgs) -> Result<u8, Failure> {
    let RigArgs { at, view, json, out } = args;
    Places::of_view(view).file("--json", json).folder("--out", out.as_deref()).check()?;
    let name = view.scene.as_deref().unwrap_or("teapot");
    let scene = view.open(name, view.size)?;
    let rig_file = view.rig.as_deref().map(RigFile::load).transpose()?;
    let volume = Volume::of(&scene, rig_file.and_then(|file| file.device()))?;
    say!("{name}, {volume}\n\n{}", volume.tables(at));
    volume.notes().iter().for_each(|note| say!("\nnote: {note}"));
    if let Some(out) = out {
        let set = Set::new(out)?;
        let files = volume.plots(set.path())?;
        let files: Vec<PathBuf> = files.iter().map(|file| set.named(file)).collect();
        set.finish("distance_map.svg", |_| false)?;
        files.iter().for_each(|file| say!("file {}", printable_path(file)));
    }
    if let Some(file) = json {
        let mut content = volume.json(at);
        content["scene"] = name.into();
        content["command"] = called().into();
        files::write(file, format!("{content:#}\n").as_bytes())?;
    }
    Ok(OK)
}
