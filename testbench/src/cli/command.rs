//! The commands of the program.

use super::failure::{Failure, BAD_INPUT, STATUSES};
use super::{
    baseline, compare, cosim, cover, generate, info, mutate, print, prove, render, replay,
    reproduce, rig, synth, vectors, waves,
};
use clap::{Parser, Subcommand};
use std::ffi::OsString;
use wheatstone_golden::text::printable;

/// An open stereoscopic rasteriser: simulate it, prove it, put it on an FPGA.
#[derive(Debug, Parser)]
#[command(name = "wheatstone", version, arg_required_else_help = true)]
#[command(after_help = format!("{EXAMPLES}\n\n{STATUSES}"))]
pub(super) struct Cli {
    #[command(subcommand)]
    pub command: Command,
    /// Stop a program that is called and has not ended after so many seconds, and a model that on one clock
    /// has used so many of processor time, or slept so many [default: 3600, 20 and 120]
    #[arg(long, global = true, value_name = "SECONDS", value_parser = clap::value_parser!(u32).range(1..))]
    pub timeout: Option<u32>,
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
pub(super) enum Command {
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
    /// Write rtl/sam_formats.vh and the tables of docs/ anew from the golden model's definitions and
    /// the records of synth, baseline, prove, mutate, cover and replay
    Generate(generate::GenerateArgs),
}

impl Command {
    /// True if it is run in a child process: where models are loaded or tools called.
    pub fn is_supervised(&self) -> bool {
        use Command as C;
        match self {
            C::Cosim(_) | C::Replay(_) | C::Cover(_) | C::Waves(_) => true,
            C::Synth(_) | C::Baseline(_) | C::Prove(_) | C::Mutate(_) => true,
            C::Vectors(_) | C::Check(_) | C::Render(_) | C::Compare(_) | C::Rig(_) => false,
            C::Reproduce(_) | C::List(_) | C::Doctor(_) | C::Generate(_) => false,
        }
    }

    pub fn run(&self) -> Result<u8, Failure> {
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

/// Reads the command line; where there is nothing to run, says so and gives the exit status.
pub(super) fn parse() -> Result<Cli, u8> {
    let words: Vec<OsString> = std::env::args_os().collect();
    let error = match Cli::try_parse_from(&words) {
        Ok(cli) => return Ok(cli),
        Err(error) => error,
    };
    // The message repeats what it is about: it is made of words that can be shown.
    let shown = words.iter().map(|word| printable(&word.to_string_lossy()));
    match Cli::try_parse_from(shown) {
        Err(shown) if shown.use_stderr() => drop(shown.print()),
        Err(help) => print::check(help.print()),
        Ok(_) => tell!("{error}"),
    }
    Err(u8::try_from(error.exit_code()).unwrap_or(BAD_INPUT))
}
