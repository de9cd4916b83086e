//! Minimal system: coordinate interpolation and point sampling (paper, figure 3).

use super::display::{display, DisplayPoint};
use super::front::{Front, Located};
use super::observer::{Observer, Unit};
use super::redirect::{redirect, Slot};
use super::sampler::{Sampler, SamplerBeat};
use super::{Op, Output, PrimaryBeat, Setup};
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

    /// Whether a polygon or a beat was refused.
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
        for located in self.front.step(beat, setup, observer).into_iter().flatten() {
            self.stage2(&located, output, observer);
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
        let sample = sample.filter(|s| s.hit && derived);
        let slot = Slot {
            primary: !self.void && primary.mask.raw() != 0,
            secondary: sample.is_some(),
            eye: beat.mode.primary(),
            primary_x: primary.x,
            primary_y: primary.y,
            primary_rgba: primary.rgba,
            primary_area: Area::new((primary.mask.raw() as u16).count_ones().into(), &self.formats),
            primary_depth: primary.depth,
            primary_write: primary.centre,
            secondary_x: place.x,
            secondary_y: place.y,
            secondary_rgba: sample.unwrap_or_default().data.rgba(),
            secondary_area: Area::new(self.formats.full_area().into(), &self.formats),
            secondary_depth: sample.unwrap_or_default().data.depth(&self.formats),
            secondary_write: true,
            secondary_blended: false,
        };
        if slot.primary || slot.secondary {
            observer.input(Unit::Redirect, &slot);
            for (stream, pixel) in redirect(&slot, self.single) {
                output.write(stream, &pixel);
            }
        }
    }
}
