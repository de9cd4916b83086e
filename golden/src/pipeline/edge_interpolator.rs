//! Edge interpolator: a function linear over whole secondary pixels (paper, sections 5.1 and 5.3).
//!
//! Three of them follow the edge functions; the same unit with other widths follows depth and the
//! colour planes.

use super::Op;
use crate::beat;
use crate::formats::*;
use crate::interface::Beat;

/// Beats of an interpolant with a value and a coefficient type of its own.
macro_rules! interpolant {
    ($beat:ident, $output:ident, $value:ty, $slope:ty) => {
        beat! {
            /// A primary beat as the interpolator sees it.
            pub struct $beat {
                /// what to do
                op: Op,
                /// the state after this beat becomes the row start
                save: bool,
                /// move one pixel to the right (at a ROW: one more than its whole part)
                r#move: bool,
                /// move down, -1, 0 or 1 pixels (TILT)
                y_move: Move,
                /// value to start from (LOAD)
                start: $value,
                /// change for one pixel to the right (LOAD)
                a: $slope,
                /// change for one pixel down (LOAD)
                b: $slope,
                /// change from row start to row start (LOAD)
                row: $value,
                /// dropped bits (LOAD)
                low: LowBits,
            }
        }

        beat! {
            /// The interpolant at a secondary pixel.
            pub struct $output {
                /// value at the pixel
                value: $value,
                /// change for one pixel to the right
                a: $slope,
                /// change for one pixel down
                b: $slope,
                /// dropped bits
                low: LowBits,
            }
        }

        impl Interpolant for $beat {
            type Output = $output;
            #[inline]
            fn fields(&self) -> Step {
                Step {
                    op: self.op,
                    save: self.save,
                    right: self.r#move.into(),
                    down: self.y_move.raw(),
                    start: self.start.raw(),
                    a: self.a.raw(),
                    b: self.b.raw(),
                    row: self.row.raw(),
                    low: self.low,
                }
            }
            #[inline]
            fn bits(formats: &Formats) -> u32 {
                <$value>::bits(formats)
            }
            #[inline]
            fn output(value: i64, a: i64, b: i64, low: LowBits, f: &Formats) -> $output {
                $output {
                    value: <$value>::new(value, f),
                    a: <$slope>::new(a, f),
                    b: <$slope>::new(b, f),
                    low,
                }
            }
        }
    };
}

/// The numbers of a beat, whatever their types.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Step {
    op: Op,
    save: bool,
    right: i64,
    down: i64,
    start: i64,
    a: i64,
    b: i64,
    row: i64,
    low: LowBits,
}

/// Beats that an [`EdgeInterpolator`] can take.
pub trait Interpolant: Beat {
    /// The beat that comes out.
    type Output: Beat;
    #[doc(hidden)]
    fn fields(&self) -> Step;
    #[doc(hidden)]
    fn bits(formats: &Formats) -> u32;
    #[doc(hidden)]
    fn output(value: i64, a: i64, b: i64, low: LowBits, formats: &Formats) -> Self::Output;
}

interpolant!(EdgeBeat, EdgeOutput, EdgeValue, Slope);
interpolant!(DepthBeat, DepthOutput, DepthPlane, DepthPlane);
interpolant!(ColourBeat, ColourOutput, ColourPlane, ColourPlane);

/// State of an interpolator for beats `B`.
#[derive(Clone, Debug)]
pub struct EdgeInterpolator<B> {
    formats: Formats,
    bits: u32,
    tilt: bool,
    start: i64,
    value: i64,
    saved: i64,
    a: i64,
    b: i64,
    row: i64,
    low: LowBits,
    beat: core::marker::PhantomData<B>,
}

impl<B: Interpolant> EdgeInterpolator<B> {
    /// An interpolator; with `tilt` it moves down within a row too.
    pub fn new(formats: Formats, tilt: bool) -> EdgeInterpolator<B> {
        EdgeInterpolator {
            formats,
            bits: B::bits(&formats),
            tilt,
            start: 0,
            value: 0,
            saved: 0,
            a: 0,
            b: 0,
            row: 0,
            low: LowBits::default(),
            beat: core::marker::PhantomData,
        }
    }

    /// Takes a beat.
    #[inline]
    pub fn step(&mut self, beat: &B) -> B::Output {
        let step = beat.fields();
        if step.op == Op::Load {
            self.load(beat);
        }
        self.advance(step.op, step.save, step.right, step.down);
        self.output()
    }

    /// Takes the registers of a beat that is a `LOAD`.
    #[inline]
    pub(super) fn load(&mut self, beat: &B) {
        let step = beat.fields();
        (self.start, self.a, self.b) = (step.start, step.a, step.b);
        (self.row, self.low) = (step.row, step.low);
    }

    /// Moves on; the registers are loaded.
    #[inline]
    pub(super) fn advance(&mut self, op: Op, save: bool, right: i64, down: i64) {
        let movement = right * self.a + if self.tilt { down * self.b } else { 0 };
        let sum = match op {
            Op::Load => self.start,
            Op::Row => self.saved + self.row + movement,
            Op::Step | Op::Reserved => self.value + movement,
        };
        self.value = reduce(sum, self.bits, true);
        if save {
            self.saved = self.value;
        }
    }

    /// Output of the beat taken last.
    #[inline]
    pub(super) fn output(&self) -> B::Output {
        B::output(self.value, self.a, self.b, self.low, &self.formats)
    }
}
