//! Speed, each claim as a ratio of two things measured in one run:
//!
//! 1. the regression's loop against a C++ loop on the same model with the same stimulus that checks
//!    nothing;
//! 2. the golden hybrid against the hybrid in Verilator, on one core, in beats a second.
//!
//! `cargo bench -p wheatstone-testbench`; it fails if a claim does not hold.

use std::path::Path;
use std::time::Instant;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::interface::{Direction, Table};
use wheatstone_golden::pipeline::observer::Blind;
use wheatstone_golden::pipeline::{Edges, PrimaryBeat, Setup};
use wheatstone_golden::primary::Sink;
use wheatstone_golden::scene;
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::{Job as Scene, System};
use wheatstone_golden::targets::Target;
use wheatstone_golden::texture::Lookup;
use wheatstone_testbench::cases;
use wheatstone_testbench::regression::{model_probes, run_scene, Setting};
use wheatstone_testbench::tools::Toolchain;
use wheatstone_testbench::{compare_speed, Builder, Job, Library, Spec, Stalls};

const ROUNDS: usize = 7;
/// Least speed of the regression's loop in terms of the C++ loop.
const LOOP_TARGET: f64 = 0.8;
/// Least speed of the golden hybrid in terms of the Verilator hybrid.
const GOLDEN_TARGET: f64 = 8.0;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let builder = Builder::new(Toolchain::find()?, workspace.join(Builder::CACHE))
        .on_progress(|progress| eprintln!("{progress}"));
    let build = |target: Target, probed: bool| -> Result<Library, Failure> {
        let config = &Config::DEFAULT;
        let interface = target.interface(config);
        let probes = if probed { model_probes(target, config) } else { Vec::new() };
        let rtl = workspace.join("rtl");
        Ok(builder.build(&Spec { interface: &interface, rtl: &rtl, probes: &probes })?)
    };
    let loops = compare_loops(&build)?;
    let golden = compare_golden(&build(Target::Hybrid, false)?)?;
    if loops < LOOP_TARGET || golden < GOLDEN_TARGET {
        return Err(format!("a ratio is below its target: {loops:.2}, {golden:.1}").into());
    }
    Ok(())
}

/// The loops over all targets; returns the ratio of the sums.
fn compare_loops(build: &dyn Fn(Target, bool) -> Result<Library, Failure>) -> Result<f64, Failure> {
    println!("clocks a second, M                 regression   C++ loop   ratio");
    let (mut ours, mut theirs) = (0.0, 0.0);
    for target in Target::ALL {
        let library = build(target, false)?;
        let beats = if target.is_system() { 60_000 } else { 200_000 };
        let case = cases::random(target, &Config::DEFAULT, 3, beats);
        let (mut inputs, mut outputs) = (case.inputs.iter(), case.outputs.iter());
        let streams = library.interface().streams.clone();
        let tables: Vec<Option<&Table>> = streams
            .iter()
            .map(|s| if s.direction == Direction::Input { inputs.next() } else { outputs.next() })
            .collect();
        let job = Job {
            statics: &case.statics,
            tables: &tables,
            flags: &case.flags,
            stalls: Stalls::of_seed(8),
            ..Job::default()
        };
        let speed = compare_speed(&library, &job, ROUNDS)?;
        // Times, not speeds, add up over targets.
        ours += speed.clocks as f64 / speed.rust;
        theirs += speed.clocks as f64 / speed.cpp;
        println!(
            "{:<32}{:>13.2}{:>11.2}{:>8.2}",
            target.name(),
            speed.rust / 1e6,
            speed.cpp / 1e6,
            speed.ratio()
        );
    }
    println!("{:<56}{:>8.2}  (target {LOOP_TARGET})", "all targets, by time", theirs / ours);
    Ok(theirs / ours)
}

/// Beats of a scene, kept, so that only the system is timed.
#[derive(Default)]
struct Kept {
    beats: Vec<(PrimaryBeat, usize)>,
    records: Vec<(Setup, Edges)>,
}

impl Sink for Kept {
    fn polygon(&mut self, _: u32) {}
    fn records(&mut self, setup: &Setup, edges: &Edges) {
        self.records.push((*setup, *edges));
    }
    fn beat(&mut self, beat: &PrimaryBeat) {
        self.beats.push((*beat, self.records.len() - 1));
    }
}

fn compare_golden(library: &Library) -> Result<f64, Failure> {
    let config = Config::DEFAULT;
    let geometry = scene::open("teapot", None, None)?
        .geometry(&Formats::new(&config), &scene::Options::default())?;
    let job = Scene::of(&geometry, config, Options::new(&config), Lookup::Nearest);
    let mut kept = Kept::default();
    job.run(false, &mut kept);
    let beats = kept.beats.len() as f64;
    let (mut golden, mut whole, mut verilator) = (f64::MAX, f64::MAX, f64::MAX);
    for _ in 0..ROUNDS {
        let mut output = job.frames(false);
        let mut system = System::new(&job, false);
        let start = Instant::now();
        for (beat, record) in &kept.beats {
            system.beat(beat, &kept.records[*record], &mut output, &mut Blind);
        }
        golden = golden.min(start.elapsed().as_secs_f64());

        let start = Instant::now();
        let (frames, _) = job.derived(false);
        whole = whole.min(start.elapsed().as_secs_f64());
        assert!(frames.eyes[0].colour == output.eyes[0].colour);

        let stalls = Stalls::NONE;
        let setting = Setting { library, seed: 1, stalls, latency: Some(4), trace: None };
        let ran = run_scene(&setting, Target::Hybrid, &job)?;
        assert!(ran.ran.passed());
        verilator = verilator.min(ran.simulation.as_secs_f64());
    }
    let rate = |time: f64| beats / time / 1e6;
    println!("\nteapot, 640x480, {beats} beats              M beats/s   against Verilator");
    let ratio = verilator / golden;
    println!("Verilator hybrid                     {:>10.2}", rate(verilator));
    println!(
        "golden hybrid                        {:>10.2}{ratio:>10.1}  (target {GOLDEN_TARGET})",
        rate(golden)
    );
    println!(
        "golden hybrid with setup and primary {:>10.2}{:>10.1}",
        rate(whole),
        verilator / whole
    );
    Ok(ratio)
}
