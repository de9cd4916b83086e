//! How far a derived pair of views is from direct rendering.

use crate::formats::{Eye, Rgba};
use crate::frame::{Frame, NO_ID};
use crate::picture::{colour_picture, psnr};
use crate::setup::Placement;
use crate::stereo::Job;
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
    /// Pixels of no polygon where there should be one.
    pub gaps: usize,
}

impl Quality {
    /// Compares an eye's frame, as a job arranges it on its display, with the direct view.
    pub fn of(job: &Job, eye: Eye, frame: &Frame, direct: &Frame) -> Quality {
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

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Quality { pixels, colours, ids, gaps, .. } = self;
        let ratio = self.ratio();
        write!(f, "{ratio}, differences: {colours} of {pixels} colours, {ids} ids; gaps: {gaps}")
    }
}
