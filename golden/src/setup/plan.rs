//! Choice of how a polygon is drawn: derived, monocular, or not at all.

use super::edge::Outline;
use super::linear::{Linear, Plane};
use super::mapping::Map;
use super::polygon::{Eyes, Polygon, Vertex};
use super::span::{beats, Row, Spans, View};
use crate::config::Config;
use crate::formats::{Eye, Formats, Rgba, FRACTION_BITS, GUARD_BITS, WIDENING_LIMIT};
use alloc::boxed::Box;
use alloc::vec::Vec;

/// Beats that deriving a polygon saves at least, by the cost rule: where the eye that is derived
/// changes, the slot queue may have to wait for the polygon before.
const LEAST_SAVING: u64 = 2;

/// Treatment of highlights that the eyes see differently (paper, section 5.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Specular {
    /// The secondary shows the primary's highlight.
    Approximation,
    /// Polygons with a noticeable highlight are drawn monocular.
    Exception,
    /// A second set of colour interpolators; textured polygons as by exception.
    Integrated,
}

/// When the colour of a secondary pixel is the average of its primary pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Textured polygons are averaged, smooth ones sampled.
    Automatic,
    /// Always the nearest primary pixel.
    Nearest,
    /// Always the average.
    Average,
}

/// Arrangement of the two views on the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// Each view on a display of its own.
    Normal,
    /// Upside down, for displays seen in a mirror.
    Flipped,
    /// Left on even, right on odd display rows.
    Interleaved,
    /// Left above right.
    AboveBelow,
    /// The left view turned a quarter clockwise, the right one anticlockwise.
    Rotated,
}

/// Choices of setup that are not built into the hardware.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Draw a polygon monocular where deriving it saves no beats.
    pub cost_rule: bool,
    /// Treatment of highlights.
    pub specular: Specular,
    /// Treatment of colour.
    pub sampling: Sampling,
    /// Arrangement on the display.
    pub arrangement: Arrangement,
    /// Primary and secondary go to one display instead of one each.
    pub single: bool,
    /// The system tests no edges: there is none to lend, anti-aliasing widens no span, and depth
    /// is sampled.
    pub minimal: bool,
}

impl Options {
    /// Usual choices for a configuration.
    pub fn new(config: &Config) -> Options {
        Options {
            cost_rule: true,
            specular: if config.integrated { Specular::Integrated } else { Specular::Exception },
            sampling: Sampling::Automatic,
            arrangement: Arrangement::Normal,
            single: false,
            minimal: false,
        }
    }
}

/// The reason why a polygon is drawn monocular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// It faces, or is to be drawn for, one eye only.
    ViewExclusive,
    /// One view is more than 29 times as wide as the other.
    Ratio,
    /// Its highlight differs between the eyes.
    Specular,
    /// Deriving it would save less than two beats.
    Cost,
    /// It left the guard band.
    GuardBand,
    /// Anti-aliasing would widen its spans too far.
    Antialiasing,
    /// Its colour or depth is too steep to be extrapolated.
    Gradient,
    /// It has more than three corners, which is a monocular feature.
    Corners,
    /// The head is tilted, and the hardware is built without TILT, or the secondary may show rows
    /// that the primary has above or below its window, where it is not visited.
    Tilt,
}

impl Reason {
    /// All reasons, in the order they are listed.
    pub const ALL: [Reason; 9] = [
        Reason::ViewExclusive,
        Reason::Ratio,
        Reason::Specular,
        Reason::Cost,
        Reason::GuardBand,
        Reason::Antialiasing,
        Reason::Gradient,
        Reason::Corners,
        Reason::Tilt,
    ];

    /// Name in tables and reports.
    pub fn name(self) -> &'static str {
        match self {
            Reason::ViewExclusive => "view-exclusive",
            Reason::Ratio => "ratio over 29",
            Reason::Specular => "specular exception",
            Reason::Cost => "cost",
            Reason::GuardBand => "guard band",
            Reason::Antialiasing => "anti-aliasing limit",
            Reason::Gradient => "gradient limit",
            Reason::Corners => "more than three corners",
            Reason::Tilt => "tilted head",
        }
    }
}

/// A polygon's colour, depth and texture coordinates in one view, as linear functions.
#[derive(Clone, Copy, Debug)]
pub struct Attributes {
    /// Red, green, blue and alpha.
    pub colour: [Linear; 4],
    /// Depth.
    pub depth: Linear,
    /// Texture coordinates times inverse distance (texels, 16 fraction bits, times 2^16) and
    /// inverse distance (2^24 at the nearest vertex).
    pub texture: Option<[Linear; 3]>,
}

