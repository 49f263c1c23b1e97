//! Coordinates in JSON.
//!
//! JSON cannot express a number that is not finite. JavaScript writes `null` in its place, Python the bare words `NaN`
//! and `Infinity`. Both are read as NaN here, so that a bad target is reported as such and not as a syntax error.

use serde::{Deserialize, Deserializer};

/// Deserializes a position with any number of coordinates.
pub(super) fn position<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(from)?;
    Ok(numbers.into_iter().map(or_nan).collect())
}

/// Deserializes a position in the plane.
pub(super) fn planar<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    <[Option<f64>; 2]>::deserialize(from).map(|numbers| numbers.map(or_nan))
}

/// Deserializes a list of positions.
pub(super) fn positions<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let positions = Vec::<Vec<Option<f64>>>::deserialize(from)?;
    let finite = |numbers: Vec<Option<f64>>| numbers.into_iter().map(or_nan).collect();
    Ok(positions.into_iter().map(finite).collect())
}

fn or_nan(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}
