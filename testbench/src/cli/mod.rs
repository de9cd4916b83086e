//! The program `wheatstone`.
//!
//! Its exit statuses are in `failure.rs` and in its help.

#[macro_use]
mod print;

mod baseline;
mod compare;
mod cosim;
mod cover;
mod failure;
mod generate;
mod ignored;
mod info;
mod mutate;
mod places;
mod progress;
mod prove;
mod render;
mod replay;
mod reproduce;
mod rig;
mod supervise;
mod synth;
mod vectors;
mod waves;
mod words;

use crate::regression::BEATS_LIMIT;
use crate::settings::Settings;
use crate::tools::Toolchain;
use crate::verification::{self, Record};
use crate::watch;
use crate::Builder;
use clap::{Args, Parser, Subcommand, ValueEnum};
use failure::{Failure, BAD_INPUT, MISMATCH, MISSING_TOOL, OK, STATUSES, UNFINISHED};
use places::Places;
use progress::{break_silence, clear_line, is_terminal, tell_line, turn, Spinner};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use wheatstone_golden::files::{self, WriteError};
use wheatstone_golden::formats::Formats;
use wheatstone_golden::progress::Stage;
use wheatstone_golden::projection::Kind;
use wheatstone_golden::scene::wires::wire_frame;
use wheatstone_golden::scene::{self, builtin, Cull, Geometry, Scene, SceneError, SIZE_LIMIT};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::printable_path;
use wheatstone_studies::volume::Volume;

/// An open stereoscopic rasteriser: simulate it, prove it, put it on an FPGA.
#[derive(Debug, Parser)]
#[command(name = "wheatstone", version, arg_required_else_help = true)]
#[command(after_help = format!("{EXAMPLES}\n\n{STATUSES}"))]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Stop a program that is called and has not ended after so many seconds, and a model that on one clock
    /// has used so many of processor time, or slept so many [default: 3600, 20 and 120]
    #[arg(long, global = true, value_name = "SECONDS", value_parser = clap::value_parser!(u32).range(1..))]
    timeout: Option<u32>,
}

const EXAMPLES: &str = "Examples:
  wheatstone cosim                                  the whole regression
  wheatstone cosim hybrid --scene teapot            one scene through the hybrid, pixel for pixel
  wheatstone cosim filter --param filter=2          one unit, another build
  wheatstone vectors filter --out packs             vectors for a board or another simulator
  wheatstone waves hybrid --pixel right,320,200     waveforms around one pixel
  wheatstone render --method hybrid --out pictures --stereo anaglyph
  wheatstone rig --projection piecewise             at what distance what is perceived";

#[derive(Debug, Subcommand)]
enum Command {
    /// Run targets against the golden model in Verilator and compare every beat and pixel
    Cosim(cosim::CosimArgs),
    /// Write vector packs: stimulus and expected beats for boards and other simulators
    Vectors(vectors::VectorsArgs),
    /// Verify a vector pack, or a folder of them
    Check(vectors::CheckArgs),
    /// Replay vector packs in Icarus, in cocotb and on gate-level netlists
    Replay(replay::ReplayArgs),
    /// Count which lines, bits and combinations of the stimulus the regression covers
    Cover(cover::CoverArgs),
    /// Write waveforms of a target, with a view for GTKWave and Surfer
    Waves(waves::WavesArgs),
    /// Draw a scene in stereo with the golden model
    Render(render::RenderArgs),
    /// Make the second view in every way and compare work, time and errors
    Compare(compare::CompareArgs),
    /// Tell what a rig shows: eyes and screen, limits, distance map, fields of view
    Rig(rig::RigArgs),
    /// Compute the publications' tables and figures anew
    Reproduce(reproduce::ReproduceArgs),
    /// Measure gates, LUTs and clock of targets, and compare with the committed record
    Synth(synth::SynthArgs),
    /// Compare clocks and area of the stereo pipeline with two passes of a monocular one
    Baseline(baseline::BaselineArgs),
    /// Prove the properties of the Verilog, plant bugs that they catch, prove netlists
    Prove(prove::ProveArgs),
    /// Change targets in hundreds of ways and count the changes that the regression notices
    Mutate(mutate::MutateArgs),
    /// List targets, configurations, parameters, scenes, projections and experiments
    List(info::ListArgs),
    /// Show which tools are found and how to install what is missing
    Doctor(info::DoctorArgs),
    /// Write rtl/sam_formats.vh and the tables of docs/ and README.md anew from the golden model's
    /// definitions and the records of synth, baseline, prove, mutate, cover and replay
    Generate(generate::GenerateArgs),
}

