//! Primary pipeline: visits the pixels of a polygon and sends the beats that a secondary
//! pipeline lives on.

use crate::direct::{Direct, Shade};
use crate::formats::*;
use crate::pipeline::{Edges, Op, Planes, PrimaryBeat, Setup, Walk};
use crate::setup::*;
use crate::texture::{Lookup, Texture};
use std::collections::BTreeMap;

/// Receiver of the streams of the primary pipeline.
pub trait Sink {
    /// A polygon begins; its pixels have this id.
    fn polygon(&mut self, id: u32);
    /// The records that the next `LOAD` beat takes.
    fn records(&mut self, setup: &Setup, edges: &Edges);
    /// The records from which a primary pipeline in hardware makes the beats that follow, up to the
    /// next such call.
    fn walk(&mut self, _walk: &Walk, _planes: &Planes) {}
    /// The next beat.
    fn beat(&mut self, beat: &PrimaryBeat);
}

/// Statistics of the polygons of a scene, by the way in which they were drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Polygons given.
    pub polygons: u64,
    /// Polygons drawn for both eyes in one pass.
    pub derived: u64,
    /// Polygons that cover nothing.
    pub nothing: u64,
    /// Polygons drawn monocular, by reason.
    pub monocular: BTreeMap<Reason, u64>,
    /// Beats of derived polygons.
    pub derived_beats: u64,
    /// Beats of monocular polygons.
    pub monocular_beats: u64,
    /// Records taken by `LOAD` beats.
    pub records: u64,
}

impl Counts {
    /// Counts a polygon by how it is drawn.
    pub fn note(&mut self, plan: &Plan) {
        self.polygons += 1;
        match plan {
            Plan::Nothing => self.nothing += 1,
            Plan::Monocular { reason, .. } => {
                *self.monocular.entry(*reason).or_default() += 1;
            }
            Plan::Derived(_) => self.derived += 1,
        }
    }

    /// All beats.
    pub fn beats(&self) -> u64 {
        self.derived_beats + self.monocular_beats
    }
}

/// The primary pipeline.
#[derive(Clone, Debug)]
pub struct Primary<'a> {
    /// Decides how a polygon is drawn.
    pub planner: Planner,
    /// Statistics so far.
    pub counts: Counts,
    direct: Direct<'a>,
}

/// A polygon in the view that is drawn.
struct Traversal<'a> {
    polygon: &'a Polygon,
    attributes: &'a Attributes,
    registers: PrimaryRegisters,
    secondary: Secondary,
}

/// Task of the secondary pipeline meanwhile.
enum Secondary {
    /// Nothing.
    Idle(Eye),
    /// Derives the other view.
    Derives(Box<Registers>),
    /// Tests the edges that the primary pipeline does not.
    Lends(Eye),
}

