//! Stereo pipeline: the primary pipeline and the hybrid system behind one polygon port.

use super::hybrid::Hybrid;
use super::observer::Observer;
use super::primary::Primary;
use super::{Edges, Output, Planes, Setup, Walk};
use crate::config::Config;

/// State of the stereo pipeline.
#[derive(Clone, Debug)]
pub struct Stereo {
    primary: Primary,
    hybrid: Hybrid,
}

/// A part of a polygon at the polygon port: one record of each of its streams.
#[derive(Clone, Copy, Debug, Default)]
pub struct PartRecords {
    /// Stream `walk`.
    pub walk: Walk,
    /// Stream `planes`.
    pub planes: Planes,
    /// Stream `setup`.
    pub setup: Setup,
    /// Stream `edges`.
    pub edges: Edges,
}

impl Stereo {
    /// A stereo pipeline for views of this size; `single` sends both eyes to one display.
    pub fn new(config: &Config, width: u32, height: u32, single: bool) -> Stereo {
        Stereo {
            primary: Primary::new(config, width),
            hybrid: Hybrid::new(config, width, height, single),
        }
    }

    /// True if a polygon was refused.
    pub fn error(&self) -> bool {
        self.hybrid.error()
    }

    /// Draws a part of a polygon.
    pub fn part(
        &mut self,
        records: &PartRecords,
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) {
        let Stereo { primary, hybrid } = self;
        let followed = (records.setup, records.edges);
        primary.part(&records.walk, &records.planes, |beat| {
            hybrid.beat(beat, &followed, output, observer);
        });
    }
}