impl Attributes {
    /// The three corners that the attributes of a polygon pass through; its outline in this eye
    /// must have an area.
    pub fn corners(polygon: &Polygon, eye: Eye) -> [Vertex; 3] {
        let outline = Outline::new(polygon, eye);
        // Merged corners have shifted the numbering: find the vertex of each corner again.
        outline.largest_fan_triangle().map(|k| {
            let [x, y] = outline.points()[k];
            let here = |v: &&Vertex| {
                i64::from(v.x[eye as usize]) == x && i64::from(v.y[eye as usize]) == y
            };
            polygon.vertices.iter().find(here).copied().unwrap_or_default()
        })
    }

    fn plane(corners: &[Vertex; 3], eye: Eye, formats: &Formats) -> Plane {
        let places = corners.map(|v| [v.x[eye as usize].into(), v.y[eye as usize].into()]);
        Plane::new(places, formats.subpixel_bits)
    }

    /// The depth alone of a polygon whose outline in this eye has an area.
    pub fn depth(polygon: &Polygon, eye: Eye, formats: &Formats) -> Linear {
        let corners = Attributes::corners(polygon, eye);
        Attributes::plane(&corners, eye, formats).through(corners.map(|v| v.depth.into()))
    }

    /// The attributes of a polygon whose outline in this eye has an area.
    pub fn new(polygon: &Polygon, eye: Eye, formats: &Formats) -> Attributes {
        let vertices = Attributes::corners(polygon, eye);
        let plane = Attributes::plane(&vertices, eye, formats);
        let channel = |n: usize| {
            let Rgba(first) = vertices[0].colour[eye as usize];
            if polygon.vertices.len() > 3 {
                return plane.through([first[n].into(); 3]);
            }
            plane.through(vertices.map(|v| v.colour[eye as usize].0[n].into()))
        };
        let inverse = vertices.map(|v| i64::from(v.inverse));
        let texel = |n: usize| {
            plane.through([0, 1, 2].map(|k| (i64::from(vertices[k].texel[n]) * inverse[k]) >> 8))
        };
        Attributes {
            colour: [0, 1, 2, 3].map(channel),
            depth: plane.through(vertices.map(|v| v.depth.into())),
            texture: polygon.texture.map(|_| [texel(0), texel(1), plane.through(inverse)]),
        }
    }

    /// True if a colour or depth may leave its register ([`GUARD_BITS`]) within `reach` pixels of
    /// the polygon. Alpha is always checked.
    pub(super) fn exceeds(&self, reach: i64, colour_matters: bool, depth_matters: bool) -> bool {
        let steep = |linear: &Linear, integer_bits: u32| {
            let limit = 1i128 << (integer_bits + GUARD_BITS - 2 + FRACTION_BITS);
            let [a, b] = [linear.a, linear.b].map(|n| i128::from(n).abs());
            a * i128::from(reach) + b > limit
        };
        let colours = if colour_matters { &self.colour } else { &self.colour[3..] };
        colours.iter().any(|c| steep(c, 8)) || (depth_matters && steep(&self.depth, 24))
    }
}

/// A derived polygon.
#[derive(Clone, Debug)]
pub struct Derived {
    /// The eye with the larger area.
    pub primary: Eye,
    /// Primary to secondary position.
    pub map: Map,
    /// The polygon as the primary eye sees it.
    pub primary_view: View,
    /// The polygon as the secondary eye sees it.
    pub secondary_view: View,
    /// Which pixels of the primary are visited.
    pub spans: Spans,
    /// Visited pixels of the primary.
    pub rows: Vec<Row>,
    /// Secondary colour comes from colour planes.
    pub planes: bool,
    /// Secondary colour is averaged.
    pub average: bool,
}

/// The way in which a polygon is drawn.
#[derive(Clone, Debug)]
pub enum Plan {
    /// It covers nothing: no area, or outside the windows.
    Nothing,
    /// Drawn by the primary pipeline for each of these eyes.
    Monocular {
        /// The reason.
        reason: Reason,
        /// For which eyes it has an area and is wanted.
        eyes: [bool; 2],
    },
    /// Drawn for both eyes in one pass.
    Derived(Box<Derived>),
}

/// Decides how polygons are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Planner {
    /// Build parameters of the hardware.
    pub config: Config,
    /// The widths that follow from them.
    pub formats: Formats,
    /// Width of each view in pixels.
    pub width: u32,
    /// Height of each view in pixels.
    pub height: u32,
    /// Choices.
    pub options: Options,
}

impl Planner {
    /// A planner for views of this size.
    pub fn new(config: Config, options: Options, width: u32, height: u32) -> Planner {
        Planner { config, formats: Formats::new(&config), width, height, options }
    }

