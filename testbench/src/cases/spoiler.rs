//! Bad setups between good polygons.

use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::{Edges, Mode, Op, Planes, PrimaryBeat, Setup, Walk};
use wheatstone_golden::primary::Sink;

/// Passes polygons on, every second one with its setup spoilt, or put just inside what is allowed.
pub(super) struct Spoiler<'a, S> {
    pub sink: &'a mut S,
    pub formats: Formats,
    pub polygon: usize,
    /// Ways of spoiling: the last one is a beat's, the others are a record's.
    pub ways: usize,
}

impl<S> Spoiler<'_, S> {
    /// The number of the way in which the present polygon is treated.
    fn way(&self) -> usize {
        if self.polygon.is_multiple_of(2) {
            self.polygon / 2 % self.ways
        } else {
            12
        }
    }
}

impl<S: Sink> Sink for Spoiler<'_, S> {
    fn polygon(&mut self, id: u32) {
        self.polygon += 1;
        self.sink.polygon(id);
    }
    fn walk(&mut self, walk: &Walk, planes: &Planes) {
        self.sink.walk(walk, planes);
    }
    fn records(&mut self, setup: &Setup, edges: &Edges) {
        let f = &self.formats;
        let first = -(i64::from(f.guard_band) + START_SLACK) << FRACTION_BITS;
        let end = (i64::from(f.max_size) << FRACTION_BITS) - first;
        let step = |step: i64| Setup { x_step: Scale::new(step, f), ..*setup };
        let start = |start: i64| Setup { x_start: SecondaryX::new(start, f), ..*setup };
        let treated = match self.way() {
            0 => Setup { mode: Mode(4 + setup.mode.0), ..*setup },
            1 => step(SCALE_ONE + 1),
            2 => step(SCALE_ONE),
            3 => step(SCALE_MIN - 1),
            4 => step(SCALE_MIN),
            5 => start(first - 1),
            6 => start(first),
            7 => start(end),
            8 => start(end - 1),
            9 => Setup { lend: true, ..*setup },
            _ => *setup,
        };
        let empty = Edges {
            e0_a: Slope::default(),
            e1_a: Slope::default(),
            e2_a: Slope::default(),
            ..*edges
        };
        let edges = if self.way() == 10 { &empty } else { edges };
        self.sink.records(&treated, edges);
    }
    fn beat(&mut self, beat: &PrimaryBeat) {
        let illegal = self.way() == 11 && beat.op == Op::Row;
        let op = if illegal { Op::Reserved } else { beat.op };
        self.sink.beat(&PrimaryBeat { op, ..*beat });
    }
}
