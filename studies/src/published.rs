//! Gates as McCann & Lister publish them ("An Architecture For Rapid Stereoscopic Image Generation",
//! Table 1, and section 5.1 for the minimal system).

/// X coordinate interpolator.
pub const X_INTERPOLATOR: u32 = 2423;
/// Y coordinate interpolator, without a tilted head.
pub const Y_INTERPOLATOR: u32 = 392;
/// One of the three edge interpolators.
pub const EDGE_INTERPOLATOR: u32 = 2768;
/// Box filter.
pub const FILTER: u32 = 1873;
/// Pixel coverage; an estimate.
pub const COVERAGE: u32 = 4000;
/// Blending.
pub const BLEND: u32 = 4520;
/// Pixel redirection.
pub const REDIRECT: u32 = 1242;
/// Minimal system; "about".
pub const MINIMAL: u32 = 5000;
/// The sum of the table, with three edge interpolators.
pub const HYBRID: u32 =
    X_INTERPOLATOR + Y_INTERPOLATOR + 3 * EDGE_INTERPOLATOR + FILTER + COVERAGE + BLEND + REDIRECT;
/// An ordinary primary pipeline: "in excess of approximately" (below Table 1).
pub const PRIMARY: u32 = 100_000;
