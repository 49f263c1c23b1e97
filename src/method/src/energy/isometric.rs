//! Symmetric Dirichlet.

use super::Density;
use crate::numerics::square::{Matrix, identity};

/// The Dirichlet energies of the map and of its inverse.
///
/// ```text
/// ψ = Σᵢ (σᵢ² + σᵢ⁻²) = ‖J‖² + ‖J⁻¹‖²
/// ```
/// Minimum 2D, at rotations: 4 in the plane, 6 in space. Dimensionless; the sum over a mesh is an area or volume. Domain
/// det J > 0, +∞ outside: it is its own barrier. From: Smith and Schaefer 2015, Bijective Parameterization with Free
/// Boundaries. Tests: `energy::taylor_*`, `energy::minima_are_at_rotations`.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymmetricDirichlet;

impl<const D: usize> Density<D> for SymmetricDirichlet {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if sigma[D - 1] > 0.0 {
            sigma.iter().map(|s| s * s + 1.0 / (s * s)).sum()
        } else {
            f64::INFINITY
        }
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        sigma.map(|s| 2.0 * (s - 1.0 / (s * s * s)))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            hessian[i][i] = 2.0 + 6.0 / (s * s * s * s);
        }
        hessian
    }
}

// As-rigid-as-possible.

/// The squared distance of J to the nearest rotation.
///
/// ```text
/// ψ = ½ Σᵢ (σᵢ − 1)² = ½‖J − R‖²
/// ```
/// Minimum 0, at rotations; the last σ is signed, so a reflection of the plane costs 2. Without unit; the sum over a mesh
/// is an area or volume. Domain: every J; not differentiable where the two smallest σ cancel.
/// From: Liu et al. 2008, A Local/Global Approach to Mesh Parameterization. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arap;

impl<const D: usize> Density<D> for Arap {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        0.5 * sigma.iter().map(|s| (s - 1.0) * (s - 1.0)).sum::<f64>()
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        sigma.map(|s| s - 1.0)
    }

    fn hessian(&self, _: &[f64; D]) -> Matrix<D> {
        identity(1.0)
    }
}

/// [`Arap`] with the rotation of each element frozen in its quadratic model, as the paper solves it: value and gradient
/// are those of ARAP, the matrix is the constant Laplacian of ½‖J − R‖² for the current R.
///
/// The model lies above the energy, so its steps descend, but it converges linearly with a long tail. From: Schüller et
/// al. 2013, section 4. Tests: `energy::frozen_arap_is_a_majorizer`.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrozenArap;

impl<const D: usize> Density<D> for FrozenArap {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        Arap.value(sigma)
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        Arap.gradient(sigma)
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        Arap.hessian(sigma)
    }

    fn twist(&self, _: &[f64; D], _: &[f64; D], _: usize, _: usize) -> f64 {
        1.0
    }
}

// Green's strain and St. Venant–Kirchhoff.

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

// The compressible Neo-Hookean material.

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
