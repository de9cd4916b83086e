//! Traversal of the primary pipeline: scan lines from left to right, their ends found by the edge
//! functions themselves.
//!
//! An edge function with its bound subtracted is negative on the pixels at the end of a row's span and
//! beyond. So its sign says whether the row begins here (a left edge) or ends here (a right edge).

use super::{Op, Walk};
use crate::beat;
use crate::formats::*;

beat! {
    /// A visited pixel, with the edge functions there: stream `visit`.
    pub struct Visit {
        /// what the pixel is to the secondary state
        op: Op,
        /// the state after this pixel becomes the row start
        save: bool,
        /// last pixel of the polygon
        last: bool,
        /// one pixel to the right of the pixel before (STEP), or of the least movement (ROW)
        r#move: bool,
        /// primary x in its view
        x: PixelX,
        /// display row before an exchange
        y: Coordinate,
        /// exchange x and y on the display
        swap: bool,
        /// count display x from the right
        mirror: bool,
        /// edge 0
        value0: EdgeValue,
        /// edge 0, one pixel to the right
        a0: Slope,
        /// edge 0, one pixel down (ANTIALIAS)
        b0: Slope,
        /// edge 0, dropped bits (ANTIALIAS)
        low0: LowBits,
        /// edge 1
        value1: EdgeValue,
        /// edge 1, one pixel to the right
        a1: Slope,
        /// edge 1, one pixel down (ANTIALIAS)
        b1: Slope,
        /// edge 1, dropped bits (ANTIALIAS)
        low1: LowBits,
        /// edge 2
        value2: EdgeValue,
        /// edge 2, one pixel to the right
        a2: Slope,
        /// edge 2, one pixel down (ANTIALIAS)
        b2: Slope,
        /// edge 2, dropped bits (ANTIALIAS)
        low2: LowBits,
    }
}

/// An edge function with its bound subtracted.
#[derive(Clone, Copy, Debug)]
struct SpanEdge {
    inner: i64,
    saved: i64,
    a: i64,
    row: i64,
    bound: i64,
    bits: u32,
}

impl SpanEdge {
    fn new(start: EdgeValue, a: Slope, row: EdgeValue, bound: Bound, f: &Formats) -> SpanEdge {
        let [inner, a, row, bound] = [start.raw(), a.raw(), row.raw(), bound.raw()];
        SpanEdge { inner, saved: inner, a, row, bound, bits: EdgeValue::bits(f) }
    }

    /// The row does not begin right of here.
    fn is_before(&self, inner: i64) -> bool {
        self.a > 0 && inner < 0
    }

    /// The row does not go on.
    fn is_beyond(&self) -> bool {
        self.a < 0 && self.inner < 0
    }

    fn step(&mut self) {
        self.inner = reduce(self.inner + self.a, self.bits, true);
    }

    /// One pixel right of the least movement of the row start.
    fn ahead(&self) -> i64 {
        reduce(self.saved + self.row, self.bits, true)
    }

    fn down(&mut self, moved: bool) {
        let back = if moved { 0 } else { self.a };
        self.inner = reduce(self.ahead() - back, self.bits, true);
    }

    fn value(&self, f: &Formats) -> EdgeValue {
        EdgeValue::wrap(self.inner + self.bound, f)
    }
}

/// Visits the pixels of a part.
pub fn traverse(walk: &Walk, f: &Formats, mut visit: impl FnMut(&Visit)) {
    let w = walk;
    let mut edges = [
        SpanEdge::new(w.e0_start, w.e0_a, w.e0_row, w.e0_bound, f),
        SpanEdge::new(w.e1_start, w.e1_a, w.e1_row, w.e1_bound, f),
        SpanEdge::new(w.e2_start, w.e2_a, w.e2_row, w.e2_bound, f),
    ];
    let column = |x: i64| PixelX::wrap(x, f);
    let (mut x, mut saved, mut y) = (w.x, w.x, w.y);
    let (mut op, mut moved) = (Op::Load, false);
    for row in 0..=w.rows.raw() {
        loop {
            let before = x <= w.left || edges.iter().any(|e| e.is_before(e.inner));
            let save = op == Op::Load || before;
            let end = x >= w.right || edges.iter().any(SpanEdge::is_beyond);
            let last = w.last && end && row == w.rows.raw();
            let [e0, e1, e2] = edges.map(|e| e.value(f));
            visit(&Visit {
                op,
                save,
                last,
                r#move: moved,
                x,
                y,
                swap: w.swap,
                mirror: w.mirror,
                value0: e0,
                a0: w.e0_a,
                b0: w.e0_b,
                low0: w.e0_low,
                value1: e1,
                a1: w.e1_a,
                b1: w.e1_b,
                low1: w.e1_low,
                value2: e2,
                a2: w.e2_a,
                b2: w.e2_b,
                low2: w.e2_low,
            });
            if save {
                saved = x;
                edges.iter_mut().for_each(|e| e.saved = e.inner);
            }
            if end {
                break;
            }
            (op, moved, x) = (Op::Step, true, column(x.raw() + 1));
            edges.iter_mut().for_each(SpanEdge::step);
        }
        let least = column(saved.raw() + w.x_row.raw());
        let before = least < w.left || edges.iter().any(|e| e.is_before(e.ahead()));
        (op, moved) = (Op::Row, before && !w.creep);
        x = column(least.raw() + i64::from(moved));
        y = Coordinate::wrap(y.raw() + w.y_step.raw(), f);
        edges.iter_mut().for_each(|e| e.down(moved));
    }
}
