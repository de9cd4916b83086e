//! Register values: the records of the `setup` and `edges` streams.

use super::edge::Edge;
use super::linear::Linear;
use super::mapping::Map;
use super::plan::{Arrangement, Attributes, Derived, Planner};
use super::span::Part;
use crate::formats::*;
use crate::pipeline::{Edges, Mode, Setup};

/// Registers common to all parts of a derived polygon, or of one that borrows the edges.
#[derive(Clone, Debug)]
pub struct Registers {
    setup: Setup,
    edges: [Edge; 3],
    map: Map,
    depth: Linear,
    colour: [Linear; 3],
    secondary: Eye,
}

impl Registers {
    /// Registers of a derived polygon; `attributes` are the secondary eye's.
    pub fn derived(derived: &Derived, attributes: &Attributes) -> Registers {
        let setup = Setup {
            mode: Mode::binocular(derived.primary),
            average: derived.average,
            planes: derived.planes,
            ..Setup::default()
        };
        let mut edges = [Edge::default(); 3];
        edges.copy_from_slice(derived.secondary_view.edges());
        let [red, green, blue, _] = attributes.colour;
        Registers {
            setup,
            edges,
            map: derived.map,
            depth: attributes.depth,
            colour: [red, green, blue],
            secondary: derived.primary.other(),
        }
    }

    /// Registers of a polygon drawn for one eye that no secondary follows.
    pub fn idle(eye: Eye, formats: &Formats) -> Registers {
        let lent = Registers::lent(eye, &[], formats);
        Registers { setup: Setup { lend: false, ..lent.setup }, ..lent }
    }

    /// Registers of a polygon drawn for one eye whose edges beyond the third are tested by the
    /// secondary pipeline; missing ones contain everything.
    pub fn lent(eye: Eye, further: &[Edge], formats: &Formats) -> Registers {
        let setup = Setup { mode: Mode::monocular(eye), lend: true, ..Setup::default() };
        let mut edges = [Edge::default(); 3];
        edges[..further.len()].copy_from_slice(further);
        Registers {
            setup,
            edges,
            map: Map::identity(formats),
            depth: Linear::default(),
            colour: [Linear::default(); 3],
            secondary: eye,
        }
    }

    /// The movement's row shear fits its register.
    pub fn allows(&self, movement: i64, formats: &Formats) -> bool {
        let idle = !self.setup.lend && !self.setup.mode.is_binocular();
        idle || self.map.allows(movement, formats)
    }

    /// The records of a part.
    pub fn records(&self, part: &Part, planner: &Planner) -> (Setup, Edges) {
        if !self.setup.lend && !self.setup.mode.is_binocular() {
            return (self.setup, Edges::default());
        }
        let f = &planner.formats;
        let (i, j) = (i64::from(part.rows[0].first), i64::from(part.rows[0].y));
        let [x, y] = [self.map.x_at(i, j), self.map.y_at(i, j)];
        let [x_row, y_row] = [self.map.row_shear(part.movement), self.map.row_rise(part.movement)];
        let tilted = planner.config.tilt;
        let (column, line) = (x >> FRACTION_BITS, if tilted { y >> FRACTION_BITS } else { j });
        let down = if tilted { y_row >> FRACTION_BITS } else { 1 };
        let placement = Placement::new(planner, self.secondary);
        let setup = Setup {
            x_start: SecondaryX::wrap(x, f),
            x_step: Scale::new(self.map.scale(), f),
            // A part of one row never uses its row registers, whatever fits them.
            x_row: SecondaryX::wrap(x_row, f),
            y_start: Coordinate::wrap(placement.line(if tilted { 0 } else { j }), f),
            y_step: DisplayStep::new(placement.step, f),
            swap: placement.swap,
            mirror: placement.mirror,
            y_view: SecondaryX::wrap(if tilted { y } else { 0 }, f),
            y_slant: Slant::wrap(if tilted { self.map.slant() } else { 0 }, f),
            y_row: SecondaryX::wrap(if tilted { y_row } else { 0 }, f),
            ..self.setup
        };
        let across = x_row >> FRACTION_BITS;
        let start = |l: &Linear| l.at(column, line);
        let row = |l: &Linear| l.b.wrapping_mul(down).wrapping_add(l.a.wrapping_mul(across));
        let [e0, e1, e2] = self.edges.map(|e| EdgeRegisters::new(&e, &start, &row, f));
        let z = &self.depth;
        let [red, green, blue] = &self.colour;
        let edges = Edges {
            e0_start: e0.start,
            e0_a: e0.a,
            e0_b: e0.b,
            e0_row: e0.row,
            e0_low: e0.low,
            e1_start: e1.start,
            e1_a: e1.a,
            e1_b: e1.b,
            e1_row: e1.row,
            e1_low: e1.low,
            e2_start: e2.start,
            e2_a: e2.a,
            e2_b: e2.b,
            e2_row: e2.row,
            e2_low: e2.low,
            z_start: DepthPlane::wrap(start(z), f),
            z_a: DepthPlane::wrap(z.a, f),
            z_b: DepthPlane::wrap(z.b, f),
            z_row: DepthPlane::wrap(row(z), f),
            red_start: ColourPlane::wrap(start(red), f),
            red_a: ColourPlane::wrap(red.a, f),
            red_b: ColourPlane::wrap(red.b, f),
            red_row: ColourPlane::wrap(row(red), f),
            green_start: ColourPlane::wrap(start(green), f),
            green_a: ColourPlane::wrap(green.a, f),
            green_b: ColourPlane::wrap(green.b, f),
            green_row: ColourPlane::wrap(row(green), f),
            blue_start: ColourPlane::wrap(start(blue), f),
            blue_a: ColourPlane::wrap(blue.a, f),
            blue_b: ColourPlane::wrap(blue.b, f),
            blue_row: ColourPlane::wrap(row(blue), f),
        };
        (setup, edges)
    }
}

