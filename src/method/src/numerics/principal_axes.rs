//! The principal axes of points.

use super::square::Square;
use super::svd::svd3;
use super::vec3::{add_scaled, dot, sub};
use std::array::from_fn;

/// The principal axes of points.
pub struct PrincipalAxes {
    /// Mean of the points.
    pub center: [f64; 3],
    /// Unit vectors by decreasing extent. Each points to the side on which the points reach farther.
    pub axes: [[f64; 3]; 3],
    /// Sum of the third powers of the coordinates along each axis: 0 along an axis that a mirror symmetry reverses.
    pub skew: [f64; 3],
}

impl PrincipalAxes {
    /// Computes the axes of these points.
    pub fn of(points: impl Iterator<Item = [f64; 3]> + Clone) -> Self {
        let n = points.clone().count().max(1) as f64;
        let center = (points.clone()).fold([0.0; 3], |sum, p| add_scaled(sum, 1.0 / n, p));
        let arms = points.map(|p| sub(p, center));
        let mut covariance = [[0.0; 3]; 3];
        for arm in arms.clone() {
            for (row, x) in covariance.iter_mut().zip(arm) {
                *row = add_scaled(*row, x, arm);
            }
        }
        let u = svd3(&covariance, covariance.det()).u;
        let axes: [[f64; 3]; 3] = from_fn(|k| [u[0][k], u[1][k], u[2][k]]);
        let skew = axes.map(|axis| arms.clone().map(|arm| dot(axis, arm).powi(3)).sum());
        Self {
            center,
            axes: from_fn(|k| {
                if skew[k] < 0.0 {
                    axes[k].map(|x| -x)
                } else {
                    axes[k]
                }
            }),
            skew: skew.map(f64::abs),
        }
    }
}
