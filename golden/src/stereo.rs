//! Rendering a scene's polygons by one of the three methods.

use crate::config::Config;
use crate::direct::Direct;
use crate::formats::{Eye, Formats};
use crate::frame::{Frame, Frames, Scissor};
use crate::pipeline::hybrid::Hybrid;
use crate::pipeline::minimal::Minimal;
use crate::pipeline::observer::{Blind, Observer};
use crate::pipeline::{Edges, Output, PrimaryBeat, Setup};
use crate::primary::{Counts, Primary, Sink};
use crate::progress::over;
use crate::scene::Geometry;
use crate::setup::{Options, Outline, Planner, Polygon};
use crate::texture::{Lookup, Texture};
use crate::work::{Meter, Unmetered};
use std::borrow::Cow;

/// Method of making the second view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Each view rasterised for itself.
    Direct,
    /// By the minimal system.
    Minimal,
    /// By the hybrid system.
    Hybrid,
}

/// Polygons and what they are drawn on.
#[derive(Clone, Debug)]
pub struct Job<'a> {
    /// Build parameters.
    pub config: Config,
    /// Choices of setup.
    pub options: Options,
    /// Columns of each view.
    pub width: u32,
    /// Rows of each view.
    pub height: u32,
    /// Colour of an empty frame.
    pub background: [u8; 3],
    /// Columns of each view that are drawn.
    pub scissor: Scissor,
    /// The polygons, in drawing order.
    pub polygons: &'a [Polygon],
    /// Textures of the polygons.
    pub textures: &'a [Texture],
    /// Method of texture sampling.
    pub lookup: Lookup,
}

impl<'a> Job<'a> {
    /// The job that draws a scene's polygons.
    pub fn of(geometry: &'a Geometry, config: Config, options: Options, lookup: Lookup) -> Job<'a> {
        Job {
            config,
            options,
            width: geometry.width,
            height: geometry.height,
            background: geometry.background.rgb(),
            scissor: geometry.scissor,
            polygons: &geometry.polygons,
            textures: &geometry.textures,
            lookup,
        }
    }
}

impl Job<'_> {
    /// The same job without textures, for hardware that has none: polygons have their lit colour.
    pub fn untextured(&self) -> Job<'_> {
        Job { textures: &[], ..self.clone() }
    }

    /// The planner for this job and a system.
    pub fn planner(&self, minimal: bool) -> Planner {
        Planner::new(self.config, Options { minimal, ..self.options }, self.width, self.height)
    }

    /// Cleared frames for this job and a system.
    pub fn frames(&self, minimal: bool) -> Frames {
        let planner = self.planner(minimal);
        let tested = !minimal && !self.config.external_depth;
        Frames::new(&planner, self.background, tested, &self.scissor)
    }

    /// Draws both views directly, in view coordinates.
    pub fn direct(&self) -> [Frame; 2] {
        Eye::BOTH.map(|eye| self.view(eye, &mut Unmetered))
    }

    /// Draws one view directly, in view coordinates.
    pub fn view(&self, eye: Eye, meter: &mut impl Meter) -> Frame {
        let direct = Direct {
            formats: Formats::new(&self.config),
            textures: self.textures,
            lookup: self.lookup,
        };
        let mut frame = Frame::new(self.width, self.height, self.background);
        let what = match eye {
            Eye::Left => "drawing the left view directly",
            Eye::Right => "drawing the right view directly",
        };
        self.pieces(what).for_each(|polygon| direct.draw_metered(&polygon, eye, &mut frame, meter));
        if self.scissor != Scissor::default() {
            // Pixels do not depend on each other: clearing these is dropping all that came there.
            frame.clear_columns(|x| !self.scissor.contains(eye, x), self.background);
        }
        frame
    }

    /// Sends the job's polygons through a primary pipeline into a sink.
    pub fn run(&self, minimal: bool, sink: &mut impl Sink) -> Counts {
        let mut primary = Primary::new(self.planner(minimal), self.textures, self.lookup);
        let what = if minimal { "running the minimal system" } else { "running the hybrid" };
        self.pieces(what).for_each(|polygon| primary.draw(&polygon, sink));
        primary.counts
    }

    /// Statistics of the polygons as they would be drawn, without drawing them: no beats are
    /// counted.
    pub fn planned(&self, minimal: bool) -> Counts {
        let planner = self.planner(minimal);
        let mut counts = Counts::default();
        self.pieces("planning").for_each(|polygon| counts.note(&planner.plan(&polygon)));
        counts
    }

    /// The polygons as they are drawn: one with more than three corners that snapping has made concave
    /// in either view is given in triangles. It is noted how many of them are done; `what` is done with them.
    pub fn pieces(&self, what: &str) -> impl Iterator<Item = Cow<'_, Polygon>> {
        over(what, "polygons", self.polygons).flat_map(in_pieces)
    }

    /// Draws both views by a system.
    pub fn derived(&self, minimal: bool) -> (Frames, Counts) {
        let mut frames = self.frames(minimal);
        let system = System::new(self, minimal);
        let mut sink = SystemSink {
            system,
            output: &mut frames,
            observer: Blind,
            records: Default::default(),
        };
        let counts = self.run(minimal, &mut sink);
        (frames, counts)
    }
}

