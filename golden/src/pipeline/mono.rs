//! Monocular pipeline: the primary pipeline with a depth test and blending of its own.

use super::blend::{blend, BlendPixel};
use super::primary::Primary;
use super::{Output, Pixel, Planes, PrimaryBeat, Request, Walk};
use crate::config::Config;
use crate::formats::*;

/// State of the monocular pipeline.
#[derive(Clone, Debug)]
pub struct Mono {
    formats: Formats,
    external_depth: bool,
    eye: Eye,
    primary: Primary,
}

impl Mono {
    /// A pipeline for an eye whose view has this width.
    pub fn new(config: &Config, width: u32, eye: Eye) -> Mono {
        Mono {
            formats: Formats::new(config),
            external_depth: config.external_depth,
            eye,
            primary: Primary::new(config, width),
        }
    }

    /// Draws a part of a polygon.
    pub fn part(&mut self, walk: &Walk, planes: &Planes, output: &mut impl Output) {
        let Mono { formats, external_depth, eye, ref mut primary } = *self;
        primary.part(walk, planes, |beat| {
            if beat.mask.raw() != 0 {
                draw(beat, eye, external_depth, &formats, output);
            }
        });
    }
}

/// Reads the background, tests the depth and blends.
fn draw(beat: &PrimaryBeat, eye: Eye, external: bool, f: &Formats, output: &mut impl Output) {
    let &PrimaryBeat { x, y, rgba, depth, .. } = beat;
    let area = Area::new((beat.mask.raw() as u16).count_ones().into(), f);
    let behind = output.read(&Request { eye, x, y });
    if !external && depth >= behind.depth {
        return;
    }
    let [.., alpha] = rgba.0;
    let (rgb, background, tag) = (rgba.rgb(), behind.rgb, Tag::default());
    let [r, g, b] = blend(&BlendPixel { rgb, alpha, area, background, tag }, f).rgb;
    let rgba = Rgba([r, g, b, alpha]);
    let write = beat.centre;
    output.write(eye, &Pixel { eye, x, y, rgba, area, depth, write, blended: true });
}
