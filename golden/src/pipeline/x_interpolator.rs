//! X interpolator: the secondary x of every primary pixel (paper, section 5.1).

use super::{Lookahead, Op};
use crate::beat;
use crate::formats::*;

beat! {
    /// A primary beat as the x interpolator sees it.
    pub struct XBeat {
        /// what to do
        op: Op,
        /// the state after this beat becomes the row start
        save: bool,
        /// last beat of the polygon
        last: bool,
        /// secondary x to start from (LOAD)
        start: SecondaryX,
        /// G1 (LOAD)
        step: Scale,
        /// row shear (LOAD)
        row: SecondaryX,
    }
}

beat! {
    /// The secondary position of a primary pixel.
    pub struct XPixel {
        /// the beat's op
        op: Op,
        /// the beat's save flag
        save: bool,
        /// the beat's last flag
        last: bool,
        /// secondary pixel
        x: PixelX,
        /// the beat moved one pixel more than the row's whole part, or one pixel at a STEP
        r#move: bool,
        /// nearer to the pixel's centre than the beat before (or in its left half)
        near: bool,
        /// 0 <= x < width
        inside: bool,
        /// last beat in this secondary pixel
        end: bool,
    }
}

/// State of the x interpolator.
#[derive(Clone, Debug)]
pub struct XInterpolator {
    formats: Formats,
    width: i64,
    x: SecondaryX,
    saved: SecondaryX,
    step: Scale,
    row: SecondaryX,
}

const FRACTION_MASK: i64 = (1 << FRACTION_BITS) - 1;

impl XInterpolator {
    /// An interpolator for views of this width.
    pub fn new(formats: Formats, width: u32) -> XInterpolator {
        let zero = SecondaryX::default();
        let width = width.into();
        XInterpolator { formats, width, x: zero, saved: zero, step: Scale::default(), row: zero }
    }

    /// Takes a beat. `end` is what the beat alone tells, `last`: see [`Lookahead`].
    #[inline]
    pub fn step(&mut self, beat: &XBeat) -> XPixel {
        let fraction = |x: SecondaryX| x.raw() & FRACTION_MASK;
        let (from, by) = match beat.op {
            Op::Load => {
                self.step = beat.step;
                self.row = beat.row;
                (beat.start, 0)
            }
            Op::Row => (self.saved, self.row.raw()),
            Op::Step | Op::Reserved => (self.x, self.step.raw()),
        };
        // G1 = 1.0 has no fraction but moves a whole pixel.
        let whole = if beat.op == Op::Row { by & FRACTION_MASK } else { by };
        let carry = fraction(from) + whole > FRACTION_MASK;
        self.x = SecondaryX::wrap(from.raw() + by, &self.formats);
        if beat.save {
            self.saved = self.x;
        }
        let x = self.x.raw() >> FRACTION_BITS;
        XPixel {
            op: beat.op,
            save: beat.save,
            last: beat.last,
            x: PixelX::new(x, &self.formats),
            r#move: carry,
            near: 2 * fraction(self.x) < SCALE_ONE + self.step.raw(),
            inside: 0 <= x && x < self.width,
            end: beat.last,
        }
    }
}

impl Lookahead for XPixel {
    fn opens_pixel(&self) -> bool {
        self.op != Op::Step || self.r#move
    }
    fn is_last(&self) -> bool {
        self.last
    }
    fn set_end(&mut self, end: bool) {
        self.end = end;
    }
}
