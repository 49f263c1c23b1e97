//! Axes about which paths are bent.

use super::body::Body;
use unwrapd_method::numerics::principal_axes::PrincipalAxes;

/// Returns the axis of the plane, or the principal axes of a body of space, that of its least extent first: they turn
/// with the body.
pub(super) fn axes(body: &Body) -> Vec<[f64; 3]> {
    if body.dim() == 2 {
        return vec![[0.0, 0.0, 1.0]];
    }
    let places: &[[f64; 3]] = body.rest.as_chunks().0;
    let [long, middle, short] = PrincipalAxes::of(places.iter().copied()).axes;
    vec![short, middle, long]
}
