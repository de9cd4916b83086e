//! `wheatstone cosim`.

use super::builder::builder;
use super::failure::{Failure, MISMATCH, OK};
use super::folders::output_folder;
use super::ignored::refuse;
use super::options::{builtin_names, parse_target, Common, Stimulus};
use super::places::Places;
use super::print;
use super::progress::{is_terminal, turn};
use super::words::{choice, option};
use crate::numbers::counted;
use crate::regression::{self, Entry, Event, NamedScene, Plan, Waves, BEATS_LIMIT};
use crate::settings::Settings;
use crate::shell::command_line;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use wheatstone_golden::files::{self, Set, Tidy};
use wheatstone_golden::formats::Eye;
use wheatstone_golden::picture::{frame_picture, write_png};
use wheatstone_golden::scene::Geometry;
use wheatstone_golden::targets::Target;
use wheatstone_golden::text::printable_path;

/// Scenes that the systems draw where none is named, and their sizes.
const SCENES_AT_FULL_SIZE: [&str; 2] = ["teapot", "room"];
/// Size of the other scenes in the default regression.
const SMALL: [u32; 2] = [320, 240];

#[derive(Debug, Args)]
pub(super) struct CosimArgs {
    /// Units and systems (see `wheatstone list`); none means all, or with --scene all systems
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
    /// Only the case or scene of this name
    #[arg(long, value_name = "NAME")]
    case: Option<String>,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    stimulus: Stimulus,
    /// When to write waveforms
    #[arg(long, value_enum, default_value = "on-failure")]
    waves: WavesChoice,
    /// Worker threads [default: one a processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Write a JUnit XML report
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write a JSON report
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Folder for waveforms and pictures [default: target/wheatstone/cosim]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WavesChoice {
    /// Run a case that failed again with waveforms around the first difference
    OnFailure,
    /// Write waveforms of every target's first cases too
    Always,
    /// Write none
    Never,
}

pub(super) fn run(args: &CosimArgs) -> Result<u8, Failure> {
    let places = Places::of_view(&args.common.view).file("--json", &args.json);
    places.file("--junit", &args.junit).folder("--out", args.out.as_deref()).check()?;
    let settings = args.common.settings()?;
    let targets = targets(args)?;
    let scenes = scene_names(args, &targets, &settings)?;
    if args.stimulus.beats.is_some_and(|beats| beats > BEATS_LIMIT) {
        return Err(Failure::Input(format!(
            "--beats: a run has {BEATS_LIMIT} at most; for more, run again with another --seed"
        )));
    }
    // The command that repeats a case has the options of the run that it failed in.
    if args.case.is_none() {
        if scenes.is_empty() {
            args.common.refuse_scene_options()?;
        }
        args.common.refuse_foreign(&targets)?;
        let only_scenes = args.common.view.scene.is_some();
        refuse("--beats", only_scenes && args.stimulus.beats.is_some(), "a scene is drawn whole")?;
    }
    let out = args.out.clone().unwrap_or_else(|| output_folder("cosim"));
    let _tidy = Tidy::new(&out);
    let rtl = args.stimulus.rtl()?;
    let scenes = load(args, &scenes, &settings)?;
    let scenes = scenes
        .iter()
        .map(|(name, geometry)| NamedScene { name: name.clone(), job: settings.job(geometry) });
    let arguments: Vec<String> =
        std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    let processors = std::thread::available_parallelism().map_or(1, |n| n.get());
    let plan = Plan {
        targets,
        settings,
        program: arguments.first().cloned().unwrap_or_default(),
        words: words(args),
        case: args.case.clone(),
        scenes: scenes.collect(),
        scenes_only: args.common.view.scene.is_some(),
        seed: args.stimulus.seed(),
        beats: args.stimulus.beats,
        jobs: args.jobs.map_or(processors, usize::from),
        waves: match args.waves {
            WavesChoice::OnFailure => Waves::OnFailure,
            WavesChoice::Always => Waves::Always,
            WavesChoice::Never => Waves::Never,
        },
        rtl,
        out: out.clone(),
    };
    let console = Console::new();
    let builder = builder(is_terminal())?;
    let mut entries = regression::run(&plan, &builder, &|event| console.tell(event))?;
    console.finish();
    say!("{}", regression::table(&entries).trim_end());
    let command = command_line(&arguments);
    let mut errors = write(args, &entries, &command, &out);
    errors.extend(entries.iter().filter_map(uncompared));
    for entry in &mut entries {
        let error = entry.waves_error.take();
        errors.extend(error.map(|error| Failure::Waves(entry.title(), error)));
    }
    let failures: Vec<_> = entries.iter().filter_map(|entry| entry.failure.as_ref()).collect();
    failures.iter().for_each(|failure| say!("\nMISMATCH\n{failure}"));
    errors.iter().for_each(|error| tell!("error: {}", error.told()));
    Ok(status(!failures.is_empty(), &errors))
}

/// The exit status: that of a mismatch, or else the worst of what could not be done.
fn status(differs: bool, errors: &[Failure]) -> u8 {
    match differs {
        true => MISMATCH,
        false => errors.iter().map(Failure::status).max().unwrap_or(OK),
    }
}

/// Says of a case that nothing in it was compared.
fn uncompared(entry: &Entry) -> Option<Failure> {
    let what = || Failure::Input(format!("{}: nothing was compared", entry.title()));
    entry.is_vain().then(what)
}

/// Writes reports and pictures; what could not be written keeps no other from being so.
fn write(args: &CosimArgs, entries: &[Entry], command: &str, out: &Path) -> Vec<Failure> {
    let json =
        |file: &PathBuf| Ok(files::write(file, regression::json(entries, command).as_bytes())?);
    let junit = |file: &PathBuf| {
        let xml = regression::junit(entries).map_err(|error| Failure::Input(error.to_string()))?;
        Ok(files::write(file, xml.as_bytes())?)
    };
    let shown = |entry: &Entry| {
        for file in pictures(entry, out)? {
            say!("image {}", printable_path(&file));
        }
        Ok(())
    };
    let reports = args.json.iter().map(json).chain(args.junit.iter().map(junit));
    reports.chain(entries.iter().map(shown)).filter_map(Result::err).collect()
}

/// The targets that are run.
fn targets(args: &CosimArgs) -> Result<Vec<Target>, Failure> {
    let has_scene = args.common.view.scene.is_some();
    if args.targets.is_empty() {
        return Ok(Target::ALL.into_iter().filter(|t| t.is_system() || !has_scene).collect());
    }
    match args.targets.iter().find(|t| has_scene && !t.is_system()) {
        Some(unit) => Err(Failure::Input(format!(
            "--scene: {} draws no scenes, only the systems minimal, hybrid and stereo do",
            unit.name()
        ))),
        None => Ok(args.targets.clone()),
    }
}

/// The scenes that are to be drawn; an error if there is no case of the name that was given.
fn scene_names<'a>(
    args: &'a CosimArgs,
    targets: &[Target],
    settings: &Settings,
) -> Result<Vec<&'a str>, Failure> {
    let mut scenes: Vec<&str> = match &args.common.view.scene {
        Some(name) => vec![name],
        None if targets.iter().any(|t| t.is_system()) => builtin_names().collect(),
        None => Vec::new(),
    };
    let Some(case) = &args.case else { return Ok(scenes) };
    let others = match args.common.view.scene {
        Some(_) => Vec::new(),
        None => regression::case_names(targets, settings),
    };
    let mut names: Vec<&str> = others.iter().map(String::as_str).collect();
    names.extend(&scenes);
    if !names.contains(&case.as_str()) {
        let names: Vec<String> = names.iter().map(|name| format!("“{name}”")).collect();
        let names = names.join(", ");
        return Err(Failure::Input(format!("--case {case}: no such case; there are: {names}")));
    }
    scenes.retain(|name| name == case);
    Ok(scenes)
}

