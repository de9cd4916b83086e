//! Difference of a derived pair of views from direct rendering.

use crate::direct::depth_at;
use crate::formats::{Eye, Formats, Rgba};
use crate::frame::{Frame, NO_ID};
use crate::picture::{colour_picture, psnr};
use crate::progress::Stage;
use crate::setup::{Attributes, Linear, Outline, Placement};
use crate::stereo::{pieces, Job};
use std::collections::{HashMap, HashSet};
use std::fmt;

/// One view, derived, against the same view rendered directly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Peak signal-to-noise ratio in dB; infinite where all colours are equal.
    pub decibels: f64,
    /// Pixels of the view.
    pub pixels: usize,
    /// Pixels of another colour.
    pub colours: usize,
    /// Pixels of another polygon.
    pub ids: usize,
    /// Pixels among them at which the other polygon is too and has the same depth, to within a unit of depth: which of
    /// the two is seen there is a matter of rounding.
    pub ties: usize,
    /// Pixels of no polygon where there should be one.
    pub gaps: usize,
}

impl Quality {
    /// Compares an eye's frame, as a job arranges it on its display, with the direct view.
    pub fn of(job: &Job, eye: Eye, frame: &Frame, direct: &Frame) -> Quality {
        let _stage = Stage::new(format!("comparing the {} view with the direct one", eye.name()));
        let placement = Placement::new(&job.planner(false), eye);
        let seen: Vec<Option<usize>> = (0..direct.colour.len())
            .map(|n| {
                let [x, y] = [n as u32 % direct.width, n as u32 / direct.width].map(i64::from);
                let [x, y] = placement.place(x, y);
                frame.index(x, y)
            })
            .collect();
        let colour = |n: usize| seen[n].map_or([0; 3], |at| frame.colour[at]);
        let id = |n: usize| seen[n].map_or(NO_ID, |at| frame.id[at]);
        let count =
            |differs: &dyn Fn(usize) -> bool| (0..seen.len()).filter(|&n| differs(n)).count();
        let picture = |colour: &dyn Fn(usize) -> [u8; 3]| {
            let opaque = |n| {
                let [r, g, b] = colour(n);
                Rgba([r, g, b, 255])
            };
            let colours: Vec<Rgba> = (0..seen.len()).map(opaque).collect();
            colour_picture(direct.width, direct.height, &colours)
        };
        Quality {
            decibels: psnr(&picture(&colour), &picture(&|n| direct.colour[n])).unwrap_or(0.0),
            pixels: seen.len(),
            colours: count(&|n| colour(n) != direct.colour[n]),
            ids: count(&|n| id(n) != direct.id[n]),
            ties: ties(job, eye, direct, id),
            gaps: count(&|n| id(n) == NO_ID && direct.id[n] != NO_ID),
        }
    }

    /// Two views together: mean of the squared errors, sums of the pixels.
    pub fn together([a, b]: [Quality; 2]) -> Quality {
        let error = |quality: Quality| 10f64.powf(-quality.decibels / 10.0);
        Quality {
            decibels: -10.0 * ((error(a) + error(b)) / 2.0).log10(),
            pixels: a.pixels + b.pixels,
            colours: a.colours + b.colours,
            ids: a.ids + b.ids,
            ties: a.ties + b.ties,
            gaps: a.gaps + b.gaps,
        }
    }

    /// The ratio as a person reads it.
    pub fn ratio(&self) -> String {
        if self.decibels.is_finite() {
            format!("{:.1} dB", self.decibels)
        } else {
            "identical".into()
        }
    }
}

/// Pixels where the polygon `shown` is not the one that direct rendering shows, but covers the pixel
/// and is as deep there to within one unit, by which planes are rounded.
fn ties(job: &Job, eye: Eye, direct: &Frame, shown: impl Fn(usize) -> u32) -> usize {
    let formats = Formats::new(&job.config);
    let differs = |n: &usize| ![NO_ID, direct.id[*n]].contains(&shown(*n));
    let wrong: Vec<usize> = (0..direct.id.len()).filter(differs).collect();
    let wanted: HashSet<u32> = wrong.iter().map(|&n| shown(n)).collect();
    let mut planes: HashMap<u32, Vec<(Outline, Linear)>> = HashMap::new();
    for polygon in pieces(job.polygons).filter(|p| wanted.contains(&p.id)) {
        let outline = Outline::new(&polygon, eye);
        if polygon.eyes.contains(eye) && outline.doubled_area() != 0 {
            let plane = Attributes::depth(&polygon, eye, &formats);
            planes.entry(polygon.id).or_default().push((outline, plane));
        }
    }
    let ties = |n: &&usize| {
        let [x, y] = [**n as u32 % direct.width, **n as u32 / direct.width].map(i64::from);
        let here = planes.get(&shown(**n)).into_iter().flatten();
        here.into_iter().any(|(outline, plane)| {
            outline.edges(&formats).all(|edge| edge.value().at(x, y) >= 0)
                && depth_at(plane, x, y).abs_diff(direct.depth[**n]) <= 1
        })
    };
    wrong.iter().filter(ties).count()
}

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Quality { pixels, colours, ids, gaps, .. } = self;
        let ratio = self.ratio();
        write!(f, "{ratio}, differences: {colours} of {pixels} colours, {ids} ids; gaps: {gaps}")
    }
}
