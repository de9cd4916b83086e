//! Recording a system at work: every stream at its ports, and those of the units inside.

use crate::formats::{Eye, Formats};
use crate::frame::Frames;
use crate::interface::{Beat, Table};
use crate::pipeline::observer::{Observer, Unit};
use crate::pipeline::{Edges, Op, Output, Pixel, PrimaryBeat, Request, Response, Setup};
use crate::primary::{Counts, Sink};
use crate::stereo::{Job, System};
use std::collections::BTreeMap;

/// Everything that passed a system's ports while it drew a job, and what it drew.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Streams by name: `setup`, `edges`, `beat`, `request`, `response`, `left`, `right`.
    pub streams: BTreeMap<&'static str, Table>,
    /// Beats that the units gave.
    pub outputs: BTreeMap<Unit, Table>,
    /// Beats that the units took.
    pub inputs: BTreeMap<Unit, Table>,
    /// The frame buffers afterwards.
    pub frames: Frames,
    /// Polygons by the way they were drawn.
    pub counts: Counts,
    /// Number of `beat` beats before each polygon, and its id.
    pub polygons: Vec<(u64, u32)>,
    /// State of the error flag at the end.
    pub error: bool,
}

/// The streams at the ports.
struct Ports {
    streams: BTreeMap<&'static str, Table>,
    frames: Frames,
}

impl Ports {
    #[inline]
    fn push<B: Beat>(&mut self, stream: &'static str, beat: &B) {
        if let Some(table) = self.streams.get_mut(stream) {
            table.push(beat);
        }
    }
}

impl Output for Ports {
    fn read(&mut self, request: &Request) -> Response {
        let response = self.frames.read(request);
        self.push("request", request);
        self.push("response", &response);
        response
    }
    fn write(&mut self, stream: Eye, pixel: &Pixel) {
        self.frames.apply(pixel);
        self.push(stream.name(), pixel);
    }
}

/// Tables of the units' beats.
struct Watch {
    formats: Formats,
    outputs: BTreeMap<Unit, Table>,
    inputs: BTreeMap<Unit, Table>,
}

impl Observer for Watch {
    const ACTIVE: bool = true;
    fn input<B: Beat>(&mut self, unit: Unit, beat: &B) {
        let formats = self.formats;
        self.inputs.entry(unit).or_insert_with(|| Table::of::<B>(&formats)).push(beat);
    }
    fn output<B: Beat>(&mut self, unit: Unit, beat: &B) {
        let formats = self.formats;
        self.outputs.entry(unit).or_insert_with(|| Table::of::<B>(&formats)).push(beat);
    }
}

/// Feeds a system and records it.
struct Recorder {
    system: System,
    ports: Ports,
    watch: Watch,
    records: (Setup, Edges),
    polygons: Vec<(u64, u32)>,
    beats: u64,
}

impl Sink for Recorder {
    fn polygon(&mut self, id: u32) {
        self.ports.frames.id = id;
        self.polygons.push((self.beats, id));
    }
    fn records(&mut self, setup: &Setup, edges: &Edges) {
        self.records = (*setup, *edges);
    }
    fn beat(&mut self, beat: &PrimaryBeat) {
        self.beats += 1;
        if beat.op == Op::Load {
            let (setup, edges) = self.records;
            self.ports.push("setup", &setup);
            self.ports.push("edges", &edges);
        }
        self.ports.push("beat", beat);
        self.system.beat(beat, &self.records, &mut self.ports, &mut self.watch);
    }
}

/// A recorder that beats can be fed to one by one.
pub struct Tape(Recorder);

impl Tape {
    /// A tape for a job's system; the job's polygons are not drawn by this.
    pub fn new(job: &Job, minimal: bool) -> Tape {
        let formats = if minimal { Formats::minimal(&job.config) } else { Formats::new(&job.config) };
        let f = &formats;
        let streams = BTreeMap::from([
            ("setup", Table::of::<Setup>(f)),
            ("edges", Table::of::<Edges>(f)),
            ("beat", Table::of::<PrimaryBeat>(f)),
            ("request", Table::of::<Request>(f)),
            ("response", Table::of::<Response>(f)),
            ("left", Table::of::<Pixel>(f)),
            ("right", Table::of::<Pixel>(f)),
        ]);
        Tape(Recorder {
            system: System::new(job, minimal),
            ports: Ports { streams, frames: job.frames(minimal) },
            watch: Watch { formats, outputs: BTreeMap::new(), inputs: BTreeMap::new() },
            records: Default::default(),
            polygons: Vec::new(),
            beats: 0,
        })
    }

    /// The tape as a sink of the primary pipeline.
    pub fn sink(&mut self) -> &mut impl Sink {
        &mut self.0
    }

    /// What was recorded.
    pub fn finish(self, counts: Counts) -> Recording {
        let Recorder { system, ports, watch, polygons, .. } = self.0;
        let Ports { streams, frames } = ports;
        let Watch { outputs, inputs, .. } = watch;
        Recording { streams, outputs, inputs, frames, counts, polygons, error: system.error() }
    }
}

impl Recording {
    /// Draws a job with a system and records it.
    pub fn of(job: &Job, minimal: bool) -> Recording {
        let mut tape = Tape::new(job, minimal);
        let counts = job.run(minimal, tape.sink());
        tape.finish(counts)
    }
}