/// The options that say what is run and where, for the command that repeats a case. Reports stay those
/// of the first run.
fn words(args: &CosimArgs) -> Vec<String> {
    let mut words = args.common.words();
    words.extend(args.stimulus.rtl.iter().flat_map(|rtl| option("--rtl", rtl.display())));
    words.extend(choice("--waves", args.waves, WavesChoice::OnFailure));
    words.extend(args.jobs.iter().flat_map(|jobs| option("--jobs", jobs)));
    words.extend(args.out.iter().flat_map(|out| option("--out", out.display())));
    words
}

/// The polygons of scenes.
fn load(
    args: &CosimArgs,
    scenes: &[&str],
    settings: &Settings,
) -> Result<Vec<(String, Geometry)>, Failure> {
    let load = |&name: &&str| {
        let small = args.common.view.scene.is_none() && !SCENES_AT_FULL_SIZE.contains(&name);
        let size = args.common.view.size.or(small.then_some(SMALL));
        Ok((name.to_owned(), args.common.geometry(name, size, settings)?))
    };
    scenes.iter().map(load).collect()
}

/// Writes what the Verilog drew.
fn pictures(entry: &Entry, out: &Path) -> Result<Vec<PathBuf>, Failure> {
    let Some(scene) = &entry.scene else { return Ok(Vec::new()) };
    let stem = Path::new(&entry.name).file_stem().map_or("scene".into(), |s| s.to_string_lossy());
    let folder = out.join(format!("{}-{stem}", entry.target.name()));
    let set = Set::new(&folder)?;
    let mut files = Vec::new();
    for eye in Eye::BOTH {
        let frame = &scene.frames.eyes[eye as usize];
        let file = set.path().join(format!("{}.png", eye.name()));
        write_png(&file, &frame_picture(frame))?;
        files.push(set.named(&file));
    }
    set.finish("left.png", |_| false)?;
    Ok(files)
}

