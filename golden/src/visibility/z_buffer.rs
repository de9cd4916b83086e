//! The full pipeline for one view: transform, clip, scan-convert, test depth. One colour a polygon. Heo,
//! Jung and Wohn 1998, figure 6, without its ids and its second view, which are the P-buffer's.
//!
//! Scan conversion is exact, as in [`crate::direct`]: corners are snapped to subpixels, and an edge's
//! crossing with each centre line is stepped in integers. Of equal depths the polygon drawn first
//! stays (Heo, Jung and Wohn keep the last one).

use super::model::{Model, Piece};
use super::view::View;
use crate::formats::DEPTH_MAX;
use crate::frame::Frame;
use crate::scene::clip::{clip_all, Corner};
use crate::scene::vector::Vec3;
use crate::scene::HalfSpace;
use crate::setup::MAX_VERTICES;
use crate::work::Meter;

/// Fraction bits of a snapped coordinate.
const SUBPIXEL_BITS: u32 = 8;
const ONE: i32 = 1 << SUBPIXEL_BITS;
/// Pixels around the window within which polygons are left unclipped.
const GUARD_BAND: f64 = 1024.0;
/// Fraction bits of a depth that is stepped along a row.
const DEPTH_FRACTION: u32 = 16;
/// Corners of a polygon after five cuts.
const MAX_CORNERS: usize = MAX_VERTICES + 5;

/// A polygon in the view: corners in subpixels with their depths.
#[derive(Clone, Copy)]
struct Projected {
    corners: [[i32; 2]; MAX_CORNERS],
    depths: [u32; MAX_CORNERS],
    count: usize,
}

/// Depth as a linear function of pixel centres, and the pixel that it is anchored at.
#[derive(Clone, Copy)]
struct DepthPlane {
    across: f64,
    down: f64,
    origin: f64,
}

/// A frame buffer with a z-buffer, and what scan conversion needs beside.
#[derive(Clone, Debug)]
pub struct ZBuffer {
    /// The frame drawn so far. Ids are written for a P-buffer only.
    pub frame: Frame,
    view: View,
    planes: [HalfSpace; 5],
    /// First pixel, and the one past the last, on each row of the polygon in hand.
    spans: Vec<[i32; 2]>,
}

impl ZBuffer {
    /// A cleared frame for a view.
    pub fn new(view: View, background: [u8; 3]) -> ZBuffer {
        let [width, height] = view.size;
        ZBuffer {
            frame: Frame::new(width, height, background),
            view,
            planes: view.planes(GUARD_BAND),
            spans: vec![[0; 2]; height as usize],
        }
    }

    /// Clears colours and depths, and ids if they are kept, for another view of the same size.
    pub fn clear<const IDS: bool>(&mut self, view: View, background: [u8; 3]) {
        (self.view, self.planes) = (view, view.planes(GUARD_BAND));
        self.frame.clear::<IDS>(background);
    }

    /// Draws a whole model; with `IDS` the frame's ids too, which makes a P-buffer of it.
    pub fn draw_all<const IDS: bool>(&mut self, model: &Model, meter: &mut impl Meter) {
        for piece in model.pieces() {
            self.draw::<IDS>(piece, model.corners(piece), meter);
        }
    }

    /// Draws one polygon.
    #[inline]
    pub fn draw<const IDS: bool>(
        &mut self,
        piece: &Piece,
        corners: &[Vec3],
        meter: &mut impl Meter,
    ) {
        let Some(polygon) = self.project(corners, meter) else { return };
        let rows = self.edges(&polygon, meter);
        if rows.is_empty() {
            return;
        }
        let Some(plane) = polygon.depth_plane() else { return };
        meter.note(|work| work.polygons += 1);
        let Frame { width, colour, depth, id, .. } = &mut self.frame;
        let width = *width as usize;
        for y in rows {
            let [first, end] = self.spans[y].map(|x| x.clamp(0, width as i32) as usize);
            if first >= end {
                continue;
            }
            let step = fixed(plane.across);
            let mut z = fixed(plane.at(first, y));
            for at in y * width + first..y * width + end {
                let here = (z >> DEPTH_FRACTION).clamp(0, DEPTH_MAX.into()) as u32;
                z = z.wrapping_add(step);
                if here < depth[at] {
                    depth[at] = here;
                    colour[at] = piece.colour;
                    if IDS {
                        id[at] = piece.id;
                    }
                    meter.note(|work| work.pixels_written += 1);
                }
            }
            meter.note(|work| {
                work.interpolations += (end - first) as u64;
                work.pixels_tested += (end - first) as u64;
                work.depth_tests += (end - first) as u64;
            });
        }
    }

