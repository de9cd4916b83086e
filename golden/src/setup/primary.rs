//! Register values of the primary pipeline: the records of the `walk` and `planes` streams.

use super::edge::Edge;
use super::linear::Linear;
use super::plan::{Attributes, Planner};
use super::record::Placement;
use super::span::{parts, Part, Row, Spans, View};
use crate::formats::*;
use crate::pipeline::{Planes, Walk};

/// Registers common to all parts of a polygon in the view that the primary pipeline draws.
#[derive(Clone, Debug)]
pub struct PrimaryRegisters {
    /// The polygon in that view.
    pub view: View,
    /// Which pixels are visited.
    pub spans: Spans,
    /// Map from the pixels to the display.
    pub placement: Placement,
    attributes: Attributes,
    steep: bool,
}

impl PrimaryRegisters {
    /// Registers of a polygon as an eye sees it.
    pub fn new(
        planner: &Planner,
        eye: Eye,
        view: View,
        spans: Spans,
        attributes: &Attributes,
    ) -> PrimaryRegisters {
        // Pixels whose centre is outside are seen with anti-aliasing alone. Derived polygons that are
        // steep are not drawn as such.
        let steep = planner.formats.mask_bits > 1 && attributes.exceeds(1, true, true);
        let placement = Placement::new(planner, eye);
        PrimaryRegisters { view, spans, placement, attributes: *attributes, steep }
    }

    /// Cuts rows into parts; `allowed` says whether a movement fits the secondary's registers. A
    /// polygon so steep that its colour or depth would leave a register beside it is sent pixel by
    /// pixel, each a part.
    pub fn parts(&self, rows: &[Row], allowed: impl Fn(i64) -> bool, mut each: impl FnMut(&Part)) {
        if !self.steep {
            return parts(rows, allowed).for_each(|part| each(&part));
        }
        for row in rows {
            for x in row.first..=row.last {
                each(&Part { rows: &[Row { first: x, last: x, ..*row }], movement: 0 });
            }
        }
    }

    /// The records of a part that three of the edges bound; `last`: no part follows.
    pub fn records(
        &self,
        part: &Part,
        own: [Edge; 3],
        last: bool,
        formats: &Formats,
    ) -> (Walk, Planes) {
        let first = part.rows[0];
        let at = [first.first, first.y].map(i64::from);
        let [left, right] = if self.steep { [at[0]; 2] } else { self.spans.limits };
        let [e0, e1, e2] = own.map(|e| EdgeRegisters::new(&e, &self.spans, at, part, formats));
        let column = |x| PixelX::wrap(x, formats);
        let walk = Walk {
            last,
            creep: self.spans.creep,
            rows: Coordinate::new(part.rows.len() as i64 - 1, formats),
            x: column(at[0]),
            x_row: column(part.movement),
            left: column(left),
            right: column(right),
            y: Coordinate::wrap(self.placement.line(at[1]), formats),
            y_step: DisplayStep::new(self.placement.step, formats),
            swap: self.placement.swap,
            mirror: self.placement.mirror,
            e0_start: e0.start,
            e0_a: e0.a,
            e0_b: e0.b,
            e0_row: e0.row,
            e0_low: e0.low,
            e0_bound: e0.bound,
            e1_start: e1.start,
            e1_a: e1.a,
            e1_b: e1.b,
            e1_row: e1.row,
            e1_low: e1.low,
            e1_bound: e1.bound,
            e2_start: e2.start,
            e2_a: e2.a,
            e2_b: e2.b,
            e2_row: e2.row,
            e2_low: e2.low,
            e2_bound: e2.bound,
        };
        (walk, self.planes(at, part.movement, formats))
    }

    fn planes(&self, [x, y]: [i64; 2], movement: i64, formats: &Formats) -> Planes {
        let plane = |linear: &Linear, largest: i64| {
            if self.steep {
                let value = (linear.at(x, y) >> FRACTION_BITS).clamp(0, largest);
                return [value << FRACTION_BITS, 0, 0];
            }
            let row = linear.a.wrapping_mul(movement).wrapping_add(linear.b);
            [linear.at(x, y), linear.a, row]
        };
        let depth = plane(&self.attributes.depth, DEPTH_MAX.into());
        let [z_start, z_a, z_row] = depth.map(|n| DepthPlane::wrap(n, formats));
        let colours = self.attributes.colour;
        let [red, green, blue, alpha] =
            colours.map(|c| plane(&c, 255).map(|n| ColourPlane::wrap(n, formats)));
        let [red_start, red_a, red_row] = red;
        let [green_start, green_a, green_row] = green;
        let [blue_start, blue_a, blue_row] = blue;
        let [alpha_start, alpha_a, alpha_row] = alpha;
        Planes {
            z_start,
            z_a,
            z_row,
            red_start,
            red_a,
            red_row,
            green_start,
            green_a,
            green_row,
            blue_start,
            blue_a,
            blue_row,
            alpha_start,
            alpha_a,
            alpha_row,
        }
    }

    /// Depth at a pixel as the register gives it.
    pub fn depth(&self, x: i64, y: i64, formats: &Formats) -> Depth {
        let value = self.attributes.depth.at(x, y);
        let value = if self.steep { value } else { DepthPlane::wrap(value, formats).raw() };
        Depth::new((value >> FRACTION_BITS).clamp(0, DEPTH_MAX.into()), formats)
    }

    /// Colour at a pixel as the registers give it.
    pub fn colour(&self, x: i64, y: i64, formats: &Formats) -> Rgba {
        Rgba(self.attributes.colour.map(|linear| {
            let value = linear.at(x, y);
            let value = if self.steep { value } else { ColourPlane::wrap(value, formats).raw() };
            (value >> FRACTION_BITS).clamp(0, 255) as u8
        }))
    }
}

/// The six registers of one edge.
struct EdgeRegisters {
    start: EdgeValue,
    a: Slope,
    b: Slope,
    row: EdgeValue,
    low: LowBits,
    bound: Bound,
}

impl EdgeRegisters {
    fn new(
        edge: &Edge,
        spans: &Spans,
        [x, y]: [i64; 2],
        part: &Part,
        f: &Formats,
    ) -> EdgeRegisters {
        let bound = spans.bound(edge, f);
        EdgeRegisters {
            start: EdgeValue::wrap(edge.value().at(x, y) - bound, f),
            a: Slope::new(edge.a, f),
            b: Slope::new(edge.b, f),
            row: EdgeValue::wrap(edge.b + edge.a * (part.movement + 1), f),
            low: LowBits::new(edge.low(f), f),
            bound: Bound::new(bound, f),
        }
    }
}
