//! Which setup records are refused.

use super::Setup;
use crate::formats::*;

/// True if hardware must refuse to draw a polygon with this record. `lends`: the system has edge
/// interpolators to lend.
pub fn is_bad_setup(setup: &Setup, lends: bool, formats: &Formats) -> bool {
    let binocular = setup.mode.is_binocular();
    let scale = setup.x_step.raw();
    let column = setup.x_start.raw() >> FRACTION_BITS;
    let margin = i64::from(formats.guard_band) + START_SLACK;
    let beyond = column < -margin || column >= i64::from(formats.max_size) + margin;
    !setup.mode.is_legal()
        || (setup.lend && (binocular || !lends))
        || (binocular && !(SCALE_MIN..=SCALE_ONE).contains(&scale))
        || ((binocular || setup.lend) && beyond)
}
