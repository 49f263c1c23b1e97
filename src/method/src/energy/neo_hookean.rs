//! The compressible Neo-Hookean material.

use super::Density;
use crate::numerics::square::Matrix;

/// Rubber that resists compression without bound.
///
/// ```text
/// ψ = ½ μ (Σᵢ σᵢ² − D) − μ log Δ + ½ λ log² Δ     Δ = Πσ = det J
/// ```
/// Minimum 0, at rotations. Unit: that of the parameters; the sum over a mesh is weighted by rest size. Domain det J >
/// 0, +∞ outside. From: Bonet and Wood 1997, Nonlinear Continuum Mechanics, equation 5.28. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    /// The first Lamé parameter λ ≥ 0.
    pub lambda: f64,
    /// The second Lamé parameter μ > 0, the shear modulus.
    pub mu: f64,
}

impl<const D: usize> Density<D> for NeoHookean {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        let det: f64 = sigma.iter().product();
        if det <= 0.0 {
            return f64::INFINITY;
        }
        let log = det.ln();
        let stretch: f64 = sigma.iter().map(|s| s * s - 1.0).sum();
        0.5 * self.mu * stretch - self.mu * log + 0.5 * self.lambda * log * log
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let log = sigma.iter().product::<f64>().ln();
        sigma.map(|s| self.mu * (s - 1.0 / s) + self.lambda * log / s)
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let log = sigma.iter().product::<f64>().ln();
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            for (j, t) in sigma.iter().enumerate() {
                hessian[i][j] = self.lambda / (s * t);
            }
            hessian[i][i] += self.mu + (self.mu - self.lambda * log) / (s * s);
        }
        hessian
    }
}
