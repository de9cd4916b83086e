//! `wheatstone compare`.

use super::failure::{Failure, OK};
use super::options::{drawn, Common};
use super::places::Places;
use super::progress::Spinner;
use super::words::called;
use clap::Args;
use std::path::PathBuf;
use wheatstone_golden::files::{self, Set};
use wheatstone_golden::scene::Geometry;
use wheatstone_golden::setup::Arrangement;
use wheatstone_golden::text::{printable_path, Grouped};
use wheatstone_studies::compare::{compare, json, table, Method, METHODS};
use wheatstone_studies::prepared::Prepared;

#[derive(Debug, Args)]
pub(super) struct CompareArgs {
    /// Folder for an error picture of each method; it is made if need be
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write a JSON report
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

pub(super) fn run(args: &CompareArgs) -> Result<u8, Failure> {
    let places = Places::of_view(&args.common.view).file("--json", &args.json);
    places.folder("--out", args.out.as_deref()).check()?;
    let settings = args.common.settings()?;
    args.common.refuse_parameters(&["latency", "slots"], "views that no clock has a part in")?;
    let options = settings.options;
    if options.arrangement != Arrangement::Normal || options.single {
        let message = "--param display, displays: views are compared each on its own display";
        return Err(Failure::Input(message.into()));
    }
    let name = args.common.view.scene.as_deref().unwrap_or("room");
    let scene = args.common.open(name, args.common.view.size)?;
    let geometry = drawn(name, args.common.geometry_of(&scene, &settings)?)?;
    let set = args.out.as_deref().map(Set::new).transpose()?;
    let prepared = Prepared::of(scene, geometry, settings.config, options, settings.lookup);
    let spinner = Spinner::new();
    let tell = |method: &Method| spinner.tell(method.name, method.description);
    let outcomes = compare(&prepared, set.as_ref().map(Set::path), tell);
    drop(spinner);
    let outcomes = outcomes?;
    let Geometry { width, height, polygons: pieces, .. } = &prepared.geometry;
    let meshes = &prepared.scene.meshes;
    let polygons: usize = meshes.iter().map(|mesh| mesh.id_count()).sum();
    let triangles: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    let [a, b, c] = [polygons, triangles, pieces.len()].map(|n| Grouped(n as u64));
    say!("{name}, {width}x{height}: the second view of {a} polygons in {b} triangles, {c} drawn");
    say!("{}", table(&outcomes));
    say!("time: of the second view, direct rendering's is 1; that of SAM is its golden model's");
    if let Some(set) = set {
        let files = outcomes.iter().filter_map(|o| o.result.as_ref().ok()?.file.as_ref());
        let files: Vec<PathBuf> = files.map(|file| set.named(file)).collect();
        // Methods that do not suit this scene have no picture.
        let is_method =
            |name: &str| METHODS.iter().any(|m| name.strip_suffix(".png") == Some(m.name));
        set.finish("direct.png", is_method)?;
        files.iter().for_each(|file| say!("image {}", printable_path(file)));
    }
    if let Some(file) = &args.json {
        let content = serde_json::json!({
            "command": called(),
            "scene": name,
            "width": width,
            "height": height,
            "polygons": polygons,
            "triangles": triangles,
            "drawn": pieces.len(),
            "methods": json(&outcomes),
        });
        files::write(file, format!("{content:#}\n").as_bytes())?;
    }
    Ok(OK)
}