/// The polygons as they are drawn: one with more than three corners that snapping has made concave
/// in either view is given in triangles.
pub fn pieces(polygons: &[Polygon]) -> impl Iterator<Item = Cow<'_, Polygon>> {
    polygons.iter().flat_map(in_pieces)
}

fn in_pieces(polygon: &Polygon) -> Vec<Cow<'_, Polygon>> {
    let corners = polygon.vertices.len();
    let convex = || Eye::BOTH.iter().all(|&eye| Outline::new(polygon, eye).is_convex());
    if corners <= 3 || convex() {
        return vec![Cow::Borrowed(polygon)];
    }
    polygon.fan().map(Cow::Owned).collect()
}

/// Either system, with one way to feed it.
#[derive(Clone, Debug)]
pub enum System {
    /// Coordinate interpolation and sampling only.
    Minimal(Box<Minimal>),
    /// All units.
    Hybrid(Box<Hybrid>),
}

impl System {
    /// A system for a job.
    pub fn new(job: &Job, minimal: bool) -> System {
        let (config, single) = (&job.config, job.options.single);
        if minimal {
            System::Minimal(Box::new(Minimal::new(config, job.width, job.height, single)))
        } else {
            System::Hybrid(Box::new(Hybrid::new(config, job.width, job.height, single)))
        }
    }

    /// True if a polygon or a beat was refused.
    pub fn error(&self) -> bool {
        match self {
            System::Minimal(minimal) => minimal.error(),
            System::Hybrid(hybrid) => hybrid.error(),
        }
    }

    /// Takes a beat.
    #[inline]
    pub fn beat(
        &mut self,
        beat: &PrimaryBeat,
        records: &(Setup, Edges),
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) {
        match self {
            System::Minimal(minimal) => minimal.beat(beat, &records.0, output, observer),
            System::Hybrid(hybrid) => hybrid.beat(beat, records, output, observer),
        }
    }
}

/// Feeds a system and draws what comes out.
struct SystemSink<'a, O> {
    system: System,
    output: &'a mut Frames,
    observer: O,
    records: (Setup, Edges),
}

impl<O: Observer> Sink for SystemSink<'_, O> {
    fn polygon(&mut self, id: u32) {
        self.output.id = id;
    }
    fn records(&mut self, setup: &Setup, edges: &Edges) {
        self.records = (*setup, *edges);
    }
    #[inline]
    fn beat(&mut self, beat: &PrimaryBeat) {
        self.system.beat(beat, &self.records, self.output, &mut self.observer);
    }
}
