//! The stereo pipeline beside the monocular one that draws both eyes in two passes: clocks of both on
//! the same polygons, in Verilator, with a memory that answers after [`MEASURED_LATENCY`] clocks and no
//! stalls from outside. Everything drawn is compared with the golden model.

use crate::cases::monocular;
use crate::numbers::thousands;
use crate::record::{read_record, RecordError};
use crate::regression::{
    model_probes, run_case, run_scene, Ran, RegressionError, Setting, MEASURED_LATENCY,
};
use crate::synth::record::Record;
use crate::synth::{Figure, Tech};
use crate::{Builder, Library, Spec, Stalls};
use fastrand::Rng;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use thiserror::Error;
use wheatstone_golden::config::Config;
use wheatstone_golden::files::{self, WriteError};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::pipeline::{Edges, PrimaryBeat, Setup};
use wheatstone_golden::primary::{Primary, Sink};
use wheatstone_golden::scene::vector::{add, cross, dot, scale, unit, Vec3};
use wheatstone_golden::scene::{Colours, Material, Mesh, Rig, Scene, DEFAULT_SIZE};
use wheatstone_golden::setup::{Eyes, Polygon};
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::Grouped;
use wheatstone_studies::published::PRIMARY;

/// Longest sides of the triangles in the table by size, in pixels.
pub const SIZES: [u32; 9] = [2, 4, 8, 16, 32, 64, 96, 128, 256];

/// Largest angles between triangles and the screen, in degrees, in the tables by size.
pub const TURNED: [u32; 3] = [0, 45, 90];

/// Pixels that the triangles of one size cover at least, about.
const COVERED: f64 = 150_000.0;

/// A seed of the simulation: with stalls off and a steady memory, clocks do not depend on it.
const SEED: u64 = 1;

/// The clocks of both for the same polygons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of the scene or of the triangles.
    pub name: String,
    /// Polygons.
    pub polygons: u64,
    /// Polygons of which the stereo pipeline derives one view from the other.
    pub derived: u64,
    /// Clocks of the stereo pipeline for both views.
    pub stereo: u64,
    /// Clocks of the monocular pipeline for the left and the right view.
    pub monocular: [u64; 2],
    /// Pixels that polygons cover in the two views.
    pub pixels: u64,
    /// Of each polygon the pixels in the view in which it has more: one pass cannot visit fewer.
    pub wider: u64,
}

impl Row {
    /// Clocks of one stereo pass in those of two monocular passes.
    pub fn clocks(&self) -> f64 {
        self.stereo as f64 / self.monocular.iter().sum::<u64>() as f64
    }

    /// The same if each polygon took its pixels in the view in which it has more.
    pub fn bound(&self) -> f64 {
        self.wider as f64 / self.pixels.max(1) as f64
    }
}

/// Gates of the pipelines that are compared (OSU 0.35 µm), from the committed record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Areas {
    /// `sam_primary`.
    pub primary: f64,
    /// `sam_mono`.
    pub mono: f64,
    /// `sam_hybrid`.
    pub secondary: f64,
    /// `sam_stereo`.
    pub stereo: f64,
}

impl Areas {
    /// The areas of a configuration; none where the record lacks one.
    pub fn recorded(workspace: &Path, config: &str) -> Result<Option<Areas>, RecordError> {
        let record = Record::read(workspace)?;
        let gates = |target| record.figure(target, config, Tech::Gates, Figure::Osu035);
        let all = || {
            Some(Areas {
                primary: gates(Target::Primary)?,
                mono: gates(Target::Mono)?,
                secondary: gates(Target::Hybrid)?,
                stereo: gates(Target::Stereo)?,
            })
        };
        Ok(all())
    }

    /// The stereo pipeline in two primary pipelines: against it, as it tests and blends the secondary's
    /// pixels and they none.
    pub fn to_primaries(&self) -> f64 {
        self.stereo / (2.0 * self.primary)
    }

    /// The stereo pipeline, with a depth test and a blend of their own for its primary's pixels too, in
    /// two monocular pipelines.
    pub fn to_monos(&self) -> f64 {
        (self.stereo + self.mono - self.primary) / (2.0 * self.mono)
    }
}

/// The comparison did not come about.
#[derive(Debug, Error)]
pub enum BaselineError {
    /// A simulation could not run.
    #[error(transparent)]
    Regression(#[from] RegressionError),
    /// A simulation differs from the golden model.
    #[error("{target} differs from the golden model on {name}; see: wheatstone cosim {target}")]
    Differs {
        /// Which pipeline.
        target: &'static str,
        /// On what.
        name: String,
    },
}

/// Both pipelines, built.
pub struct Baseline {
    stereo: Library,
    mono: Library,
}

impl Baseline {
    /// Builds both.
    pub fn new(builder: &Builder, rtl: &Path, config: &Config) -> Result<Baseline, BaselineError> {
        let build = |target: Target| {
            let (interface, probes) = (target.interface(config), model_probes(target, config));
            let built = builder.build(&Spec { interface: &interface, rtl, probes: &probes });
            built.map_err(RegressionError::from)
        };
        Ok(Baseline { stereo: build(Target::Stereo)?, mono: build(Target::Mono)? })
    }

