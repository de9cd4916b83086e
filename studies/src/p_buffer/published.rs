//! Table 1 of Heo, Jung and Wohn (1998): one to fifteen rooms, 300 × 300 pixels, SUN SPARC 10.

/// Most rooms.
pub const ROOMS: usize = 15;
/// Columns and rows of a view.
pub const SIZE: u32 = 300;
/// "polygons".
pub const POLYGONS: [u32; ROOMS] = [
    3652, 7308, 10966, 14624, 18280, 21932, 25590, 29248, 32906, 36564, 40220, 43878, 47536, 51194,
    54852,
];
/// "visible polygons", of the right view.
pub const VISIBLE: [u32; ROOMS] =
    [301, 474, 536, 569, 584, 604, 617, 623, 626, 632, 634, 636, 638, 638, 640];
/// Seconds for the right view, full pipeline.
pub const FULL_RIGHT: [f64; ROOMS] =
    [0.67, 1.00, 1.04, 1.27, 1.43, 1.59, 1.77, 2.01, 2.10, 2.36, 2.48, 2.53, 2.80, 2.96, 3.17];
/// Seconds for the left view, full pipeline.
pub const FULL_LEFT: [f64; ROOMS] =
    [0.67, 0.99, 1.04, 1.26, 1.42, 1.58, 1.76, 1.99, 2.06, 2.36, 2.48, 2.52, 2.77, 2.85, 3.15];
/// Seconds for the right view, the first one, with a P-buffer.
pub const P_BUFFER_RIGHT: [f64; ROOMS] =
    [1.14, 1.70, 1.94, 2.09, 2.35, 2.48, 2.50, 2.60, 2.91, 3.12, 3.15, 3.35, 3.56, 3.62, 3.79];
/// Seconds for the left view, the second one, from visible polygons.
pub const P_BUFFER_LEFT: [f64; ROOMS] =
    [0.39, 0.45, 0.48, 0.39, 0.43, 0.37, 0.33, 0.41, 0.37, 0.43, 0.37, 0.44, 0.36, 0.37, 0.37];
