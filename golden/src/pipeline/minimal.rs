//! Minimal system: coordinate interpolation and point sampling (paper, figure 3).

use super::display::{display, DisplayPoint};
use super::front::{Front, Located, Step};
use super::observer::{Observer, Unit};
use super::redirect::{route, Slot};
use super::sampler::{Sampler, SamplerBeat};
use super::{Op, Output, Pixel, PrimaryBeat, Setup};
use crate::config::Config;
use crate::formats::*;

/// State of the minimal system.
#[derive(Clone, Debug)]
pub struct Minimal {
    formats: Formats,
    width: u32,
    single: bool,
    front: Front,
    sampler: Sampler,
    void: bool,
    error: bool,
}

impl Minimal {
    /// A minimal system for views of this size; `single` sends both eyes to one display.
    pub fn new(config: &Config, width: u32, height: u32, single: bool) -> Minimal {
        let formats = Formats::minimal(config);
        Minimal {
            formats,
            width,
            single,
            front: Front::new(config, formats, false, width, height),
            sampler: Sampler::default(),
            void: true,
            error: false,
        }
    }

    /// True if a polygon or a beat was refused.
    pub fn error(&self) -> bool {
        self.error
    }

    /// Takes a beat; `setup` is the record that a `LOAD` beat takes.
    pub fn beat(
        &mut self,
        beat: &PrimaryBeat,
        setup: &Setup,
        output: &mut impl Output,
        observer: &mut impl Observer,
    ) {
        let Step { before, this } = self.front.step(beat, setup, observer);
        for located in before.iter().chain(&this) {
            self.stage2(located, output, observer);
        }
    }

    fn stage2(&mut self, beat: &Located, output: &mut impl Output, observer: &mut impl Observer) {
        match beat.beat.op {
            Op::Load => self.void = beat.bad,
            Op::Reserved => self.void = true,
            Op::Step | Op::Row => {}
        }
        self.error |= self.void;
        let primary = &beat.beat;
        let point =
            DisplayPoint { x: beat.x.x, y: beat.y().y, swap: beat.swap, mirror: beat.mirror };
        observer.input(Unit::Display, &point);
        let place = display(&point, self.width, &self.formats);
        observer.output(Unit::Display, &place);
        let taken = SamplerBeat {
            first: beat.first(),
            end: beat.end(),
            near: beat.x.near,
            take: primary.centre,
            data: SampleData::pack(primary.rgba, primary.depth, &self.formats),
        };
        observer.input(Unit::Sampler, &taken);
        let sample = self.sampler.step(&taken);
        if let Some(sample) = &sample {
            observer.output(Unit::Sampler, sample);
        }
        let derived = !self.void && beat.mode.is_binocular() && beat.inside();
        let primary_pixel = (!self.void && primary.mask.raw() != 0).then(|| Pixel {
            eye: beat.mode.primary(),
            x: primary.x,
            y: primary.y,
            rgba: primary.rgba,
            area: Area::new((primary.mask.raw() as u16).count_ones().into(), &self.formats),
            depth: primary.depth,
            write: primary.centre,
            blended: false,
        });
        let secondary_pixel = sample.filter(|s| s.hit && derived).map(|sample| Pixel {
            eye: beat.mode.primary().other(),
            x: place.x,
            y: place.y,
            rgba: sample.data.rgba(),
            area: Area::new(self.formats.full_area().into(), &self.formats),
            depth: sample.data.depth(&self.formats),
            write: true,
            blended: false,
        });
        if primary_pixel.is_some() || secondary_pixel.is_some() {
            let slot = Slot::new(beat.mode.primary(), primary_pixel, secondary_pixel);
            observer.input(Unit::Redirect, &slot);
            for pixel in primary_pixel.iter().chain(&secondary_pixel) {
                output.write(route(pixel.eye, self.single), pixel);
            }
        }
    }
}