    /// Transforms, clips and snaps; none if the polygon lies beside the window.
    #[inline]
    fn project(&self, corners: &[Vec3], meter: &mut impl Meter) -> Option<Projected> {
        let near = self.view.near();
        let mut homogeneous = [[0.0; 3]; MAX_CORNERS];
        let mut least = f64::MAX;
        for (point, corner) in homogeneous.iter_mut().zip(corners) {
            *point = self.view.homogeneous(*corner);
            least = least.min(point[2]);
        }
        if least < near {
            return self.project_clipped(corners, meter);
        }
        let [width, height] = self.view.size.map(f64::from);
        let mut polygon = Projected::EMPTY;
        let mut bounds = [[f64::MAX, f64::MIN]; 2];
        for [x, y, w] in &homogeneous[..corners.len()] {
            let inverse = 1.0 / w;
            let place = [x * inverse, y * inverse];
            for (bound, n) in bounds.iter_mut().zip(place) {
                *bound = [bound[0].min(n), bound[1].max(n)];
            }
            polygon.push(place, self.view.depth_of_inverse(inverse));
        }
        let beside = |[least, most]: [f64; 2], size: f64| most <= 0.0 || least >= size;
        if beside(bounds[0], width) || beside(bounds[1], height) {
            return None;
        }
        let leaves =
            |[least, most]: [f64; 2], size: f64| least < -GUARD_BAND || most > size + GUARD_BAND;
        if leaves(bounds[0], width) || leaves(bounds[1], height) {
            return self.project_clipped(corners, meter);
        }
        Some(polygon)
    }

    /// The same for a polygon that reaches before the near plane or beyond the guard band.
    #[cold]
    fn project_clipped(&self, corners: &[Vec3], meter: &mut impl Meter) -> Option<Projected> {
        let corners = corners.iter().map(|&position| Corner { position, ..Corner::default() });
        meter.note(|work| work.boundary_clips += self.planes.len() as u64);
        let kept = clip_all(corners.collect(), &self.planes);
        let mut polygon = Projected::EMPTY;
        for corner in &kept {
            let [x, y, w] = self.view.homogeneous(corner.position);
            let inverse = 1.0 / w.max(self.view.near());
            polygon.push([x * inverse, y * inverse], self.view.depth_of_inverse(inverse));
        }
        (polygon.count > 2).then_some(polygon)
    }

    /// Finds the span of every row that the polygon crosses in the window.
    #[inline]
    fn edges(&mut self, polygon: &Projected, meter: &mut impl Meter) -> std::ops::Range<usize> {
        let height = self.view.size[1] as i32;
        let corners = &polygon.corners[..polygon.count];
        let (mut top, mut bottom) = (i32::MAX, i32::MIN);
        for [_, y] in corners {
            (top, bottom) = (top.min(*y), bottom.max(*y));
        }
        let (first, end) = (row_below(top).max(0), row_below(bottom).min(height));
        if first >= end {
            return 0..0;
        }
        let rows = first as usize..end as usize;
        self.spans[rows.clone()].fill([i32::MAX, i32::MIN]);
        let mut from = corners[corners.len() - 1];
        for &to in corners {
            let [upper, lower] = if from[1] <= to[1] { [from, to] } else { [to, from] };
            let steps = row_below(upper[1]).max(0)..row_below(lower[1]).min(height);
            if steps.start < steps.end {
                meter.note(|work| work.edge_updates += (steps.end - steps.start) as u64);
                step_edge(upper, lower, steps, &mut self.spans);
            }
            from = to;
        }
        rows
    }
}

/// The first row whose centre line is not above y (in subpixels).
#[inline]
fn row_below(y: i32) -> i32 {
    (y + ONE / 2 - 1) >> SUBPIXEL_BITS
}

