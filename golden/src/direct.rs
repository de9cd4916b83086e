//! Direct rendering: each view rasterised for itself, the reference for everything derived.
//!
//! Scan conversion is done from the corners with exact rational crossings and the half-open rule
//! (a pixel belongs to the polygon where ceil(left - 1/2) <= i < ceil(right - 1/2)). It shares
//! neither edge functions nor traversal with the pipeline; colour and depth are the same linear functions.

use crate::cost;
use crate::formats::{Area, Eye, Formats, Quantity, Rgba, DEPTH_MAX, FRACTION_BITS};
use crate::frame::{Fragment, Frame};
use crate::setup::{Attributes, Linear, Outline, Polygon};
use crate::texture::{Lookup, Texture};
use crate::work::{Meter, Operations, Unmetered};

/// Draws polygons for one eye after another.
#[derive(Clone, Copy, Debug)]
pub struct Direct<'a> {
    /// Widths of the numbers, and with them whether pixels have 1 or 16 samples.
    pub formats: Formats,
    /// Textures of the polygons.
    pub textures: &'a [Texture],
    /// Method of texture sampling.
    pub lookup: Lookup,
}

impl Direct<'_> {
    /// Draws one polygon as an eye sees it.
    pub fn draw(&self, polygon: &Polygon, eye: Eye, frame: &mut Frame) {
        self.draw_metered(polygon, eye, frame, &mut Unmetered);
    }

    /// The same, noting its work.
    pub fn draw_metered(
        &self,
        polygon: &Polygon,
        eye: Eye,
        frame: &mut Frame,
        meter: &mut impl Meter,
    ) {
        let outline = Outline::new(polygon, eye);
        if !polygon.eyes.contains(eye) {
            return;
        }
        let corners = outline.points().len();
        meter.note(|work| work.fixed_point += cost::area(corners));
        if outline.doubled_area() == 0 {
            return;
        }
        let attributes = Attributes::new(polygon, eye, &self.formats);
        let shade = Shade { attributes: &attributes, polygon, direct: self };
        let formats = self.formats;
        let at_pixel = cost::LINEAR + Operations::comparisons(1) + cost::samples(&formats);
        let at_pixel = at_pixel + self.colour_cost(polygon);
        meter.note(|work| {
            work.polygons += 1;
            work.fixed_point += cost::attributes(corners, &attributes);
        });
        let window = [frame.width, frame.height];
        scan_metered(&outline, window, &formats, meter, |x, y, mask, centre, meter| {
            let index = y as usize * frame.width as usize + x as usize;
            let fragment = Fragment {
                rgba: shade.colour(x, y),
                area: Area::new(mask.count_ones().into(), &formats),
                depth: depth_at(&attributes.depth, x, y),
                write: centre,
                id: polygon.id,
            };
            meter.note(|work| {
                work.pixels_tested += 1;
                work.depth_tests += 1;
                work.fixed_point += at_pixel;
                if fragment.depth < frame.depth[index] {
                    work.pixels_written += 1;
                    work.fixed_point += cost::BLEND;
                }
            });
            frame.draw(index, &fragment, &formats);
        });
    }

    /// Operations for the colour of a pixel of a polygon.
    pub(crate) fn colour_cost(&self, polygon: &Polygon) -> Operations {
        let texture = polygon.texture.and_then(|n| self.textures.get(n as usize));
        cost::colour(texture.is_some(), self.lookup)
    }
}

/// Colour of a polygon at a pixel, from its linear functions and its texture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shade<'a> {
    pub attributes: &'a Attributes,
    pub polygon: &'a Polygon,
    pub direct: &'a Direct<'a>,
}

impl Shade<'_> {
    /// The colour at pixel (x, y), clamped where it is extrapolated.
    pub fn colour(&self, x: i64, y: i64) -> Rgba {
        self.textured(Rgba(self.attributes.colour.map(|c| channel_at(&c, x, y))), x, y)
    }

    /// The texture at pixel (x, y), where there is one, lit by a colour.
    pub fn textured(&self, lit: Rgba, x: i64, y: i64) -> Rgba {
        let texture = self.polygon.texture.and_then(|n| self.direct.textures.get(n as usize));
        let (Some([u, v, inverse]), Some(texture)) = (&self.attributes.texture, texture) else {
            return lit;
        };
        // Perspective: both were divided by the distance, and their quotient is not.
        let inverse = (inverse.at(x, y) >> FRACTION_BITS).max(1);
        let texel = |l: &Linear| {
            let scaled = (l.at(x, y) >> FRACTION_BITS).clamp(-(1 << 54), 1 << 54);
            (scaled << 8).div_euclid(inverse)
        };
        let texel = texture.lookup(texel(u), texel(v), self.direct.lookup);
        Rgba(core::array::from_fn(|n| {
            let product = u32::from(texel.0[n]) * u32::from(lit.0[n]);
            ((product + 127) / 255) as u8
        }))
    }
}

