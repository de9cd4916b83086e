//! Ways to find out what each eye sees: hidden surfaces, for one view, both, or the next frame.
//!
//! [`scan_line`] and [`bsp`] resolve the opaque [`Surfaces`] of a job into [`Items`], which say
//! what polygon each pixel shows. `docs/visibility.md` describes and compares them.

pub mod bsp;
mod depths;
mod edge;
mod items;
pub mod renderer;
pub mod scan_line;
mod surfaces;

pub use items::{Items, NO_ITEM};
pub use surfaces::{Surfaces, VisibilityError};