/// Options that several commands take.
#[derive(Clone, Debug, Args)]
struct Common {
    /// Named set of build parameters
    #[arg(long, default_value = "default", value_name = "default|paper|full")]
    config: String,
    /// Change one parameter (see `wheatstone list`); may be repeated
    #[arg(long = "param", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    #[command(flatten)]
    view: View,
    /// Which faces to leave out
    #[arg(long, value_enum, default_value = "none")]
    cull: CullChoice,
    /// Draw the edges of the polygons, one pixel thick, instead of the polygons
    #[arg(long)]
    wire: bool,
}

/// What is looked at, and from where.
#[derive(Clone, Debug, Args)]
struct View {
    /// Built-in scene, or a file ending in .obj, .json, .png, .txt or .grid
    #[arg(long, value_name = "NAME|FILE")]
    scene: Option<String>,
    /// Size of each view in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<[u32; 2]>,
    /// Rig file: eyes, screen, placement and light (JSON)
    #[arg(long, value_name = "FILE")]
    rig: Option<PathBuf>,
    /// How the scene is mapped to the screen (see `wheatstone list`) [default: what the rig file says,
    /// or two-centres]
    #[arg(long, value_name = "NAME", value_parser = parse_projection)]
    projection: Option<Kind>,
    /// Refuse a scene of which the files say what is not followed, instead of warning
    #[arg(long)]
    strict: bool,
}

/// Options of the commands that simulate or make vectors.
#[derive(Clone, Debug, Args)]
struct Stimulus {
    /// Seed of random beats, stalls and initial state [default: 1]
    #[arg(long)]
    seed: Option<u64>,
    /// Number of random beats of each target
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    beats: Option<u64>,
    /// Folder of the Verilog [default: rtl of this workspace]
    #[arg(long, value_name = "DIR")]
    rtl: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CullChoice {
    /// None
    None,
    /// Those that an eye sees clockwise
    Back,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let legal = parsed.filter(|size| size.iter().all(|n| (1..=SIZE_LIMIT).contains(n)));
    legal.ok_or_else(|| {
        format!("expected WIDTHxHEIGHT in pixels, each from 1 to {SIZE_LIMIT}, for example 640x480")
    })
}

fn parse_projection(text: &str) -> Result<Kind, String> {
    let names = Kind::ALL.map(Kind::name).join(", ");
    Kind::named(text).ok_or_else(|| format!("there are: {names}"))
}

fn parse_target(text: &str) -> Result<Target, String> {
    let names: Vec<&str> = Target::ALL.iter().map(|t| t.name()).collect();
    let text = text.strip_prefix("sam_").unwrap_or(text);
    Target::named(text).ok_or_else(|| format!("no such target; there are: {}", names.join(", ")))
}

/// Runs the program.
pub fn main() -> ExitCode {
    if let Some(why) = print::closed() {
        tell!("error: {why}");
        return ExitCode::from(BAD_INPUT);
    }
    let cli = match words::parse() {
        Ok(cli) => cli,
        Err(status) => return ExitCode::from(print::finish(status)),
    };
    let is_child = supervise::is_child();
    if cli.command.is_supervised() && !is_child {
        return ExitCode::from(supervise::supervise());
    }
    wheatstone_process::on_tell(tell_line);
    files::on_wait(wheatstone_process::limit, tell_line);
    wheatstone_process::on_signal(|signal| {
        clear_line();
        watch::end(wheatstone_process::signal_status(signal))
    });
    break_silence();
    // Those that call tools tell what they wait for themselves.
    let _stage = (!is_child).then(|| Stage::new("at work"));
    if let Some(seconds) = cli.timeout {
        wheatstone_process::set_limit(Duration::from_secs(seconds.into()));
    }
    let status = cli.command.run().unwrap_or_else(|failure| {
        tell!("error: {}", failure.told());
        failure.status()
    });
    let status = print::finish(status);
    watch::finish(status);
    ExitCode::from(status)
}

impl Command {
    /// Whether it is run in a child process: where models are loaded or tools called.
    fn is_supervised(&self) -> bool {
        use Command as C;
        match self {
            C::Cosim(_) | C::Replay(_) | C::Cover(_) | C::Waves(_) => true,
            C::Synth(_) | C::Baseline(_) | C::Prove(_) | C::Mutate(_) => true,
            C::Vectors(_) | C::Check(_) | C::Render(_) | C::Compare(_) | C::Rig(_) => false,
            C::Reproduce(_) | C::List(_) | C::Doctor(_) | C::Generate(_) => false,
        }
    }