    /// Decides about one polygon.
    pub fn plan(&self, polygon: &Polygon) -> Plan {
        let outlines = Eye::BOTH.map(|eye| Outline::new(polygon, eye));
        let areas = outlines.map(|o| o.doubled_area());
        let wanted = Eye::BOTH.map(|eye| polygon.eyes.contains(eye) && areas[eye as usize] != 0);
        let monocular = |reason| Plan::Monocular { reason, eyes: wanted };
        if wanted == [false, false] {
            return Plan::Nothing;
        }
        if polygon.guard_band {
            return monocular(Reason::GuardBand);
        }
        if polygon.eyes != Eyes::Both || areas[0].signum() * areas[1].signum() != 1 {
            return monocular(Reason::ViewExclusive);
        }
        if polygon.vertices.len() > 3 {
            return monocular(Reason::Corners);
        }
        self.binocular(polygon, &outlines, areas).unwrap_or_else(monocular)
    }

    /// A polygon that both eyes see from the same side.
    fn binocular(
        &self,
        polygon: &Polygon,
        outlines: &[Outline; 2],
        areas: [i64; 2],
    ) -> Result<Plan, Reason> {
        let larger = if areas[0].abs() >= areas[1].abs() { Eye::Left } else { Eye::Right };
        let corners = |eye: Eye| {
            let points = outlines[eye as usize].points();
            [points[0], points[1], points[2]]
        };
        let map_from = |eye: Eye| Map::new(corners(eye), corners(eye.other()), &self.formats);
        let usable = |eye: Eye| map_from(eye).filter(Map::is_monotone).map(|map| (eye, map));
        // With a tilted head the larger view may still be the narrower one.
        let (primary, map) =
            usable(larger).or_else(|| usable(larger.other())).ok_or(Reason::ViewExclusive)?;
        let tilted = polygon.vertices.iter().any(|v| v.y[0] != v.y[1]);
        let primary_view = View::new(&outlines[primary as usize], &self.formats);
        if tilted && !(self.config.tilt && primary_view.has_rows_within(self.height)) {
            return Err(Reason::Tilt);
        }
        if map.exceeds_filter() {
            return Err(Reason::Ratio);
        }
        let integrated = self.options.specular == Specular::Integrated && self.config.integrated;
        let planes = integrated && polygon.texture.is_none();
        if polygon.specular && !planes && self.options.specular != Specular::Approximation {
            return Err(Reason::Specular);
        }
        let antialias = self.config.antialias && !self.options.minimal;
        let widening = if antialias { map.widening() } else { 0 };
        if widening > WIDENING_LIMIT {
            return Err(Reason::Antialiasing);
        }
        let depth_sampled = self.options.minimal || !self.config.interpolated_depth;
        let sampled = Attributes::new(polygon, primary, &self.formats);
        // What is not sampled is extrapolated to touched pixels only, in either view.
        let touches_outside = antialias && {
            let own = Attributes::new(polygon, primary.other(), &self.formats);
            own.exceeds(1, planes, !depth_sampled) || sampled.exceeds(1, true, true)
        };
        if touches_outside || sampled.exceeds(widening + 1, !planes, depth_sampled) {
            return Err(Reason::Gradient);
        }

        let secondary_view = View::new(&outlines[primary.other() as usize], &self.formats);
        let right = i64::from(self.width) - 1;
        let uncut = primary_view.is_within(self.width) && secondary_view.is_within(self.width);
        let slack = widening + 1;
        let window = match primary_view.first_and_last_line(self.height) {
            Some(lines) if !uncut => lines.iter().fold([0, right], |[left, right], &y| {
                let [first, last] = map.window(y, self.width.into());
                [left.min(first), right.max(last)]
            }),
            _ => [-slack, right + slack],
        };
        // The minimal system tests no edges; samples off the centre need what lies beside them.
        let spared = match primary_view.first_and_last_line(self.height) {
            Some([first, last]) if !antialias && !self.options.minimal => {
                let [left, right] = primary_view.extended_spans(0, 0, window).limits;
                map.spared((last - first + 1) as u64, (right - left + 1).max(0) as u64)
            }
            _ => 0,
        };
        let spans = primary_view.extended_spans(widening, spared, window);
        let rows: Vec<Row> = primary_view.rows(&spans, self.height).collect();
        if self.options.cost_rule {
            let derived = beats(&rows, |movement| map.allows(movement, &self.formats));
            let twice = self.monocular_cost(&primary_view) + self.monocular_cost(&secondary_view);
            if derived + LEAST_SAVING > twice {
                return Err(Reason::Cost);
            }
        }
        if rows.is_empty() {
            return Ok(Plan::Nothing);
        }
        let average = match self.options.sampling {
            Sampling::Automatic => polygon.texture.is_some(),
            Sampling::Nearest => false,
            Sampling::Average => true,
        };
        Ok(Plan::Derived(Box::new(Derived {
            primary,
            map,
            primary_view,
            secondary_view,
            spans,
            rows,
            planes,
            average,
        })))
    }

    fn monocular_cost(&self, view: &View) -> u64 {
        view.rows(&view.monocular_spans(self.width), self.height).map(|r| r.len()).sum()
    }
}
