//! Values of a rig that nothing can be projected with.

/// Largest magnitude of a coordinate or rig value; beyond it doubles no longer resolve subpixels.
pub const COORDINATE_LIMIT: f64 = 1e9;

/// A rig that nothing can be projected with.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field}: expected {expected}, found {}", shown(*.found))]
pub struct RigError {
    /// Name of the value, as in rig files: `piecewise.partitions[1].near`.
    pub field: String,
    /// The allowed values.
    pub expected: String,
    /// The value found.
    pub found: f64,
}

impl RigError {
    /// An error of a value.
    pub fn new(field: impl Into<String>, expected: impl Into<String>, found: f64) -> RigError {
        RigError { field: field.into(), expected: expected.into(), found }
    }
}

/// A number with an exponent where it would be long without.
pub(crate) fn shown(n: f64) -> String {
    let short = n == 0.0 || !n.is_finite() || (1e-9..1e15).contains(&n.abs());
    if short {
        n.to_string()
    } else {
        format!("{n:e}")
    }
}

/// Refuses what is no length that anything can be projected with: from 1e-9 to 1e9.
pub(crate) fn check_length(field: &str, found: f64) -> Result<(), RigError> {
    let (least, most) = (1.0 / COORDINATE_LIMIT, COORDINATE_LIMIT);
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(RigError::new(field, format!("a number from {least:e} to {most:e}"), found))
}