    fn run(&self) -> Result<u8, Failure> {
        match self {
            Command::Cosim(args) => cosim::run(args),
            Command::Vectors(args) => vectors::write(args),
            Command::Check(args) => vectors::check(args),
            Command::Replay(args) => replay::run(args),
            Command::Cover(args) => cover::run(args),
            Command::Waves(args) => waves::run(args),
            Command::Render(args) => render::run(args),
            Command::Compare(args) => compare::run(args),
            Command::Rig(args) => rig::run(args),
            Command::Reproduce(args) => reproduce::run(args),
            Command::Synth(args) => synth::run(args),
            Command::Baseline(args) => baseline::run(args),
            Command::Prove(args) => prove::run(args),
            Command::Mutate(args) => mutate::run(args),
            Command::List(args) => info::list(args),
            Command::Doctor(args) => info::doctor(args),
            Command::Generate(args) => generate::run(args),
        }
    }
}

impl Common {
    fn settings(&self) -> Result<Settings, Failure> {
        Ok(Settings::new(&self.config, &self.parameters)?)
    }

    /// A scene from the eyes that the command line chose; tells what the projection leaves out of it.
    fn open(&self, name: &str, size: Option<[u32; 2]>) -> Result<Scene, Failure> {
        let scene = self.view.open(name, size)?;
        for warning in Volume::of(&scene, None)?.warnings() {
            tell!("warning: {name}: {warning} (see wheatstone rig)");
        }
        Ok(if self.wire { wire_frame(&scene)? } else { scene })
    }

    /// The polygons of the scene of that name; an error if there are none.
    fn geometry(
        &self,
        name: &str,
        size: Option<[u32; 2]>,
        settings: &Settings,
    ) -> Result<Geometry, Failure> {
        drawn(name, self.geometry_of(&self.open(name, size)?, settings)?)
    }

    /// The polygons of a scene for these settings.
    fn geometry_of(&self, scene: &Scene, settings: &Settings) -> Result<Geometry, Failure> {
        let cull = match self.cull {
            CullChoice::None => Cull::None,
            CullChoice::Back => Cull::Back,
        };
        let options = scene::Options { cull, specular_threshold: settings.specular_threshold };
        Ok(scene.geometry(&Formats::new(&settings.config), &options)?)
    }

    /// The options as words of a command line.
    fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        if self.config != "default" {
            words.extend(option("--config", &self.config));
        }
        words.extend(self.parameters.iter().flat_map(|p| option("--param", p)));
        words.extend(self.view.words());
        words.extend(choice("--cull", self.cull, CullChoice::None));
        if self.wire {
            words.push("--wire".into());
        }
        words
    }
}

