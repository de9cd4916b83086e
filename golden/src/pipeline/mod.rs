//! Models of the hardware units, one module a unit, and of the two systems made of them.
//!
//! Rules: a unit is a state with a `step` that takes one beat, or a function where there is no
//! state. Nothing here knows of clocks: stalls never change a stream, so a model that takes beat
//! after beat says all there is to say. ARCHITECTURE.md has the definition of every unit.

pub mod blend;
pub mod coverage;
pub mod display;
pub mod edge_interpolator;
pub mod filter;
pub mod filter_tables;
mod front;
pub mod hybrid;
mod lookahead;
pub mod minimal;
pub mod mono;
pub mod observer;
pub mod primary;
pub mod redirect;
pub mod sampler;
mod setup_check;
pub mod stereo;
mod streams;
pub mod traversal;
pub mod x_interpolator;
pub mod y_interpolator;

pub use lookahead::Lookahead;
pub use setup_check::is_bad_setup;
pub use streams::*;

use crate::formats::Eye;

/// Destination of a system's pixels: the frame buffers behind its output streams.
pub trait Output {
    /// Reads the frame buffers; every pixel written before counts.
    fn read(&mut self, request: &Request) -> Response;
    /// Takes a pixel from the left or the right output stream.
    fn write(&mut self, stream: Eye, pixel: &Pixel);
}