/// Tells how the regression goes: a bar in a terminal, a line a case elsewhere.
struct Console {
    bar: Option<ProgressBar>,
    lock: Mutex<()>,
}

impl Console {
    fn new() -> Console {
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {wide_msg} {elapsed}");
        let bar = is_terminal().then(|| ProgressBar::new(0));
        if let (Some(bar), Ok(style)) = (&bar, style) {
            bar.set_style(style);
            bar.enable_steady_tick(std::time::Duration::from_millis(200));
        }
        turn(bar.clone());
        Console { bar, lock: Mutex::new(()) }
    }

    fn tell(&self, event: Event) {
        let _guard = self.lock.lock();
        match (event, &self.bar) {
            (Event::Planned(cases), Some(bar)) => bar.set_length(cases as u64),
            (Event::Begin(target, case), Some(bar)) => {
                bar.set_message(print::clean(&format!("{}: {case}", target.name())));
            }
            (Event::Mismatch(failure), Some(bar)) => {
                bar.println(print::clean(&Console::mismatch(failure)))
            }
            (Event::Mismatch(failure), None) => tell!("{}", Console::mismatch(failure)),
            (Event::End(_), Some(bar)) => bar.inc(1),
            (Event::End(entry), None) if entry.passed() => tell!("{}", Console::line(entry)),
            _ => {}
        }
    }

    fn line(entry: &Entry) -> String {
        let (target, name) = (entry.target.name(), &entry.name);
        let (beats, seconds) = (counted(entry.beats, "beat"), entry.time.as_secs_f64());
        format!("equal {target} {name}: {beats} in {seconds:.1} s")
    }

    fn mismatch(failure: &regression::Failure) -> String {
        let regression::Failure { target, case, what, repeat, .. } = failure;
        format!("MISMATCH {target} {case}: {what}\n  repeat with   {repeat}")
    }

    fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        turn(None);
    }
}

#[cfg(test)]
mod tests {
    use super::super::failure::{BAD_INPUT, UNFINISHED};
    use super::*;
    use crate::regression::RegressionError;
    use std::io;
    use wheatstone_golden::files::WriteError;

    #[test]
    fn the_worst_of_what_could_not_be_done_is_the_status() {
        let unwritten = |kind: io::ErrorKind| {
            Failure::Write(WriteError { file: "report".into(), source: kind.into() })
        };
        let waves = |kind: io::ErrorKind| {
            let error = RegressionError::File { path: "x.fst".into(), source: kind.into() };
            Failure::Waves("filter random".into(), error)
        };
        let (full, held) = (io::ErrorKind::StorageFull, io::ErrorKind::TimedOut);
        assert_eq!(status(false, &[]), OK);
        assert_eq!(status(false, &[unwritten(full)]), BAD_INPUT);
        assert_eq!(status(false, &[unwritten(held), unwritten(full)]), UNFINISHED);
        assert_eq!(status(false, &[unwritten(full), waves(held)]), UNFINISHED);
        assert_eq!(status(true, &[unwritten(held)]), MISMATCH);
        let told = waves(full).told();
        assert!(told.starts_with("waveforms of filter random: x.fst: "), "{told}");
        assert!(told.ends_with("make room on that disk and try again"), "{told}");
    }
}
