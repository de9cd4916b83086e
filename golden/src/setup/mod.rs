//! Setup: from three projected, snapped vertex pairs to register values, in integers only.
//!
//! Rules: nothing here uses floating point or the standard library, so firmware can run it. A
//! [`Planner`] decides how a [`Polygon`] is drawn; [`Registers`] has the values for a derived one,
//! part by part; [`View`] says which pixels are visited.

mod edge;
mod linear;
mod mapping;
mod plan;
mod polygon;
mod primary;
mod record;
mod span;

pub use edge::{Edge, Outline};
pub use linear::{Linear, Plane};
pub use mapping::Map;
pub use plan::*;
pub use polygon::*;
pub use primary::PrimaryRegisters;
pub use record::{Placement, Registers};
pub use span::{parts, Part, Row, Run, Spans, View};
