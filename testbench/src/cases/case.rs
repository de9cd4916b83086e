//! A case: stimulus and expected beats.

use std::fmt;
use wheatstone_golden::config::Config;
use wheatstone_golden::frame::Frames;
use wheatstone_golden::interface::{Beat, Direction, Interface, Table};
use wheatstone_golden::targets::{Probe, Target};

/// The stimulus of a target and its expected beats.
#[derive(Clone, Debug)]
pub struct Case {
    /// The unit or system.
    pub target: Target,
    /// Build parameters.
    pub config: Config,
    /// Name in reports.
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
    pub(super) fn empty(target: Target, config: &Config, name: impl fmt::Display) -> Case {
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
    pub(super) fn give<B: Beat>(&mut self, beat: &B) {
        self.inputs[0].push(beat);
    }

    /// Adds a beat to the first output stream.
    pub(super) fn expect<B: Beat>(&mut self, beat: &B) {
        self.outputs[0].push(beat);
    }

    /// Adds the beats of another case of a target without history from pixel to pixel.
    pub(super) fn append(&mut self, other: Case) {
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