impl View {
    /// A scene from these eyes; tells what of its files is not followed.
    fn open(&self, name: &str, size: Option<[u32; 2]>) -> Result<Scene, Failure> {
        let scene = scene::open_projected(name, size, self.rig.as_deref(), self.projection)?;
        for warning in scene.warnings.lines() {
            tell!("warning: {warning}");
        }
        let count = scene.warnings.count();
        if self.strict && count > 0 {
            let warnings = if count == 1 { "a warning" } else { "warnings" };
            let name = printable_path(Path::new(name));
            return Err(Failure::Input(format!(
                "{name}: {warnings}, which --strict makes an error; mend the files or leave out --strict"
            )));
        }
        Ok(scene)
    }

    /// The options as words of a command line.
    fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        words.extend(self.scene.iter().flat_map(|scene| option("--scene", scene)));
        if let Some([width, height]) = self.size {
            words.extend(option("--size", format!("{width}x{height}")));
        }
        words.extend(self.rig.iter().flat_map(|rig| option("--rig", rig.display())));
        words.extend(self.projection.iter().flat_map(|kind| option("--projection", kind.name())));
        if self.strict {
            words.push("--strict".into());
        }
        words
    }
}

/// An option with its value, in one word where the value looks like another option.
fn option(name: &str, value: impl std::fmt::Display) -> Vec<String> {
    let value = value.to_string();
    match value.starts_with('-') {
        true => vec![format!("{name}={value}")],
        false => vec![name.to_owned(), value],
    }
}

/// An option with names as values, unless it has its default.
fn choice<T: ValueEnum + PartialEq>(name: &str, value: T, default: T) -> Vec<String> {
    let named = value.to_possible_value().filter(|_| value != default);
    named.map_or(Vec::new(), |value| option(name, value.get_name()))
}

impl Stimulus {
    fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    /// The folder of the Verilog.
    fn rtl(&self) -> Result<PathBuf, Failure> {
        rtl_folder(&self.rtl)
    }
}

/// The folder of the Verilog, if need be that of the workspace.
fn rtl_folder(named: &Option<PathBuf>) -> Result<PathBuf, Failure> {
    if let Some(folder) = named {
        return Ok(folder.clone());
    }
    // As short as it can be: the name shows up in messages.
    if Path::new(MARK).exists() {
        return Ok("rtl".into());
    }
    workspace().map(|folder| folder.join("rtl")).ok_or_else(|| {
        Failure::Input(
            "no folder rtl with sam_formats.vh here or above; name it with --rtl DIR".into(),
        )
    })
}

/// The file by which a workspace is known.
const MARK: &str = "rtl/sam_formats.vh";

/// The workspace that the program is called in, or else the one that it was built from.
pub(crate) fn workspace() -> Option<PathBuf> {
    let here = std::env::current_dir().unwrap_or_default();
    let source = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = here.ancestors().chain(source.ancestors());
    folders.find(|folder| folder.join(MARK).exists()).map(Path::to_path_buf)
}

/// The folder of the workspace; an error if there is none.
fn root() -> Result<PathBuf, Failure> {
    workspace().ok_or_else(|| Failure::Input(format!("no workspace here or above: no {MARK}")))
}

/// The record of a workspace in that file; the first one has nothing before it.
fn recorded<R: Default, E: Into<Failure>>(
    root: &Path,
    file: &str,
    read: impl FnOnce(&Path) -> Result<R, E>,
) -> Result<R, Failure> {
    match root.join(file).exists() {
        true => read(root).map_err(Into::into),
        false => Ok(R::default()),
    }
}

/// Tells what is wrong, or not as in the record of that file, and gives the exit status.
fn checked(faults: &[String], file: &str) -> u8 {
    if faults.is_empty() {
        say!("as recorded in {file}");
        return OK;
    }
    faults.iter().for_each(|fault| say!("{fault}"));
    say!("where only {file} is out of date, renew it with --record in place of --check");
    MISMATCH
}

/// The record of coverage and replay.
fn verification_record() -> Result<Record, Failure> {
    Ok(Record::read(&root()?)?)
}

/// Changes the record of coverage and replay.
fn update_record(change: impl FnOnce(&mut Record)) -> Result<(), Failure> {
    let root = root()?;
    let mut record = recorded(&root, verification::FILE, Record::read)?;
    change(&mut record);
    record.write(&root)?;
    say!("{}: written; now run: wheatstone generate", verification::FILE);
    Ok(())
}

