//! Conformal distortion bounded from above.

use std::sync::Arc;

use super::inverse_spline::reciprocal;
use crate::energy::Density;
use crate::numerics::square::Matrix;

/// A density of the plane with a barrier that keeps the conformal distortion q = σ₁/σ₂ below a bound K.
///
/// ```text
/// ψ + β (1/g(y) − 1)   for y < 1, ψ above     y = (K − q)/((1 − a) K)     g(y) = y³ − 3y² + 3y
/// ```
/// The barrier is zero for q ≤ aK, so it does not affect ordinary triangles, and infinite at q = K: as the inverse
/// spline keeps triangles from inverting, it keeps them from degenerating to needles. Weighted like ψ. Domain: that of
/// ψ with det J > 0 and q < K, +∞ outside; the start must be inside. From: Schüller et al. 2013, section 6 (future
/// work). Tests: `barrier::taylor_bounded`, `deform::conformal_distortion_stays_below_its_bound`.
#[derive(Clone, Debug)]
pub struct Bounded {
    /// ψ.
    pub density: Arc<dyn Density<2>>,
    /// K > 1.
    pub bound: f64,
    /// β, the strength.
    pub beta: f64,
}

/// a: the share of the bound above which the barrier is nonzero.
const ONSET: f64 = 0.7;

impl Bounded {
    /// Returns the barrier and its first two derivatives in q; zero for q ≤ aK.
    fn barrier(&self, q: f64) -> [f64; 3] {
        let support = (1.0 - ONSET) * self.bound;
        let [value, first, second] = reciprocal((self.bound - q) / support);
        [
            self.beta * value,
            -self.beta / support * first,
            self.beta / (support * support) * second,
        ]
    }
}

impl Density<2> for Bounded {
    fn floor(&self) -> f64 {
        self.density.floor().max(0.0)
    }

    fn value(&self, sigma: &[f64; 2]) -> f64 {
        let [a, b] = *sigma;
        if b <= 0.0 || a >= self.bound * b {
            return f64::INFINITY;
        }
        self.density.value(sigma) + self.barrier(a / b)[0]
    }

    fn gradient(&self, sigma: &[f64; 2]) -> [f64; 2] {
        let mut gradient = self.density.gradient(sigma);
        let [a, b] = *sigma;
        let [_, first, _] = self.barrier(a / b);
        gradient[0] += first / b;
        gradient[1] -= first * a / (b * b);
        gradient
    }

    fn hessian(&self, sigma: &[f64; 2]) -> Matrix<2> {
        let mut hessian = self.density.hessian(sigma);
        let [a, b] = *sigma;
        let [_, first, second] = self.barrier(a / b);
        let slope = [1.0 / b, -a / (b * b)];
        let mixed = -1.0 / (b * b);
        let curvature = [[0.0, mixed], [mixed, 2.0 * a / (b * b * b)]];
        for i in 0..2 {
            for j in 0..2 {
                hessian[i][j] += second * slope[i] * slope[j] + first * curvature[i][j];
            }
        }
        hessian
    }

    fn twist(&self, sigma: &[f64; 2], gradient: &[f64; 2], i: usize, j: usize) -> f64 {
        self.density.twist(sigma, gradient, i, j)
    }
}