    /// Draws a job with both.
    pub fn measure(&self, name: &str, job: &Job) -> Result<Row, BaselineError> {
        let scene = run_scene(&setting(&self.stereo), Target::Stereo, job)?;
        let stereo = clocks(&scene.ran, Target::Stereo, name)?;
        let mut monocular_clocks = [0; 2];
        for (eye, clocks_of) in Eye::BOTH.into_iter().zip(&mut monocular_clocks) {
            let ran = run_case(&setting(&self.mono), &monocular(job, eye, name))?;
            *clocks_of = clocks(&ran, Target::Mono, name)?;
        }
        let (polygons, derived) = (job.polygons.len() as u64, scene.drawn.derived);
        let (pixels, wider) = covered(job);
        let monocular = monocular_clocks;
        Ok(Row { name: name.into(), polygons, derived, stereo, monocular, pixels, wider })
    }
}

/// Pixels that polygons cover in both views, and in the view in which each of them has more.
fn covered(job: &Job) -> (u64, u64) {
    let job = Target::Mono.job(job);
    let mut primary = Primary::new(job.planner(false), job.textures, job.lookup);
    let mut drawn = |polygon: &Polygon, eye: Eye| {
        let before = primary.counts.beats();
        if polygon.eyes == Eyes::Both || polygon.eyes == Eyes::One(eye) {
            for triangle in polygon.fan() {
                primary.draw(&Polygon { eyes: Eyes::One(eye), ..triangle }, &mut Nowhere);
            }
        }
        primary.counts.beats() - before
    };
    let of = |polygon| Eye::BOTH.map(|eye| drawn(polygon, eye));
    job.polygons
        .iter()
        .map(of)
        .fold((0, 0), |(both, wider), [left, right]| (both + left + right, wider + left.max(right)))
}

/// Nobody looks at the beats.
struct Nowhere;

impl Sink for Nowhere {
    fn polygon(&mut self, _id: u32) {}
    fn records(&mut self, _setup: &Setup, _edges: &Edges) {}
    fn beat(&mut self, _beat: &PrimaryBeat) {}
}

fn setting(library: &Library) -> Setting<'_> {
    let latency = Some(MEASURED_LATENCY);
    Setting { library, seed: SEED, stalls: Stalls::NONE, latency, trace: None }
}

/// The clocks of a run that equals the golden model.
fn clocks(ran: &Ran, target: Target, name: &str) -> Result<u64, BaselineError> {
    match ran.passed() {
        true => Ok(ran.counts.clocks),
        false => Err(BaselineError::Differs { target: target.name(), name: name.into() }),
    }
}

/// Triangles of one size in space before the default rig, turned from the screen by up to so many
/// degrees, all directions equally likely; their longest side is `size` pixels in the view half-way
/// between the eyes.
pub fn triangles(size: u32, turned: u32) -> Scene {
    let [width, height] = DEFAULT_SIZE;
    let rig = Rig::default();
    let mut rng = Rng::with_seed(size.into());
    let mut mesh = Mesh::default();
    let side = f64::from(size);
    let count = (COVERED / (0.2 * side * side)).clamp(300.0, 4000.0) as u32;
    for n in 0..count {
        mesh.positions.extend(triangle(&mut rng, &rig, side, turned));
        mesh.triangles.push([0, 1, 2].map(|k| 3 * n + k));
    }
    let colours = mesh.positions.iter().map(|_| [(); 3].map(|()| rng.u8(..)));
    mesh.colours = Colours::Vertex(colours.collect());
    let materials = vec![Material::default()];
    Scene { width, height, rig, materials, meshes: vec![mesh], ..Scene::default() }
}

/// An equilateral triangle.
fn triangle(rng: &mut Rng, rig: &Rig, side: f64, turned: u32) -> [Vec3; 3] {
    // From a quarter of the viewing distance before the screen to half of it behind.
    let d = rig.viewing_distance;
    let depth = d * (0.75 + 0.75 * rng.f64());
    let [x, y] = DEFAULT_SIZE.map(|n| (rng.f64() - 0.5) * f64::from(n) / rig.pixels_per_unit);
    let centre = [x * depth / d, y * depth / d, depth - d];
    let least = f64::from(turned).to_radians().cos();
    let normal = match turned {
        0 => [0.0, 0.0, -1.0],
        _ => std::iter::repeat_with(|| direction(rng)).find(|n| -n[2] >= least).unwrap_or_default(),
    };
    let first = unit(cross(normal, direction(rng)));
    let second = cross(normal, first);
    let corner = |turn: f64| {
        let (sine, cosine) = (turn * std::f64::consts::TAU).sin_cos();
        add(scale(first, cosine), scale(second, sine))
    };
    let corners = [corner(0.0), corner(1.0 / 3.0), corner(2.0 / 3.0)];
    // On the screen, of a triangle of that size.
    let shown = |p: Vec3| [p[0], p[1]].map(|n| n * rig.pixels_per_unit * d / depth);
    let length = |k: usize| {
        let [a, b] = [corners[k], corners[(k + 1) % 3]].map(shown);
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    let longest = [0, 1, 2].map(length).into_iter().fold(0.0, f64::max);
    corners.map(|p| add(centre, scale(p, side / longest)))
}

/// A direction, all equally likely.
fn direction(rng: &mut Rng) -> Vec3 {
    loop {
        let p = [(); 3].map(|()| 2.0 * rng.f64() - 1.0);
        if (0.01..1.0).contains(&dot(p, p)) {
            return unit(p);
        }
    }
}

/// The file of the committed rows in the workspace.
pub const FILE: &str = "synth/baseline.json";

/// The rows of a configuration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rows {
    /// By the size of triangles, with how far they are turned at most.
    pub sizes: Vec<(u32, Vec<Row>)>,
    /// Of the built-in scenes.
    pub scenes: Vec<Row>,
}

