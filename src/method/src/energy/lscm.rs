//! Least-squares conformal.

use super::Density;
use crate::numerics::square::Matrix;

/// The squared distance of J to the nearest similarity.
///
/// ```text
/// ψ = ½ (σ₁ − σ₂)²
/// ```
/// Minimum 0, at similarities, including the zero map: without a barrier or two fixed vertices a free boundary shrinks
/// to a point. Dimensionless; the sum over a mesh is an area. Domain: every J of the plane; quadratic. From: Lévy et
/// al. 2002, Least Squares Conformal Maps. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lscm;

impl Density<2> for Lscm {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, [a, b]: &[f64; 2]) -> f64 {
        0.5 * (a - b) * (a - b)
    }

    fn gradient(&self, [a, b]: &[f64; 2]) -> [f64; 2] {
        [a - b, b - a]
    }

    fn hessian(&self, _: &[f64; 2]) -> Matrix<2> {
        [[1.0, -1.0], [-1.0, 1.0]]
    }
}