/// Depth at a pixel.
pub(crate) fn depth_at(depth: &Linear, x: i64, y: i64) -> u32 {
    (depth.at(x, y) >> FRACTION_BITS).clamp(0, DEPTH_MAX.into()) as u32
}

fn channel_at(colour: &Linear, x: i64, y: i64) -> u8 {
    (colour.at(x, y) >> FRACTION_BITS).clamp(0, 255) as u8
}

/// Calls `pixel(x, y, mask, centre)` for every pixel of a convex outline in a window, rows from
/// the top.
pub fn scan(
    outline: &Outline,
    window: [u32; 2],
    formats: &Formats,
    mut pixel: impl FnMut(i64, i64, u16, bool),
) {
    let pixel = |x, y, mask, centre, _: &mut Unmetered| pixel(x, y, mask, centre);
    scan_metered(outline, window, formats, &mut Unmetered, pixel);
}

/// The same, noting its work; the meter is lent to `pixel`.
fn scan_metered<M: Meter>(
    outline: &Outline,
    window: [u32; 2],
    formats: &Formats,
    meter: &mut M,
    mut pixel: impl FnMut(i64, i64, u16, bool, &mut M),
) {
    let one = formats.one_pixel();
    let [width, height] = window.map(i64::from);
    let [[_, top], [_, bottom]] = outline.bounds();
    let rows = top.div_euclid(one).max(0)..=bottom.div_euclid(one).min(height - 1);
    for y in rows {
        let centre = crossing(outline, 2 * y + 1, one, 2, meter);
        if formats.mask_bits == 1 {
            for x in centre[0].max(0)..centre[1].min(width) {
                pixel(x, y, 1, true, meter);
            }
            continue;
        }
        // Four rows of four samples: scan conversion on a grid four times as fine.
        let lines: [[i64; 2]; 4] =
            [0, 1, 2, 3].map(|l| crossing(outline, 2 * (4 * y + l) + 1, one, 8, meter));
        let touched = lines.iter().filter(|l| l[0] < l[1]);
        let first = touched.clone().map(|l| l[0].div_euclid(4)).min().unwrap_or(0);
        let end = touched.map(|l| (l[1] + 3).div_euclid(4)).max().unwrap_or(0);
        for x in first.max(0)..end.min(width) {
            let mask = (0..16u16).fold(0, |mask, n| {
                let [left, right] = lines[usize::from(n >> 2)];
                let sample = 4 * x + i64::from(n & 3);
                mask | u16::from(left <= sample && sample < right) << n
            });
            if mask != 0 {
                pixel(x, y, mask, centre[0] <= x && x < centre[1], meter);
            }
        }
    }
}

/// First cell, and the one past the last, whose centre is inside on scan line
/// y = `line`/`divisions` pixels. Cells are 2/`divisions` pixels wide.
fn crossing(
    outline: &Outline,
    line: i64,
    one: i64,
    divisions: i64,
    meter: &mut impl Meter,
) -> [i64; 2] {
    let points = outline.points();
    // Scaled by `divisions`, the line has an integer y and a cell is 2·one wide.
    let y = line * one;
    let mut cells = [i64::MAX, i64::MIN];
    let mut crossed = 0;
    for (k, from) in points.iter().enumerate() {
        let to = points[(k + 1) % points.len()];
        let [from, to] = [*from, to].map(|p| p.map(|c| c * divisions));
        let [upper, lower] = if from[1] <= to[1] { [from, to] } else { [to, from] };
        // Half open: a line through the upper end belongs to this edge, through the lower to the next.
        if !(upper[1] <= y && y < lower[1]) {
            continue;
        }
        let rise = i128::from(lower[1] - upper[1]);
        let run = i128::from(lower[0] - upper[0]);
        // x = upper.x + run·(y - upper.y)/rise; the cell is ceil((x - one)/(2·one)).
        let numerator = i128::from(upper[0] - one) * rise + run * i128::from(y - upper[1]);
        let denominator = 2 * i128::from(one) * rise;
        let cell = -(-numerator).div_euclid(denominator);
        cells = [cells[0].min(cell as i64), cells[1].max(cell as i64)];
        crossed += 1;
    }
    meter.note(|work| work.fixed_point += cost::crossings(points.len(), crossed));
    if cells[0] > cells[1] {
        [0, 0]
    } else {
        cells
    }
}
