//! Ways to find out what each eye sees: hidden surfaces, for one view, both, or the next frame.
//!
//! [`scan_line`] and [`bsp`] resolve the opaque [`Surfaces`] of a job into [`Items`], which say what
//! polygon each pixel shows. [`z_buffer`], [`p_buffer`] and [`warping`] draw a [`Model`] as a [`View`]
//! sees it. `docs/visibility.md` describes and compares them.

pub mod bsp;
mod depths;
mod disparity;
mod edge;
mod items;
pub mod model;
pub mod p_buffer;
pub mod renderer;
pub mod scan_line;
mod surfaces;
pub mod view;
pub mod warping;
pub mod z_buffer;

pub use items::{Items, NO_ITEM};
pub use model::Model;
pub use surfaces::{Surfaces, VisibilityError};
pub use view::{Pose, View};
