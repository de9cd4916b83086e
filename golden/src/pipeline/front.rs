//! Stage S1, common to both systems: where a primary pixel lies in the secondary view.

use super::observer::{Observer, Unit};
use super::x_interpolator::{XBeat, XInterpolator, XPixel};
use super::y_interpolator::{YBeat, YInterpolator, YPixel, YState};
use super::{is_bad_setup, Lookahead, Mode, Op, PrimaryBeat, Setup};
use crate::config::Config;
use crate::formats::Formats;

/// A primary beat and its place in the secondary view.
#[derive(Clone, Copy, Debug)]
pub(super) struct Located {
    pub beat: PrimaryBeat,
    pub x: XPixel,
    y: YState,
    pub mode: Mode,
    pub lend: bool,
    pub average: bool,
    pub planes: bool,
    pub swap: bool,
    pub mirror: bool,
    /// The record of the polygon's last `LOAD` was refused.
    pub bad: bool,
}

impl Located {
    pub fn y(&self) -> &YPixel {
        &self.y.pixel
    }
    /// The beat opens a secondary pixel.
    pub fn first(&self) -> bool {
        self.x.opens_pixel() || self.y.opens_pixel()
    }
    /// The beat is the last in its secondary pixel.
    pub fn end(&self) -> bool {
        self.x.end || self.y.pixel.end
    }
    pub fn inside(&self) -> bool {
        self.x.inside && self.y.pixel.inside
    }
}

/// State of stage S1.
#[derive(Clone, Debug)]
pub(super) struct Front {
    formats: Formats,
    lends: bool,
    x: XInterpolator,
    y: YInterpolator,
    polygon: Setup,
    bad: bool,
    waiting: Option<Located>,
}

impl Front {
    pub fn new(config: &Config, formats: Formats, lends: bool, width: u32, height: u32) -> Front {
        Front {
            formats,
            lends,
            x: XInterpolator::new(formats, width),
            y: YInterpolator::new(formats, config.tilt, height),
            polygon: Setup::default(),
            bad: false,
            waiting: None,
        }
    }

    /// True if a beat waits for the next one.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Takes a beat, with its record if it is a `LOAD`; gives the beats whose end is known now.
    #[inline]
    pub fn step(
        &mut self,
        beat: &PrimaryBeat,
        setup: &Setup,
        observer: &mut impl Observer,
    ) -> Step {
        let (op, save, last) = (beat.op, beat.save, beat.last);
        if op == Op::Load {
            self.polygon = *setup;
            self.bad = is_bad_setup(setup, self.lends, &self.formats);
        }
        let s = setup;
        let x_beat = XBeat { op, save, last, start: s.x_start, step: s.x_step, row: s.x_row };
        let y_beat = YBeat {
            op,
            save,
            last,
            start: s.y_start,
            step: s.y_step,
            view: s.y_view,
            slant: s.y_slant,
            row: s.y_row,
        };
        observer.input(Unit::XInterpolator, &x_beat);
        observer.input(Unit::YInterpolator, &y_beat);
        let mut located = Located {
            beat: *beat,
            x: self.x.step(&x_beat),
            y: self.y.step(&y_beat),
            mode: self.polygon.mode,
            lend: self.polygon.lend,
            average: self.polygon.average,
            planes: self.polygon.planes,
            swap: self.polygon.swap,
            mirror: self.polygon.mirror,
            bad: self.bad,
        };
        // Each interpolator says what it knows about the end; the two are joined behind them.
        let mut before = self.waiting.take();
        if let Some(before) = &mut before {
            before.x.set_end(located.x.opens_pixel());
            before.y.set_end(located.y.opens_pixel());
            observer.output(Unit::XInterpolator, &before.x);
            observer.output(Unit::YInterpolator, before.y());
        }
        if !last {
            self.waiting = Some(located);
            return Step { before, this: None };
        }
        located.x.set_end(true);
        located.y.set_end(true);
        observer.output(Unit::XInterpolator, &located.x);
        observer.output(Unit::YInterpolator, located.y());
        Step { before, this: Some(located) }
    }
}

/// The beats that a beat completes.
pub(super) struct Step {
    /// The one before it.
    pub before: Option<Located>,
    /// Itself, if none follows.
    pub this: Option<Located>,
}
