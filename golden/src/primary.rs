//! Primary pipeline: visits the pixels of a polygon and sends the beats that a secondary
//! pipeline lives on.

use crate::direct::{depth_at, Direct, Shade};
use crate::formats::*;
use crate::pipeline::{Edges, Mode, Op, PrimaryBeat, Setup};
use crate::setup::*;
use crate::texture::{Lookup, Texture};
use std::collections::BTreeMap;

/// What receives the streams of the primary pipeline.
pub trait Sink {
    /// A polygon begins; its pixels have this id.
    fn polygon(&mut self, id: u32);
    /// The records that the next `LOAD` beat takes.
    fn records(&mut self, setup: &Setup, edges: &Edges);
    /// The next beat.
    fn beat(&mut self, beat: &PrimaryBeat);
}

/// How the polygons of a scene were drawn.
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
    /// How polygons are drawn.
    pub planner: Planner,
    /// Statistics so far.
    pub counts: Counts,
    direct: Direct<'a>,
}

/// Who tests the samples of a beat.
struct Traversal<'a> {
    polygon: &'a Polygon,
    attributes: &'a Attributes,
    /// Edges that the primary tests itself.
    edges: &'a [Edge],
    placement: Placement,
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
        let f = self.planner.formats;
        let attributes = Attributes::new(polygon, derived.primary, &f);
        let secondary = Attributes::new(polygon, derived.primary.other(), &f);
        let registers = Registers::derived(derived, &secondary);
        let traversal = Traversal {
            polygon,
            attributes: &attributes,
            edges: derived.primary_view.edges(),
            placement: Placement::new(&self.planner, derived.primary),
        };
        sink.polygon(polygon.id);
        self.counts.derived_beats += self.traverse(&traversal, &derived.rows, &registers, sink);
    }

    fn monocular(&mut self, polygon: &Polygon, eye: Eye, sink: &mut impl Sink) {
        let f = self.planner.formats;
        let outline = Outline::new(polygon, eye);
        let view = View::new(&outline, &f);
        let attributes = Attributes::new(polygon, eye, &f);
        let lends = view.edges().len() > 3 && !self.planner.options.minimal;
        let (own, lent) = view.edges().split_at(if lends { 3 } else { view.edges().len() });
        let traversal = Traversal {
            polygon,
            attributes: &attributes,
            edges: own,
            placement: Placement::new(&self.planner, eye),
        };
        sink.polygon(polygon.id);
        self.counts.monocular_beats += if lends {
            let registers = Registers::lent(eye, lent, &f);
            let right = i64::from(self.planner.width) - 1;
            let rows = view.extended_rows(self.planner.height, 0, |_| [0, right]);
            self.traverse(&traversal, &rows, &registers, sink)
        } else {
            let [width, height] = [self.planner.width, self.planner.height];
            self.cover(&traversal, view.monocular_rows(width, height), eye, sink)
        };
    }

    /// Visits rows part by part, with the ops that the secondary state needs.
    fn traverse(
        &mut self,
        traversal: &Traversal,
        rows: &[Row],
        registers: &Registers,
        sink: &mut impl Sink,
    ) -> u64 {
        let formats = self.planner.formats;
        let mut beats = 0;
        let end = rows.last().map(|r| (r.last, r.y));
        for part in parts(rows, |movement| registers.allows(movement, &formats)) {
            let (setup, edges) = registers.records(&part, &self.planner);
            sink.records(&setup, &edges);
            self.counts.records += 1;
            let mut start = part.rows[0].first;
            for (n, row) in part.rows.iter().enumerate() {
                // The row start moves by the part's movement; the rest is crept, and saved anew.
                start = if n == 0 { start } else { start + part.movement as i32 };
                for x in start..=row.last {
                    let op = match (x == start, n) {
                        (true, 0) => Op::Load,
                        (true, _) => Op::Row,
                        _ => Op::Step,
                    };
                    let last = end == Some((x, row.y));
                    let save = x <= row.first;
                    sink.beat(&self.beat(traversal, x.into(), row.y.into(), op, save, last));
                    beats += 1;
                }
                start = row.first;
            }
        }
        beats
    }

    /// Sends the beats of a polygon that no secondary follows.
    fn cover(
        &mut self,
        traversal: &Traversal,
        rows: impl Iterator<Item = Row>,
        eye: Eye,
        sink: &mut impl Sink,
    ) -> u64 {
        let setup = Setup { mode: Mode::monocular(eye), ..Setup::default() };
        let mut waiting: Option<PrimaryBeat> = None;
        let mut beats = 0;
        for row in rows {
            for x in row.first..=row.last {
                let op = match waiting {
                    None => {
                        sink.records(&setup, &Edges::default());
                        self.counts.records += 1;
                        Op::Load
                    }
                    Some(_) if x == row.first => Op::Row,
                    Some(_) => Op::Step,
                };
                // Nothing is derived, but the row start is what it is.
                let save = x == row.first;
                let beat = self.beat(traversal, x.into(), row.y.into(), op, save, false);
                if let Some(before) = waiting.replace(beat) {
                    sink.beat(&before);
                }
                beats += 1;
            }
        }
        if let Some(beat) = waiting {
            sink.beat(&PrimaryBeat { last: true, ..beat });
        }
        beats
    }

    fn beat(
        &self,
        traversal: &Traversal,
        x: i64,
        y: i64,
        op: Op,
        save: bool,
        last: bool,
    ) -> PrimaryBeat {
        let f = &self.planner.formats;
        let values = traversal.edges.iter().map(|e| (e, e.value().at(x, y)));
        let centre = values.clone().all(|(_, value)| value >= 0);
        let inside = (0..i64::from(self.planner.width)).contains(&x);
        let mask = match (inside, f.mask_bits) {
            (false, _) => 0,
            (true, 1) => centre.into(),
            (true, _) => values.fold(0xffff, |mask, (e, value)| mask & samples(e, value, f)),
        };
        let shade = Shade {
            attributes: traversal.attributes,
            polygon: traversal.polygon,
            direct: &self.direct,
        };
        let [column, line] = traversal.placement.place(x, y);
        PrimaryBeat {
            op,
            save,
            last,
            centre,
            mask: Mask::new(mask, f),
            x: Coordinate::wrap(column, f),
            y: Coordinate::wrap(line, f),
            rgba: shade.colour(x, y),
            depth: Depth::new(depth_at(&traversal.attributes.depth, x, y).into(), f),
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
