//! Most isometric parameterizations.

use super::Density;
use crate::numerics::square::Matrix;

/// Conformal distortion that is infinite at an inversion.
///
/// ```text
/// ψ = Σᵢ σᵢ² / (D Δ^{2/D})     Δ = Πσ = det J     (in the plane ½(σ₁/σ₂ + σ₂/σ₁))
/// ```
/// Minimum 1, at similarities: it is independent of scale. Dimensionless; the sum over a mesh is weighted by rest size.
/// Domain det J > 0, +∞ outside. From: Hormann and Greiner 2000, MIPS. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mips;

/// Conformal and size distortion in one exponential, which emphasizes the worst elements.
///
/// ```text
/// ψ = exp(½ s (m + ½(Δ + Δ⁻¹)))     m the density of [`Mips`], Δ = det J
/// ```
/// Minimum eˢ, at rotations. Dimensionless; the sum over a mesh is weighted by rest size. Domain det J > 0, +∞ outside.
/// From: Fu, Liu, Guo 2015, Computing Locally Injective Mappings by Advanced MIPS, with α = ½. Tests:
/// `energy::taylor_*`.
#[derive(Clone, Copy, Debug)]
pub struct Amips {
    /// Exponent s: the larger, the more the worst elements weigh.
    pub s: f64,
}

impl<const D: usize> Density<D> for Mips {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if sigma[D - 1] <= 0.0 {
            return f64::INFINITY;
        }
        sigma.iter().map(|s| s * s).sum::<f64>() * scale(sigma)
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let (n, q) = (norm_squared(sigma), scale(sigma));
        sigma.map(|s| 2.0 * q * (s - n / (D as f64 * s)))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let (n, q) = (norm_squared(sigma), scale(sigma));
        let d = D as f64;
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            for (j, t) in sigma.iter().enumerate() {
                hessian[i][j] = 4.0 * q / d * (n / (d * s * t) - s / t - t / s);
            }
            hessian[i][i] += 2.0 * q * (1.0 + n / (d * s * s));
        }
        hessian
    }
}

fn norm_squared<const D: usize>(sigma: &[f64; D]) -> f64 {
    sigma.iter().map(|s| s * s).sum()
}

/// Returns Δ^{−2/D}/D.
fn scale<const D: usize>(sigma: &[f64; D]) -> f64 {
    sigma.iter().product::<f64>().powf(-2.0 / D as f64) / D as f64
}

impl Amips {
    /// Returns the exponent, its gradient and its Hessian.
    fn exponent<const D: usize>(self, sigma: &[f64; D]) -> (f64, [f64; D], Matrix<D>) {
        let det: f64 = sigma.iter().product();
        let (first, second) = (0.5 * (1.0 - 1.0 / (det * det)), 1.0 / (det * det * det));
        let half = 0.5 * self.s;
        let value = half * (Mips.value(sigma) + 0.5 * (det + 1.0 / det));
        let mut gradient = Mips.gradient(sigma);
        let mut hessian = Mips.hessian(sigma);
        for i in 0..D {
            gradient[i] = half * (gradient[i] + first * det / sigma[i]);
            for j in 0..D {
                let product = sigma[i] * sigma[j];
                let mixed = if i == j { 0.0 } else { first * det / product };
                hessian[i][j] = half * (hessian[i][j] + second * det * det / product + mixed);
            }
        }
        (value, gradient, hessian)
    }
}

impl<const D: usize> Density<D> for Amips {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if sigma[D - 1] <= 0.0 {
            return f64::INFINITY;
        }
        self.exponent(sigma).0.exp()
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let (value, gradient, _) = self.exponent(sigma);
        gradient.map(|g| value.exp() * g)
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let (value, gradient, mut hessian) = self.exponent(sigma);
        for i in 0..D {
            for j in 0..D {
                hessian[i][j] = value.exp() * (hessian[i][j] + gradient[i] * gradient[j]);
            }
        }
        hessian
    }
}