/// The polygons of the scene of that name, for commands to which nothing is no result.
fn drawn(name: &str, geometry: Geometry) -> Result<Geometry, Failure> {
    match geometry.counts.nothing() {
        Some(reason) => Err(Failure::Input(format!("{name}: nothing to draw: {reason}"))),
        None => Ok(geometry),
    }
}

/// The job that draws a scene's polygons.
pub(crate) fn job<'a>(settings: &Settings, geometry: &'a Geometry, options: Options) -> Job<'a> {
    Job::of(geometry, settings.config, options, settings.lookup)
}

/// A builder of models that tells on the terminal what it does.
fn builder(quiet: bool) -> Result<Builder, Failure> {
    let builder = Builder::new(
        Toolchain::find()?,
        cache_folder(workspace(), Builder::CACHE, |name| std::env::var_os(name)),
    );
    Ok(builder.on_progress(move |progress| {
        if !quiet {
            tell!("{progress}");
        }
    }))
}

/// Folder for what is built: `name` in the workspace, or else in the user's cache.
fn cache_folder(
    workspace: Option<PathBuf>,
    name: &str,
    variable: impl Fn(&str) -> Option<OsString>,
) -> PathBuf {
    if let Some(folder) = workspace {
        return folder.join(name);
    }
    let folder = |name: &str| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let caches = folder("XDG_CACHE_HOME").or_else(|| Some(folder("HOME")?.join(".cache")));
    caches.unwrap_or_else(std::env::temp_dir).join("wheatstone")
}

/// Folder for what a command writes when no other is named.
fn output_folder(name: &str) -> PathBuf {
    Path::new("target/wheatstone").join(name)
}

/// Names of the built-in scenes.
fn builtin_names() -> impl Iterator<Item = &'static str> {
    builtin::SCENES.iter().map(|scene| scene.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_repeated_with_its_projection() {
        #[derive(Parser)]
        struct Line {
            #[command(flatten)]
            common: Common,
        }
        let words = "x --scene room --rig eyes.json --projection piecewise";
        let line = Line::parse_from(words.split(' '));
        assert_eq!(line.common.words().join(" "), words.trim_start_matches("x "));
        let error = Line::try_parse_from("x --projection none".split(' ')).err();
        assert!(error.is_some_and(|e| e.to_string().contains("two-centres, shear")));
    }

    #[test]
    fn models_are_kept_in_the_workspace_or_in_the_cache_of_the_user() {
        let folder = |workspace: Option<&str>, set: &[(&str, &str)]| {
            cache_folder(workspace.map(PathBuf::from), Builder::CACHE, |name| {
                set.iter().find(|(n, _)| *n == name).map(|(_, value)| value.into())
            })
        };
        let (cache, home) = (("XDG_CACHE_HOME", "/c"), ("HOME", "/home/w"));
        let models = PathBuf::from("/w/target/wheatstone/models");
        assert_eq!(folder(Some("/w"), &[cache, home]), models);
        assert_eq!(folder(None, &[cache, home]), PathBuf::from("/c/wheatstone"));
        let at_home = PathBuf::from("/home/w/.cache/wheatstone");
        assert_eq!(folder(None, &[home]), at_home);
        // As its standard says, a relative one does not count.
        assert_eq!(folder(None, &[("XDG_CACHE_HOME", "c"), home]), at_home);
        assert_eq!(folder(None, &[]), std::env::temp_dir().join("wheatstone"));
    }

    #[test]
    fn options_are_told_as_they_are_read() {
        assert_eq!(option("--scene", "a b.obj"), ["--scene", "a b.obj"]);
        assert_eq!(option("--out", "-x"), ["--out=-x"]);
        assert_eq!(choice("--cull", CullChoice::Back, CullChoice::None), ["--cull", "back"]);
        assert!(choice("--cull", CullChoice::None, CullChoice::None).is_empty());
    }
}