impl<'a> Primary<'a> {
    /// A primary pipeline that draws with these textures.
    pub fn new(planner: Planner, textures: &'a [Texture], lookup: Lookup) -> Primary<'a> {
        let direct = Direct { formats: planner.formats, textures, lookup };
        Primary { planner, counts: Counts::default(), direct }
    }

    /// Draws a polygon.
    pub fn draw(&mut self, polygon: &Polygon, sink: &mut impl Sink) {
        let plan = self.planner.plan(polygon);
        self.counts.note(&plan);
        match plan {
            Plan::Nothing => {}
            Plan::Monocular { eyes, .. } => {
                for eye in Eye::BOTH.into_iter().filter(|&eye| eyes[eye as usize]) {
                    self.monocular(polygon, eye, sink);
                }
            }
            Plan::Derived(derived) => self.derived(polygon, &derived, sink),
        }
    }

    fn derived(&mut self, polygon: &Polygon, derived: &Derived, sink: &mut impl Sink) {
        let (f, eye) = (self.planner.formats, derived.primary);
        let attributes = Attributes::new(polygon, eye, &f);
        let own = Attributes::new(polygon, eye.other(), &f);
        let (view, spans) = (derived.primary_view, derived.spans);
        let traversal = Traversal {
            polygon,
            attributes: &attributes,
            registers: PrimaryRegisters::new(&self.planner, eye, view, spans, &attributes),
            secondary: Secondary::Derives(Box::new(Registers::derived(derived, &own))),
        };
        self.counts.derived_beats += self.traverse(&traversal, &derived.rows, sink);
    }

    fn monocular(&mut self, polygon: &Polygon, eye: Eye, sink: &mut impl Sink) {
        let Planner { formats, options, .. } = self.planner;
        let outline = Outline::new(polygon, eye);
        let attributes = Attributes::new(polygon, eye, &formats);
        let lends = outline.points().len() > 3 && !options.minimal;
        // Without anti-aliasing, when samples would see the sides that they share, triangles take fewer
        // beats.
        if !lends || !options.cost_rule || formats.mask_bits > 1 {
            return self.alone(polygon, &outline, &attributes, (eye, lends), sink);
        }
        for triangle in polygon.fan() {
            let outline = Outline::new(&triangle, eye);
            if outline.doubled_area() != 0 {
                self.alone(polygon, &outline, &attributes, (eye, false), sink);
            }
        }
    }

    /// Draws a polygon, or a part of it, for one eye; the secondary pipeline may lend its edges.
    fn alone(
        &mut self,
        polygon: &Polygon,
        outline: &Outline,
        attributes: &Attributes,
        (eye, lends): (Eye, bool),
        sink: &mut impl Sink,
    ) {
        let Planner { formats, width, height, .. } = self.planner;
        let view = View::new(outline, &formats);
        let (spans, secondary) = match lends {
            true => (view.lent_spans(width), Secondary::Lends(eye)),
            false => (view.monocular_spans(width), Secondary::Idle(eye)),
        };
        let rows: Vec<Row> = view.rows(&spans, height).collect();
        let registers = PrimaryRegisters::new(&self.planner, eye, view, spans, attributes);
        let traversal = Traversal { polygon, attributes, registers, secondary };
        self.counts.monocular_beats += self.traverse(&traversal, &rows, sink);
    }

    /// Visits rows run by run.
    fn traverse(&mut self, traversal: &Traversal, rows: &[Row], sink: &mut impl Sink) -> u64 {
        sink.polygon(traversal.polygon.id);
        let f = self.planner.formats;
        let registers = &traversal.registers;
        let edges = registers.view.edges();
        let end = rows.last().map(|row| (row.last, row.y));
        match &traversal.secondary {
            Secondary::Idle(eye) => {
                let registers = Registers::idle(*eye, &f);
                self.run(traversal, rows, edges, &registers, end, sink)
            }
            Secondary::Derives(registers) => self.run(traversal, rows, edges, registers, end, sink),
            Secondary::Lends(eye) => {
                let runs = registers.view.runs(rows, &registers.spans);
                let draw = |Run { rows, own }: Run| {
                    let others = (0..edges.len()).filter(|n| !own.contains(n));
                    let lent: Vec<Edge> = others.map(|n| edges[n]).collect();
                    let own = own.map(|n| edges[n]);
                    let registers = Registers::lent(*eye, &lent, &f);
                    self.run(traversal, rows, &own, &registers, end, sink)
                };
                runs.map(draw).sum()
            }
        }
    }

    /// Visits rows part by part, with the ops that the secondary state needs. `own` are the edges that
    /// the primary pipeline tests, `end` is the polygon's last pixel.
    fn run(
        &mut self,
        traversal: &Traversal,
        rows: &[Row],
        own: &[Edge],
        secondary: &Registers,
        end: Option<(i32, i32)>,
        sink: &mut impl Sink,
    ) -> u64 {
        let formats = self.planner.formats;
        let mut beats = 0;
        let allowed = |movement| secondary.allows(movement, &formats);
        traversal.registers.parts(rows, allowed, |part| {
            let last = part.rows.last().map(|row| (row.last, row.y)) == end;
            // More edges than the pipeline has are tested in the model of the minimal system only.
            if let Ok(own) = own.try_into() {
                let (walk, planes) = traversal.registers.records(part, own, last, &formats);
                sink.walk(&walk, &planes);
            }
            let (setup, edges) = secondary.records(part, &self.planner);
            sink.records(&setup, &edges);
            self.counts.records += 1;
            beats += self.visit(traversal, part, own, last, sink);
        });
        beats
    }

    /// Visits the pixels of a part.
    fn visit(
        &self,
        traversal: &Traversal,
        part: &Part,
        own: &[Edge],
        last: bool,
        sink: &mut impl Sink,
    ) -> u64 {
        let end = part.rows[part.rows.len() - 1];
        let mut start = part.rows[0].first;
        let mut beats = 0;
        for (n, row) in part.rows.iter().enumerate() {
            // The row start moves by the part's movement; the rest is crept, and saved anew.
            start = match n {
                0 => start,
                _ if traversal.registers.spans.creep => start + part.movement as i32,
                _ => row.first,
            };
            for x in start..=row.last {
                let op = match (x == start, n) {
                    (true, 0) => Op::Load,
                    (true, _) => Op::Row,
                    _ => Op::Step,
                };
                let last = last && (x, row.y) == (end.last, end.y);
                let save = x <= row.first;
                let beat = self.beat(traversal, own, [x, row.y].map(i64::from), op);
                sink.beat(&PrimaryBeat { save, last, ..beat });
                beats += 1;
            }
            start = row.first;
        }
        beats
    }

    fn beat(&self, traversal: &Traversal, own: &[Edge], [x, y]: [i64; 2], op: Op) -> PrimaryBeat {
        let f = &self.planner.formats;
        let values = own.iter().map(|e| (e, e.value().at(x, y)));
        let centre = values.clone().all(|(_, value)| value >= 0);
        let inside = (0..i64::from(self.planner.width)).contains(&x);
        let mask = match (inside, f.mask_bits) {
            (false, _) => 0,
            (true, 1) => centre.into(),
            (true, _) => values.fold(0xffff, |mask, (e, value)| mask & samples(e, value, f)),
        };
        let Traversal { polygon, attributes, registers, .. } = traversal;
        let shade = Shade { attributes, polygon, direct: &self.direct };
        let [column, line] = registers.placement.place(x, y);
        PrimaryBeat {
            op,
            centre,
            mask: Mask::new(mask, f),
            x: Coordinate::wrap(column, f),
            y: Coordinate::wrap(line, f),
            rgba: shade.textured(registers.colour(x, y, f), x, y),
            depth: registers.depth(x, y, f),
            ..PrimaryBeat::default()
        }
    }
}

/// Samples of a pixel inside an edge, row by row from the top.
fn samples(edge: &Edge, value: i64, formats: &Formats) -> i64 {
    let eighths = 8 * value + edge.low(formats);
    (0..16).fold(0, |mask, n: i64| {
        let inside = eighths + (2 * (n & 3) - 3) * edge.a + (2 * (n >> 2) - 3) * edge.b >= 0;
        mask | i64::from(inside) << n
    })
}
