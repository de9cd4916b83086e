//! Primary pipeline in hardware: traversal, coverage, colour and depth, display placement.

use super::coverage::{coverage, CoverageEdges};
use super::display::{display, DisplayPoint};
use super::edge_interpolator::{ColourBeat, DepthBeat, EdgeInterpolator};
use super::traversal::{traverse, Visit};
use super::{Planes, PrimaryBeat, Walk};
use crate::config::Config;
use crate::formats::*;

/// State of the primary pipeline.
#[derive(Clone, Debug)]
pub struct Primary {
    formats: Formats,
    width: u32,
    depth: EdgeInterpolator<DepthBeat>,
    colours: [EdgeInterpolator<ColourBeat>; 4],
}

impl Primary {
    /// A primary pipeline for views of this width.
    pub fn new(config: &Config, width: u32) -> Primary {
        let formats = Formats::new(config);
        Primary {
            formats,
            width,
            depth: EdgeInterpolator::new(formats, false),
            colours: [(); 4].map(|()| EdgeInterpolator::new(formats, false)),
        }
    }

    /// Sends the beats of a part.
    pub fn part(&mut self, walk: &Walk, planes: &Planes, mut beat: impl FnMut(&PrimaryBeat)) {
        let formats = self.formats;
        traverse(walk, &formats, |visit| beat(&self.beat(visit, planes)));
    }

    /// The beat of a visited pixel; a `LOAD` takes the planes.
    pub fn beat(&mut self, visit: &Visit, planes: &Planes) -> PrimaryBeat {
        let f = &self.formats;
        let edges = CoverageEdges {
            value0: visit.value0,
            a0: visit.a0,
            b0: visit.b0,
            low0: visit.low0,
            value1: visit.value1,
            a1: visit.a1,
            b1: visit.b1,
            low1: visit.low1,
            value2: visit.value2,
            a2: visit.a2,
            b2: visit.b2,
            low2: visit.low2,
        };
        let covered = coverage(&edges, f);
        let inside = (0..i64::from(self.width)).contains(&visit.x.raw());
        let point = DisplayPoint { x: visit.x, y: visit.y, swap: visit.swap, mirror: visit.mirror };
        let place = display(&point, self.width, f);
        let (depth, rgba) = self.interpolate(visit, planes);
        let f = &self.formats;
        PrimaryBeat {
            op: visit.op,
            save: visit.save,
            last: visit.last,
            centre: covered.centre,
            mask: if inside { covered.mask } else { Mask::default() },
            x: place.x,
            y: place.y,
            rgba: Rgba(rgba.map(|c| (c.raw() >> FRACTION_BITS).clamp(0, 255) as u8)),
            depth: Depth::new((depth.raw() >> FRACTION_BITS).clamp(0, DEPTH_MAX.into()), f),
        }
    }

    /// Steps the planes.
    fn interpolate(&mut self, visit: &Visit, p: &Planes) -> (DepthPlane, [ColourPlane; 4]) {
        let Visit { op, save, r#move, .. } = *visit;
        let (y_move, low) = (Move::default(), LowBits::default());
        let depth = DepthBeat {
            op,
            save,
            r#move,
            y_move,
            start: p.z_start,
            a: p.z_a,
            b: DepthPlane::default(),
            row: p.z_row,
            low,
        };
        let registers = [
            (p.red_start, p.red_a, p.red_row),
            (p.green_start, p.green_a, p.green_row),
            (p.blue_start, p.blue_a, p.blue_row),
            (p.alpha_start, p.alpha_a, p.alpha_row),
        ];
        let depth = self.depth.step(&depth).value;
        let colours = core::array::from_fn(|n| {
            let (start, a, row) = registers[n];
            let b = ColourPlane::default();
            let beat = ColourBeat { op, save, r#move, y_move, start, a, b, row, low };
            self.colours[n].step(&beat).value
        });
        (depth, colours)
    }
}
