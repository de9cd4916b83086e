//! The signals of a model that the test bench reaches: every port of the module, and the ports
//! of the units inside it that are watched.
//!
//! The layout is the contract between the generated C++ ([`crate::shim`]) and the safe wrapper
//! ([`crate::model`]): both number the signals and the streams in its order.

use wheatstone_golden::interface::{Direction, Interface, Stream};

/// A unit inside a system whose streams are watched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Path below the system's module, generate blocks included: `g_edges.u_edge`.
    pub instance: String,
    /// Its Verilog module.
    pub module: &'static str,
    /// The streams that are watched.
    pub streams: Vec<Stream>,
}

impl Probe {
    /// Watches all streams of an instance of a unit.
    pub fn new(instance: impl Into<String>, unit: &Interface) -> Probe {
        let streams = unit.streams.clone();
        Probe { instance: instance.into(), module: unit.module, streams }
    }
}

/// A signal of the model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signal {
    /// Name of the port.
    pub name: String,
    /// Width in bits, 1 to 64.
    pub bits: u32,
    /// Seen from the module that has the port.
    pub direction: Direction,
}

/// The signals of a stream.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct StreamSignals {
    /// Direction of the beats, as the module sees it.
    pub direction: Direction,
    /// Number of fields of a beat.
    pub width: usize,
    /// For an answer: the stream of requests.
    pub answers: Option<usize>,
    first: usize,
}

impl StreamSignals {
    /// Signal `valid`.
    pub fn valid(&self) -> usize {
        self.first
    }

    /// Signal `ready`.
    pub fn ready(&self) -> usize {
        self.first + 1
    }

    /// The one of the two that the test bench drives, where the stream is a port.
    pub fn driven(&self) -> usize {
        match self.direction {
            Direction::Input => self.valid(),
            Direction::Output => self.ready(),
        }
    }

    /// The one of the two that the module drives.
    pub fn answered(&self) -> usize {
        match self.direction {
            Direction::Input => self.ready(),
            Direction::Output => self.valid(),
        }
    }

    /// Signal of a field.
    pub fn field(&self, index: usize) -> usize {
        self.first + 2 + index
    }

    /// All signals of the stream.
    pub fn signals(&self) -> std::ops::Range<usize> {
        self.first..self.first + 2 + self.width
    }
}

/// All signals, by number, and what they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Ports of the module first, then those of the probes.
    pub signals: Vec<Signal>,
    /// Number of the signals that are ports of the module.
    pub ports: usize,
    /// Streams of the module.
    pub streams: Vec<StreamSignals>,
    /// Streams of all probes, one after another, with the number of their probe.
    pub probed: Vec<(usize, StreamSignals)>,
    statics: usize,
}

/// Signal of the clock.
pub(crate) const CLOCK: usize = 0;
/// Signal of the reset.
pub(crate) const RESET: usize = 1;

impl Layout {
    /// The signals of a module and of the probes in it.
    pub fn new(interface: &Interface, probes: &[Probe]) -> Layout {
        let mut layout = Layout {
            signals: Vec::new(),
            ports: 0,
            streams: Vec::new(),
            probed: Vec::new(),
            statics: interface.statics.len(),
        };
        layout.add("clk", 1, Direction::Input);
        layout.add("rst", 1, Direction::Input);
        for field in &interface.statics {
            layout.add(field.name, field.bits, Direction::Input);
        }
        for field in &interface.flags {
            layout.add(field.name, field.bits, Direction::Output);
        }
        for stream in &interface.streams {
            let mut signals = layout.add_stream(stream);
            signals.answers = stream
                .answers
                .and_then(|request| interface.streams.iter().position(|s| s.name == request));
            layout.streams.push(signals);
        }
        layout.ports = layout.signals.len();
        for (number, probe) in probes.iter().enumerate() {
            for stream in &probe.streams {
                let signals = layout.add_stream(stream);
                layout.probed.push((number, signals));
            }
        }
        layout
    }

    /// Signal of a static input.
    pub fn static_input(&self, index: usize) -> usize {
        RESET + 1 + index
    }

    /// Signal of a flag.
    pub fn flag(&self, index: usize) -> usize {
        RESET + 1 + self.statics + index
    }

    /// The bits of the streams, in the masks of a cycle, that flow in `direction`.
    pub fn mask(&self, direction: Direction) -> u32 {
        let of = |(bit, stream): (usize, &StreamSignals)| {
            u32::from(stream.direction == direction) << bit
        };
        self.streams.iter().enumerate().map(of).sum()
    }

    fn add(&mut self, name: &str, bits: u32, direction: Direction) {
        let suffix = if direction == Direction::Input { "i" } else { "o" };
        self.signals.push(Signal { name: format!("{name}_{suffix}"), bits, direction });
    }

    fn add_stream(&mut self, stream: &Stream) -> StreamSignals {
        let first = self.signals.len();
        let opposite = match stream.direction {
            Direction::Input => Direction::Output,
            Direction::Output => Direction::Input,
        };
        self.add(&format!("{}_valid", stream.name), 1, stream.direction);
        self.add(&format!("{}_ready", stream.name), 1, opposite);
        for field in &stream.fields {
            self.add(&format!("{}_{}", stream.name, field.name), field.bits, stream.direction);
        }
        let direction = stream.direction;
        StreamSignals { direction, width: stream.fields.len(), answers: None, first }
    }
}
