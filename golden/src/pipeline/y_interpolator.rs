//! Y interpolator: display row of the secondary, and its movement with a tilted head (paper,
//! section 5.2).

use super::{Lookahead, Op};
use crate::beat;
use crate::formats::*;

beat! {
    /// A primary beat as the y interpolator sees it.
    pub struct YBeat {
        /// what to do
        op: Op,
        /// the state after this beat becomes the row start
        save: bool,
        /// last beat of the polygon
        last: bool,
        /// display row of the first scan line; with TILT that of view row 0 (LOAD)
        start: Coordinate,
        /// display rows a view row (LOAD)
        step: DisplayStep,
        /// secondary y to start from (LOAD, TILT)
        view: SecondaryX,
        /// movement of the secondary y for one primary pixel (LOAD, TILT)
        slant: Slant,
        /// movement of the secondary y from row start to row start (LOAD, TILT)
        row: SecondaryX,
    }
}

beat! {
    /// The secondary row of a primary pixel.
    pub struct YPixel {
        /// display row
        y: Coordinate,
        /// whole-pixel movement of the secondary y, the row's whole part left out
        r#move: Move,
        /// 0 <= secondary y < height
        inside: bool,
        /// last beat in this secondary row, as far as y tells
        end: bool,
    }
}

/// State of the y interpolator.
#[derive(Clone, Debug)]
pub struct YInterpolator {
    formats: Formats,
    tilt: bool,
    height: i64,
    y: Coordinate,
    start: Coordinate,
    step: DisplayStep,
    view: SecondaryX,
    saved: SecondaryX,
    slant: Slant,
    row: SecondaryX,
}

/// Output of the y interpolator, with the fields of the beat that [`Lookahead`] needs.
#[derive(Clone, Copy, Debug)]
pub struct YState {
    /// The pixel.
    pub pixel: YPixel,
    op: Op,
    last: bool,
}

impl YInterpolator {
    /// An interpolator for views of this height.
    pub fn new(formats: Formats, tilt: bool, height: u32) -> YInterpolator {
        YInterpolator {
            formats,
            tilt,
            height: height.into(),
            y: Coordinate::default(),
            start: Coordinate::default(),
            step: DisplayStep::default(),
            view: SecondaryX::default(),
            saved: SecondaryX::default(),
            slant: Slant::default(),
            row: SecondaryX::default(),
        }
    }

    /// Takes a beat.
    #[inline]
    pub fn step(&mut self, beat: &YBeat) -> YState {
        if beat.op == Op::Load {
            self.start = beat.start;
            self.step = beat.step;
        }
        let pixel = if self.tilt { self.tilted(beat) } else { self.upright(beat) };
        YState { pixel, op: beat.op, last: beat.last }
    }

    fn upright(&mut self, beat: &YBeat) -> YPixel {
        match beat.op {
            Op::Load => self.y = beat.start,
            Op::Row => self.y = Coordinate::wrap(self.y.raw() + self.step.raw(), &self.formats),
            Op::Step | Op::Reserved => {}
        }
        YPixel { y: self.y, r#move: Move::default(), inside: true, end: beat.last }
    }

    fn tilted(&mut self, beat: &YBeat) -> YPixel {
        let whole = |y: SecondaryX| y.raw() >> FRACTION_BITS;
        let before = self.view;
        let mut movement = 0;
        match beat.op {
            Op::Load => {
                self.slant = beat.slant;
                self.row = beat.row;
                self.view = beat.view;
            }
            Op::Row => {
                let mask = (1 << FRACTION_BITS) - 1;
                let carry = (self.saved.raw() & mask) + (self.row.raw() & mask) > mask;
                movement = carry.into();
                self.view = SecondaryX::wrap(self.saved.raw() + self.row.raw(), &self.formats);
            }
            Op::Step | Op::Reserved => {
                let next = self.view.raw() + self.slant.raw();
                movement = (next >> FRACTION_BITS) - whole(before);
                self.view = SecondaryX::wrap(next, &self.formats);
            }
        }
        if beat.save {
            self.saved = self.view;
        }
        let v = whole(self.view);
        YPixel {
            y: Coordinate::wrap(self.start.raw() + self.step.raw() * v, &self.formats),
            r#move: Move::wrap(movement, &self.formats),
            inside: 0 <= v && v < self.height,
            end: beat.last,
        }
    }
}

impl Lookahead for YState {
    fn opens_pixel(&self) -> bool {
        self.op != Op::Step || self.pixel.r#move.raw() != 0
    }
    fn is_last(&self) -> bool {
        self.last
    }
    fn set_end(&mut self, end: bool) {
        self.pixel.end = end;
    }
}
