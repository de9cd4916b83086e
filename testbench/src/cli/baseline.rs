//! `wheatstone baseline`.

use super::builder::builder;
use super::failure::{Failure, OK};
use super::folders::{root, rtl_folder};
use super::options::{builtin_names, drawn, parse_size};
use super::places::Places;
use super::progress::{is_terminal, Spinner};
use super::records::{checked, recorded};
use crate::baseline::{
    self, area_table, row_tables, Areas, Baseline, Recorded, Row, Rows, SIZES, TURNED,
};
use crate::settings::Settings;
use crate::workspace;
use clap::Args;
use std::path::{Path, PathBuf};
use wheatstone_golden::files;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::scene::{self, Scene, SceneError};

#[derive(Debug, Args)]
pub(super) struct BaselineArgs {
    /// Built-in scene or file [default: triangles by size and all built-in scenes]
    #[arg(long, value_name = "NAME|FILE")]
    scene: Option<String>,
    /// Size of each view in pixels [default: 640x480]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<[u32; 2]>,
    /// Named set of build parameters
    #[arg(long, value_name = "default|paper|full", default_value = "default")]
    config: String,
    /// Write the rows and areas as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the rows into the record; `wheatstone generate` then renews the tables
    #[arg(long, conflicts_with_all = ["scene", "size", "rtl"])]
    record: bool,
    /// Compare with the committed record: exit status 1 if a row differs or takes longer than two passes
    #[arg(long, conflicts_with_all = ["record", "scene", "size"])]
    check: bool,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

pub(super) fn run(args: &BaselineArgs) -> Result<u8, Failure> {
    Places::default().scene(&args.scene).file("--json", &args.json).check()?;
    let settings = Settings::new::<&str>(&args.config, &[])?;
    // First, as models take a while to build.
    let scenes = scenes(args)?;
    let polygons =
        |scene: &Scene| scene.geometry(&Formats::new(&settings.config), &Default::default());
    for (name, scene) in scenes.iter().filter(|_| args.scene.is_some()) {
        drawn(name, polygons(scene)?)?;
    }
    let builder = builder(is_terminal())?;
    let pipelines = Baseline::new(&builder, &rtl_folder(&args.rtl)?, &settings.config)?;
    let spinner = Spinner::new();
    let measure = |name: &str, scene: &Scene| -> Result<Row, Failure> {
        let geometry = polygons(scene)?;
        let row = pipelines.measure(name, &settings.job(&geometry))?;
        spinner.tell(name, &format!("ratio {:.3}", row.clocks()));
        Ok(row)
    };
    let mut rows = Rows::default();
    if args.scene.is_none() {
        for turned in TURNED {
            let row = |size| measure(&format!("{size} px"), &baseline::triangles(size, turned));
            rows.sizes.push((turned, SIZES.map(row).into_iter().collect::<Result<_, _>>()?));
        }
    }
    for (name, scene) in &scenes {
        rows.scenes.push(measure(name, scene)?);
    }
    drop(spinner);
    let areas = match &workspace::find() {
        Some(root) => Areas::recorded(root, &args.config)?,
        None => None,
    };
    if let Some(areas) = areas {
        say!("{}", area_table(&[(&args.config, areas)]).trim_start());
    }
    say!("{}", row_tables(&rows, &args.config, areas.as_ref()).trim_start());
    if let Some(file) = &args.json {
        let content = serde_json::json!({
            "format": "wheatstone-baseline/1",
            "config": args.config,
            "gates": areas,
            "sizes": rows.sizes,
            "scenes": rows.scenes,
        });
        files::write(file, format!("{content:#}\n").as_bytes())?;
    }
    match (args.record, args.check) {
        (true, _) => record(&root()?, &args.config, rows).map(|()| OK),
        (_, true) => check(&root()?, &args.config, &rows),
        _ => Ok(OK),
    }
}

/// The scene that was named, or all that are built in, with their names.
fn scenes(args: &BaselineArgs) -> Result<Vec<(&str, Scene)>, SceneError> {
    let names: Vec<&str> = match &args.scene {
        Some(name) => vec![name],
        None => builtin_names().collect(),
    };
    let open = |name| Ok((name, scene::open(name, args.size, None)?));
    names.into_iter().map(open).collect()
}

/// Writes rows into the record of the workspace.
fn record(root: &Path, config: &str, rows: Rows) -> Result<(), Failure> {
    let mut recorded = recorded(root, baseline::FILE, Recorded::read)?;
    recorded.0.insert(config.to_owned(), rows);
    recorded.write(root)?;
    say!("{}: written; now run: wheatstone generate", baseline::FILE);
    Ok(())
}

/// Compares rows with the record of the workspace.
fn check(root: &Path, config: &str, rows: &Rows) -> Result<u8, Failure> {
    let faults = rows.faults(&Recorded::read(root)?.of(config));
    Ok(checked(&faults, baseline::FILE))
}