/// The five registers of one edge.
struct EdgeRegisters {
    start: EdgeValue,
    a: Slope,
    b: Slope,
    row: EdgeValue,
    low: LowBits,
}

impl EdgeRegisters {
    fn new(
        edge: &Edge,
        start: &dyn Fn(&Linear) -> i64,
        row: &dyn Fn(&Linear) -> i64,
        f: &Formats,
    ) -> EdgeRegisters {
        let value = edge.value();
        EdgeRegisters {
            start: EdgeValue::wrap(start(&value), f),
            a: Slope::new(edge.a, f),
            b: Slope::new(edge.b, f),
            row: EdgeValue::wrap(row(&value), f),
            low: LowBits::new(edge.low(f), f),
        }
    }
}

/// Map from a view's pixels to the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    base: i64,
    pub(super) step: i64,
    /// Exchange x and y.
    pub swap: bool,
    /// Count x from the right.
    pub mirror: bool,
    width: i64,
}

impl Placement {
    /// Placement of an eye's view.
    pub fn new(planner: &Planner, eye: Eye) -> Placement {
        let [width, height] = [planner.width, planner.height].map(i64::from);
        let right = eye == Eye::Right;
        let normal = Placement { base: 0, step: 1, swap: false, mirror: false, width };
        match planner.options.arrangement {
            Arrangement::Normal => normal,
            Arrangement::Flipped => Placement { base: height - 1, step: -1, ..normal },
            Arrangement::Interleaved => Placement { base: right.into(), step: 2, ..normal },
            Arrangement::AboveBelow => Placement { base: if right { height } else { 0 }, ..normal },
            Arrangement::Rotated if right => Placement { swap: true, mirror: true, ..normal },
            Arrangement::Rotated => Placement { base: height - 1, step: -1, swap: true, ..normal },
        }
    }

    /// Display row (before an exchange) of a view row.
    pub fn line(&self, y: i64) -> i64 {
        self.base + self.step * y
    }

    /// Display position of a view pixel.
    pub fn place(&self, x: i64, y: i64) -> [i64; 2] {
        let x = if self.mirror { self.width - 1 - x } else { x };
        let line = self.line(y);
        if self.swap {
            [line, x]
        } else {
            [x, line]
        }
    }

    /// Columns and rows of the display memory that a view needs.
    pub fn display_size(planner: &Planner) -> [u32; 2] {
        let [width, height] = [planner.width, planner.height];
        match planner.options.arrangement {
            Arrangement::Normal | Arrangement::Flipped => [width, height],
            Arrangement::Interleaved | Arrangement::AboveBelow => [width, 2 * height],
            Arrangement::Rotated => [height, width],
        }
    }
}