impl Rows {
    /// All rows, each with how far triangles are turned, if it is of triangles.
    pub fn all(&self) -> impl Iterator<Item = (Option<u32>, &Row)> {
        let sizes =
            self.sizes.iter().flat_map(|(turned, rows)| rows.iter().map(|r| (Some(*turned), r)));
        sizes.chain(self.scenes.iter().map(|row| (None, row)))
    }

    /// Rows that differ from recorded ones, and rows that take longer than two passes, a line each.
    pub fn faults(&self, recorded: &Rows) -> Vec<String> {
        let known: Vec<(Option<u32>, &Row)> = recorded.all().collect();
        let tell = |(turned, row): (Option<u32>, &Row)| {
            let name =
                turned.map_or(row.name.clone(), |t| format!("{}, turned up to {t}°", row.name));
            let slow = (row.clocks() > 1.0).then(|| format!("{name}: slower than two passes"));
            let differs = !known.contains(&(turned, row));
            slow.or(differs.then(|| format!("{name}: ratio {:.3}, not as recorded", row.clocks())))
        };
        self.all().filter_map(tell).collect()
    }
}

/// The committed rows, by configuration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Recorded(pub BTreeMap<String, Rows>);

impl Recorded {
    /// The rows of a workspace.
    pub fn read(workspace: &Path) -> Result<Recorded, RecordError> {
        read_record(workspace, FILE, "write it with: wheatstone baseline --record")
    }

    /// The rows of a configuration, none if it has none.
    pub fn of(&self, config: &str) -> Rows {
        self.0.get(config).cloned().unwrap_or_default()
    }

    /// Writes them.
    pub fn write(&self, workspace: &Path) -> Result<(), WriteError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        files::write(&workspace.join(FILE), format!("{text}\n").as_bytes())
    }
}

/// The areas of each configuration, in a table.
pub fn area_table(areas: &[(&str, Areas)]) -> String {
    let mut text = String::from(
        "\n| gates, OSU 0.35 µm | `sam_primary` | `sam_mono` | `sam_hybrid` | `sam_stereo` \
         | secondary : primary | secondary : 100,000 | stereo : 2 primary | stereo : 2 mono |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for (config, a) in areas {
        let [primary, mono, secondary, stereo] =
            [a.primary, a.mono, a.secondary, a.stereo].map(thousands);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| `{config}` | {primary} | {mono} | {secondary} | {stereo} | {:.2} | {:.2} | {:.2} | {:.2} |",
            a.secondary / a.primary,
            a.secondary / f64::from(PRIMARY),
            a.to_primaries(),
            a.to_monos(),
        );
    }
    text
}

/// The rows of a configuration with these areas, in tables.
pub fn row_tables(rows: &Rows, config: &str, areas: Option<&Areas>) -> String {
    let mut text = String::new();
    let row = |text: &mut String, row: &Row| {
        let numbers = [row.polygons, row.derived, row.stereo, row.monocular.iter().sum()];
        let cells: String = numbers.iter().map(|n| format!(" {} |", Grouped(*n))).collect();
        // Two pipelines at once take twice the area and half the time.
        let product = |a: &Areas| format!("{:.2}", 2.0 * a.to_monos() * row.clocks());
        let (ratio, bound) = (row.clocks(), row.bound());
        let product = areas.map_or("–".into(), product);
        let _ = writeln!(text, "| {} |{cells} {ratio:.3} | {bound:.3} | {product} |", row.name);
    };
    let sizes = rows.sizes.iter().map(|(turned, rows)| (format!("turned up to {turned}°"), rows));
    for (heading, rows) in sizes.chain([("scene".to_owned(), &rows.scenes)]) {
        let _ = write!(
            text,
            "\n| `{config}`, {heading} | polygons | derived | clocks, stereo | clocks, two passes | ratio | bound | area × clocks |\n\
             | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        );
        rows.iter().for_each(|r| row(&mut text, r));
    }
    text
}
