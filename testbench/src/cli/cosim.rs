//! `wheatstone cosim`.

use super::*;
use crate::regression::{self, Entry, Event, NamedScene, Plan, Waves};
use std::sync::Mutex;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::picture::{frame_picture, write_file, write_png};

/// Scenes that the systems draw where none is named, and their sizes.
const SCENES_AT_FULL_SIZE: [&str; 2] = ["teapot", "room"];
/// Size of the other scenes in the default regression.
const SMALL: [u32; 2] = [320, 240];

#[derive(Debug, Args)]
pub(super) struct CosimArgs {
    /// Units and systems (see `wheatstone list`); none means all
    #[arg(value_name = "TARGET", value_parser = parse_target)]
    targets: Vec<Target>,
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
    let settings = args.common.settings()?;
    let targets = if args.targets.is_empty() { Target::ALL.to_vec() } else { args.targets.clone() };
    let systems = targets.iter().any(|t| t.is_system());
    if args.common.scene.is_some() && !systems {
        return Err(Failure::Input(
            "--scene: only the systems minimal and hybrid draw scenes".into(),
        ));
    }
    let out = args.out.clone().unwrap_or_else(|| output_folder("cosim"));
    let rtl = args.stimulus.rtl()?;
    let scenes = if systems { load(args, &settings)? } else { Vec::new() };
    let scenes = scenes.iter().map(|(name, geometry)| NamedScene {
        name: name.clone(),
        job: job(&settings, geometry, settings.options),
    });
    let processors = std::thread::available_parallelism().map_or(1, |n| n.get());
    let plan = Plan {
        targets,
        settings,
        words: args.common.words(),
        scenes: scenes.collect(),
        scenes_only: args.common.scene.is_some(),
        seed: args.stimulus.seed,
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
    let entries = regression::run(&plan, &builder, &|event| console.tell(event))?;
    console.finish();
    say!("{}", regression::table(&entries).trim_end());
    let command = std::env::args().collect::<Vec<_>>().join(" ");
    if let Some(file) = &args.json {
        write_file(file, regression::json(&entries, &command).as_bytes())?;
    }
    if let Some(file) = &args.junit {
        let xml = regression::junit(&entries).map_err(|error| Failure::Input(error.to_string()))?;
        write_file(file, xml.as_bytes())?;
    }
    for entry in &entries {
        for file in pictures(entry, &out)? {
            say!("image {}", file.display());
        }
    }
    let mut failed = entries.iter().filter_map(|e| e.failure.as_ref()).peekable();
    let status = if failed.peek().is_some() { MISMATCH } else { OK };
    for failure in failed {
        say!("\nMISMATCH\n{failure}");
    }
    Ok(status)
}

/// The scenes that the systems draw.
fn load(args: &CosimArgs, settings: &Settings) -> Result<Vec<(String, Geometry)>, Failure> {
    let load = |name: &str, size: Option<[u32; 2]>| {
        Ok((name.to_owned(), args.common.geometry(name, size, settings)?))
    };
    match &args.common.scene {
        Some(name) => Ok(vec![load(name, args.common.size)?]),
        None => builtin_names()
            .map(|name| {
                let small = !SCENES_AT_FULL_SIZE.contains(&name);
                load(name, args.common.size.or(small.then_some(SMALL)))
            })
            .collect(),
    }
}

/// Writes what the Verilog drew.
fn pictures(entry: &Entry, out: &Path) -> Result<Vec<PathBuf>, Failure> {
    let Some(scene) = &entry.scene else { return Ok(Vec::new()) };
    let stem = Path::new(&entry.name).file_stem().map_or("scene".into(), |s| s.to_string_lossy());
    let folder = out.join(format!("{}-{stem}", entry.target.name()));
    std::fs::create_dir_all(&folder)
        .map_err(|source| WriteError { file: folder.clone(), source })?;
    let mut files = Vec::new();
    for eye in Eye::BOTH {
        let frame = &scene.frames.eyes[eye as usize];
        let file = folder.join(format!("{}.png", eye.name()));
        write_png(&file, &frame_picture(frame))?;
        files.push(file);
    }
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
        Console { bar, lock: Mutex::new(()) }
    }

    fn tell(&self, event: Event) {
        let _guard = self.lock.lock();
        match (event, &self.bar) {
            (Event::Planned(cases), Some(bar)) => bar.set_length(cases as u64),
            (Event::Begin(target, case), Some(bar)) => {
                bar.set_message(format!("{}: {case}", target.name()));
            }
            (Event::End(entry), Some(bar)) => {
                bar.inc(1);
                if !entry.passed() {
                    bar.println(Console::line(entry));
                }
            }
            (Event::End(entry), None) => tell!("{}", Console::line(entry)),
            _ => {}
        }
    }

    fn line(entry: &Entry) -> String {
        let result = if entry.passed() { "equal" } else { "MISMATCH" };
        let seconds = entry.time.as_secs_f64();
        format!(
            "{result} {} {}: {} beats in {seconds:.1} s",
            entry.target.name(),
            entry.name,
            entry.beats
        )
    }

    fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