/// Widens the spans of some rows by an edge: the cell is ceil(x - 1/2), x where the edge crosses the
/// row's centre line. The quotient is stepped from row to row with its remainder.
#[inline]
fn step_edge(upper: [i32; 2], lower: [i32; 2], rows: std::ops::Range<i32>, spans: &mut [[i32; 2]]) {
    let [run, rise] = [lower[0] - upper[0], lower[1] - upper[1]].map(i64::from);
    let centre = (rows.start << SUBPIXEL_BITS) + ONE / 2;
    let below = i64::from(centre - upper[1]);
    // x - 1/2 as a fraction, less a hair: the floor of that and 1 more is the ceiling.
    let divisor = rise << SUBPIXEL_BITS;
    let numerator = i64::from(upper[0] - ONE / 2) * rise + run * below - 1;
    let (mut cell, mut rest) = (numerator.div_euclid(divisor) + 1, numerator.rem_euclid(divisor));
    let (whole, part) = if rows.end - rows.start > 1 {
        (run.div_euclid(rise), run.rem_euclid(rise) << SUBPIXEL_BITS)
    } else {
        (0, 0)
    };
    for span in &mut spans[rows.start as usize..rows.end as usize] {
        *span = [span[0].min(cell as i32), span[1].max(cell as i32)];
        (cell, rest) = (cell + whole, rest + part);
        if rest >= divisor {
            (cell, rest) = (cell + 1, rest - divisor);
        }
    }
}

impl Projected {
    const EMPTY: Projected =
        Projected { corners: [[0; 2]; MAX_CORNERS], depths: [0; MAX_CORNERS], count: 0 };

    #[inline]
    fn push(&mut self, place: [f64; 2], depth: u32) {
        if self.count < MAX_CORNERS {
            self.corners[self.count] = place.map(snap);
            self.depths[self.count] = depth;
            self.count += 1;
        }
    }

    /// The plane through the corners of the largest triangle of the fan; none without an area.
    #[inline]
    fn depth_plane(&self) -> Option<DepthPlane> {
        let [[x0, y0], ..] = self.corners;
        let from = |k: usize| [self.corners[k][0] - x0, self.corners[k][1] - y0].map(i64::from);
        let area = |k: usize| {
            let ([x1, y1], [x2, y2]) = (from(k), from(k + 1));
            x1 * y2 - x2 * y1
        };
        let mut best = (1, area(1));
        for k in 2..self.count - 1 {
            let doubled = area(k);
            if doubled.abs() > best.1.abs() {
                best = (k, doubled);
            }
        }
        let (k, doubled) = best;
        if doubled == 0 {
            return None;
        }
        let ([x1, y1], [x2, y2]) = (from(k).map(|n| n as f64), from(k + 1).map(|n| n as f64));
        let rise = |n: usize| f64::from(self.depths[n]) - f64::from(self.depths[0]);
        let (z1, z2) = (rise(k), rise(k + 1));
        let scale = f64::from(ONE) / doubled as f64;
        let across = (z1 * y2 - z2 * y1) * scale;
        let down = (x1 * z2 - x2 * z1) * scale;
        // At the centre of pixel (0, 0), half a unit added so that dropping the fraction rounds.
        let back = |n: i32| 0.5 - f64::from(n) / f64::from(ONE);
        let origin = f64::from(self.depths[0]) + 0.5;
        Some(DepthPlane { across, down, origin: origin + across * back(x0) + down * back(y0) })
    }
}

impl DepthPlane {
    /// Depth at a pixel, with half a unit.
    #[inline]
    fn at(&self, x: usize, y: usize) -> f64 {
        self.origin + self.across * x as f64 + self.down * y as f64
    }
}

/// The nearest subpixel, ties to even.
#[inline]
fn snap(n: f64) -> i32 {
    // Adding 1.5 * 2^52 leaves no bits for a fraction; rounding functions of the system are slower.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    ((n * f64::from(ONE) + ROUND) - ROUND) as i32
}

/// A depth with its fraction bits.
#[inline]
fn fixed(n: f64) -> i64 {
    (n * f64::from(1 << DEPTH_FRACTION)) as i64
}
