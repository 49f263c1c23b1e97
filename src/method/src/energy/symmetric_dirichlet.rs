//! Symmetric Dirichlet.

use super::Density;
use crate::numerics::square::Matrix;

/// The Dirichlet energies of the map and of its inverse.
///
/// ```text
/// ψ = ½ Σᵢ (σᵢ² + σᵢ⁻²)
/// ```
/// Minimum D, at rotations. Dimensionless; the sum over a mesh is an area or volume. Domain det J > 0, +∞ outside: it
/// is its own barrier. From: Smith and Schaefer 2015, Bijective Parameterization with Free Boundaries. (Reports and
/// bounds quote it without the factor ½, with minimum 4 in the plane.) Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymmetricDirichlet;

impl<const D: usize> Density<D> for SymmetricDirichlet {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if sigma[D - 1] > 0.0 {
            0.5 * sigma.iter().map(|s| s * s + 1.0 / (s * s)).sum::<f64>()
        } else {
            f64::INFINITY
        }
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        sigma.map(|s| s - 1.0 / (s * s * s))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            hessian[i][i] = 1.0 + 3.0 / (s * s * s * s);
        }
        hessian
    }
}
