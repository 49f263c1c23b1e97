//! Green's strain and St. Venant–Kirchhoff.

use super::Density;
use crate::numerics::square::Matrix;

/// The squared norm of Green's strain.
///
/// ```text
/// ψ = Σᵢ (σᵢ² − 1)² = ‖JᵀJ − I‖²
/// ```
/// Minimum 0, at rotations and reflections. Dimensionless. The paper sums it over the elements without a weight: set
/// the weight of the rest shapes to 1 for that. Domain: every J. From: Schüller et al. 2013, section 4. Tests:
/// `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Green;

impl<const D: usize> Density<D> for Green {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        sigma.iter().map(|s| (s * s - 1.0).powi(2)).sum()
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        sigma.map(|s| 4.0 * s * (s * s - 1.0))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            hessian[i][i] = 12.0 * s * s - 4.0;
        }
        hessian
    }
}

/// The St. Venant–Kirchhoff material: Green's strain with Lamé parameters.
///
/// ```text
/// ψ = μ Σᵢ Eᵢ² + ½ λ (Σᵢ Eᵢ)²     Eᵢ = ½(σᵢ² − 1)
/// ```
/// Minimum 0, at rotations and reflections. Unit of the parameters; the sum over a mesh is weighted by rest size.
/// Domain: every J. From: Ciarlet 1988, Mathematical Elasticity. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug)]
pub struct StVenantKirchhoff {
    /// The first Lamé parameter λ ≥ 0.
    pub lambda: f64,
    /// The second Lamé parameter μ > 0, the shear modulus.
    pub mu: f64,
}

/// Returns Eᵢ.
fn strain<const D: usize>(sigma: &[f64; D]) -> [f64; D] {
    sigma.map(|s| 0.5 * (s * s - 1.0))
}

impl<const D: usize> Density<D> for StVenantKirchhoff {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        let strain = strain(sigma);
        let trace: f64 = strain.iter().sum();
        self.mu * strain.iter().map(|e| e * e).sum::<f64>() + 0.5 * self.lambda * trace * trace
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let strain = strain(sigma);
        let pressure = self.lambda * strain.iter().sum::<f64>();
        std::array::from_fn(|i| sigma[i] * (2.0 * self.mu * strain[i] + pressure))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let strain = strain(sigma);
        let pressure = self.lambda * strain.iter().sum::<f64>();
        let mut hessian = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                hessian[i][j] = self.lambda * sigma[i] * sigma[j];
            }
            hessian[i][i] += 2.0 * self.mu * (strain[i] + sigma[i] * sigma[i]) + pressure;
        }
        hessian
    }
}
