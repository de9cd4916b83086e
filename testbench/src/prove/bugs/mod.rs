//! The bugs that the properties catch: at least one of each property.

mod bug;
mod primary;
mod systems;
mod units;

pub use bug::Bug;

use std::sync::LazyLock;

/// All of them.
pub static BUGS: LazyLock<Vec<Bug>> =
    LazyLock::new(|| [units::BUGS, primary::BUGS, systems::BUGS].concat());
