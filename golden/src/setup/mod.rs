//! Setup: from three projected, snapped vertex pairs to register values, in integers only.

mod polygon;

pub use polygon::*;
