//! Axes that ways are bent about.

use super::body::Body;
use crate::numerics::jacobi::svd3;
use crate::numerics::square::Square;
use crate::numerics::vec3;

/// The axis of the plane, or of a body of space its principal axes, that of its least extent first: they turn with the body.
pub(super) fn axes(body: &Body) -> Vec<[f64; 3]> {
    if body.dim() == 2 {
        return vec![[0.0, 0.0, 1.0]];
    }
    let places: &[[f64; 3]] = body.rest.as_chunks().0;
    let n = places.len().max(1) as f64;
    let center = places
        .iter()
        .fold([0.0; 3], |sum, &p| vec3::add_scaled(sum, 1.0 / n, p));
    let arms = || places.iter().map(|&p| vec3::sub(p, center));
    let mut covariance = [[0.0; 3]; 3];
    for arm in arms() {
        for (row, x) in covariance.iter_mut().zip(arm) {
            *row = vec3::add_scaled(*row, x, arm);
        }
    }
    let u = svd3(&covariance, covariance.det()).u;
    let axis = |k: usize| [u[0][k], u[1][k], u[2][k]];
    [2, 1, 0]
        .map(axis)
        .map(|axis| {
            // Upwards is where the body reaches farther.
            let skew: f64 = arms().map(|arm| vec3::dot(axis, arm).powi(3)).sum();
            axis.map(|x| if skew < 0.0 { -x } else { x })
        })
        .to_vec()
}
