//! Cases: what is fed to a target and what the golden model says must come out.
//!
//! A case is made before the simulator runs, so that a mismatch can be repeated from the seed alone.
//! Random cases are constrained: they are legal streams, weighted towards the edges of ranges.

mod combinational;
mod interpolators;
mod pixels;
mod primary;
mod systems;

use std::fmt;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::frame::Frames;
use wheatstone_golden::interface::{Beat, Direction, Interface, Table};
use wheatstone_golden::targets::{Probe, Target};

pub use primary::monocular;
pub use systems::{output_number, random_polygons, recorded, recorded_unit};

/// What a target is fed and what must come out.
#[derive(Clone, Debug)]
pub struct Case {
    /// The unit or system.
    pub target: Target,
    /// Build parameters.
    pub config: Config,
    /// What the case is, in reports.
    pub name: String,
    /// Values of the static inputs, in the interface's order.
    pub statics: Vec<u64>,
    /// Beats of the input streams, in the interface's order.
    pub inputs: Vec<Table>,
    /// Beats expected of the output streams, in the interface's order.
    pub outputs: Vec<Table>,
    /// Values of the flags at the end.
    pub flags: Vec<u64>,
    /// Beats expected at the units inside a system.
    pub probes: Vec<(Probe, Table)>,
    /// For a system: its frame buffers before, and what they must hold after.
    pub memory: Option<Box<[Frames; 2]>>,
    /// To be run with every pair of stall patterns.
    pub all_stalls: bool,
}

impl Case {
    /// The target's interface.
    pub fn interface(&self) -> Interface {
        self.target.interface(&self.config)
    }

    /// An empty case.
    fn empty(target: Target, config: &Config, name: impl fmt::Display) -> Case {
        let interface = target.interface(config);
        let tables = |direction| {
            let streams = interface.streams.iter().filter(move |s| s.direction == direction);
            streams.map(|s| Table::new(&s.fields)).collect()
        };
        Case {
            target,
            config: *config,
            name: name.to_string(),
            statics: vec![0; interface.statics.len()],
            inputs: tables(Direction::Input),
            outputs: tables(Direction::Output),
            flags: vec![0; interface.flags.len()],
            probes: Vec::new(),
            memory: None,
            all_stalls: false,
        }
    }

    /// Adds a beat to the first input stream.
    fn give<B: Beat>(&mut self, beat: &B) {
        self.inputs[0].push(beat);
    }

    /// Adds a beat to the first output stream.
    fn expect<B: Beat>(&mut self, beat: &B) {
        self.outputs[0].push(beat);
    }

    /// Adds the beats of another case of a target without history from pixel to pixel.
    fn append(&mut self, other: Case) {
        let tables = self.inputs.iter_mut().zip(other.inputs);
        for (table, more) in tables.chain(self.outputs.iter_mut().zip(other.outputs)) {
            (0..more.len()).for_each(|n| table.push_row(more.row(n)));
        }
    }

    /// The answers that the golden model got to a system's reads.
    pub fn responses(&self) -> Option<&Table> {
        let interface = self.interface();
        let inputs = interface.streams.iter().filter(|s| s.direction == Direction::Input);
        let answers = inputs.zip(&self.inputs).find(|(stream, _)| stream.answers.is_some());
        answers.map(|(_, table)| table)
    }

    /// Beats given to the first input of a unit, or to `beat` of a system.
    pub fn beats(&self) -> u64 {
        let inputs = self.interface();
        let inputs = inputs.streams.iter().filter(|s| s.direction == Direction::Input);
        let longest = inputs.zip(&self.inputs).map(|(_, table)| table.len()).max();
        longest.unwrap_or(0) as u64
    }
}

/// A random case of about `beats` beats for a unit or a system.
pub fn random(target: Target, config: &Config, seed: u64, beats: usize) -> Case {
    match target {
        Target::XInterpolator => interpolators::x(config, seed, beats),
        Target::YInterpolator => interpolators::y(config, seed, beats),
        Target::EdgeInterpolator => interpolators::edge(config, seed, beats),
        Target::Sampler => pixels::sampler(config, seed, beats),
        Target::Filter => pixels::filter(config, seed, beats),
        Target::Coverage => combinational::coverage_case(config, seed, beats),
        Target::Blend => combinational::blend_case(config, seed, beats),
        Target::Display => combinational::display_case(config, seed, beats),
        Target::Redirect => combinational::redirect_case(config, seed, beats),
        Target::Traversal | Target::Primary => primary::random(target, config, seed, beats),
        Target::Mono => primary::mono_random(config, seed, beats),
        Target::Minimal | Target::Hybrid | Target::Stereo => {
            systems::random(target, config, seed, beats)
        }
    }
}

/// Cases of the packs of a target, each with what its folder's name has behind the target's: about `beats`
/// random beats in each, and with them what random beats rarely are. Static inputs that say which of two ways a target works have
/// a pack for either.
pub fn for_packs(
    target: Target,
    config: &Config,
    seed: u64,
    beats: usize,
) -> Vec<(&'static str, Case)> {
    let one = |case| vec![("", case)];
    match target {
        Target::XInterpolator => one(interpolators::x_for_pack(config, seed, beats)),
        Target::Sampler => one(pixels::sampler_for_pack(config, seed, beats)),
        Target::Filter => one(pixels::filter_for_pack(config, seed, beats)),
        Target::Redirect => [("", false), ("-single", true)]
            .map(|(suffix, single)| {
                (suffix, combinational::redirect_slots(config, seed, beats, single))
            })
            .to_vec(),
        Target::Traversal | Target::Primary => one(primary::for_pack(target, config, seed, beats)),
        Target::Mono => [("", Eye::Left), ("-right", Eye::Right)]
            .map(|(suffix, eye)| (suffix, primary::mono_for_pack(config, seed, beats, eye)))
            .to_vec(),
        Target::Minimal | Target::Hybrid | Target::Stereo => [("", false), ("-single", true)]
            .map(|(suffix, single)| {
                (suffix, systems::for_pack(target, config, seed, beats, single))
            })
            .to_vec(),
        _ => one(random(target, config, seed, beats)),
    }
}

/// The directed cases of a target: corners that random beats rarely meet.
pub fn directed(target: Target, config: &Config) -> Vec<Case> {
    match target {
        Target::XInterpolator => vec![interpolators::x_corners(config)],
        Target::YInterpolator => vec![interpolators::y_corners(config)],
        Target::EdgeInterpolator => vec![interpolators::edge_corners(config)],
        Target::Sampler => vec![pixels::sampler_corners(config)],
        Target::Filter => vec![pixels::filter_corners(config)],
        Target::Coverage => vec![combinational::coverage_corners(config)],
        Target::Blend => vec![combinational::blend_corners(config)],
        Target::Display => {
            let widest = Formats::new(config).max_size;
            [1, widest].map(|width| combinational::display_corners(config, width)).to_vec()
        }
        Target::Redirect => {
            [false, true].map(|single| combinational::redirect_corners(config, single)).to_vec()
        }
        Target::Traversal | Target::Primary => vec![primary::corners(target, config)],
        Target::Mono => {
            let ones = Eye::BOTH.map(|eye| {
                [primary::mono_crowd(config, eye), primary::mono_barely_whole(config, eye)]
            });
            ones.into_iter().flatten().chain(primary::mono_large(config)).collect()
        }
        Target::Minimal | Target::Hybrid | Target::Stereo => systems::directed(target, config),
    }
}
