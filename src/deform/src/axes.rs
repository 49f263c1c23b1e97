//! Axes that ways are bent about.

use super::body::Body;
use unwrapd_method::numerics::principal_axes::PrincipalAxes;

/// The axis of the plane, or of a body of space its principal axes, that of its least extent first: they turn with the body.
pub(super) fn axes(body: &Body) -> Vec<[f64; 3]> {
    if body.dim() == 2 {
        return vec![[0.0, 0.0, 1.0]];
    }
    let places: &[[f64; 3]] = body.rest.as_chunks().0;
    let [long, middle, short] = PrincipalAxes::of(places.iter().copied()).axes;
    vec![short, middle, long]
}
