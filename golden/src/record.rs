//! Recording a system at work: every stream at its ports, and those of the units inside.

use crate::formats::{Eye, Formats};
use crate::frame::Frames;
use crate::interface::{Beat, Table};
use crate::pipeline::observer::{Observer, Unit};
use crate::pipeline::{
    Edges, Op, Output, Pixel, Planes, PrimaryBeat, Request, Response, Setup, Walk,
};
use crate::primary::Sink;
use crate::stereo::{Job, System};
use std::collections::BTreeMap;

/// Everything that passed a system's ports, and between its units, in a part of a job.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Streams by name: `walk`, `planes`, `setup`, `edges`, `beat`, `request`, `response`, `left`, `right`.
    pub streams: BTreeMap<&'static str, Table>,
    /// Beats that the units gave.
    pub outputs: BTreeMap<Unit, Table>,
    /// Beats that the units took.
    pub inputs: BTreeMap<Unit, Table>,
    /// Number of `beat` beats before each polygon, counted from the job's start, and its id.
    pub polygons: Vec<(u64, u32)>,
    /// Number of `beat` beats before this part.
    pub first_beat: u64,
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
    keep_inputs: bool,
    outputs: BTreeMap<Unit, Table>,
    inputs: BTreeMap<Unit, Table>,
}

impl Observer for Watch {
    const ACTIVE: bool = true;
    fn input<B: Beat>(&mut self, unit: Unit, beat: &B) {
        // What goes into blending is watched in every run.
        if !self.keep_inputs && unit != Unit::Blend {
            return;
        }
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
    first_beat: u64,
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
    fn walk(&mut self, walk: &Walk, planes: &Planes) {
        self.ports.push("walk", walk);
        self.ports.push("planes", planes);
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

/// A recorder that a primary pipeline, or anything else, feeds.
pub struct Tape(Recorder);

impl Tape {
    /// A tape for a job's system; the job's polygons are not drawn by this. The beats that units
    /// take are recorded only if asked for: they are many.
    pub fn new(job: &Job, minimal: bool, keep_inputs: bool) -> Tape {
        let formats =
            if minimal { Formats::minimal(&job.config) } else { Formats::new(&job.config) };
        let (inputs, outputs) = (BTreeMap::new(), BTreeMap::new());
        Tape(Recorder {
            system: System::new(job, minimal),
            ports: Ports { streams: empty_streams(&formats), frames: job.frames(minimal) },
            watch: Watch { formats, keep_inputs, outputs, inputs },
            records: Default::default(),
            polygons: Vec::new(),
            first_beat: 0,
            beats: 0,
        })
    }

    /// The tape as a sink of the primary pipeline.
    pub fn sink(&mut self) -> &mut impl Sink {
        &mut self.0
    }

    /// Beats recorded since the last [`Tape::take`].
    pub fn len(&self) -> usize {
        self.0.ports.streams["beat"].len()
    }

    /// True if no beat was recorded since the last [`Tape::take`].
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The frames that the system has drawn so far.
    pub fn frames(&self) -> &Frames {
        &self.0.ports.frames
    }

    /// The recording since the last call; the system goes on as it is.
    pub fn take(&mut self) -> Recording {
        let formats = self.0.watch.formats;
        let clear = |tables: &mut BTreeMap<Unit, Table>| {
            let empty = tables.iter().map(|(&unit, table)| (unit, table.emptied())).collect();
            std::mem::replace(tables, empty)
        };
        Recording {
            streams: std::mem::replace(&mut self.0.ports.streams, empty_streams(&formats)),
            outputs: clear(&mut self.0.watch.outputs),
            inputs: clear(&mut self.0.watch.inputs),
            polygons: std::mem::take(&mut self.0.polygons),
            first_beat: std::mem::replace(&mut self.0.first_beat, self.0.beats),
            error: self.0.system.error(),
        }
    }
}

fn empty_streams(f: &Formats) -> BTreeMap<&'static str, Table> {
    BTreeMap::from([
        ("walk", Table::of::<Walk>(f)),
        ("planes", Table::of::<Planes>(f)),
        ("setup", Table::of::<Setup>(f)),
        ("edges", Table::of::<Edges>(f)),
        ("beat", Table::of::<PrimaryBeat>(f)),
        ("request", Table::of::<Request>(f)),
        ("response", Table::of::<Response>(f)),
        ("left", Table::of::<Pixel>(f)),
        ("right", Table::of::<Pixel>(f)),
    ])
}

impl Recording {
    /// Draws a job with a system and records all of it.
    pub fn of(job: &Job, minimal: bool) -> Recording {
        let mut tape = Tape::new(job, minimal, true);
        job.run(minimal, tape.sink());
        tape.take()
    }
}
