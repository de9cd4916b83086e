//! Ways to find out what each eye sees: hidden surfaces, for one view, both, or the next frame.

pub mod model;
pub mod p_buffer;
pub mod view;
pub mod warping;
pub mod z_buffer;

pub use model::Model;
pub use view::{Pose, View};
