//! As-rigid-as-possible.

use super::Density;
use crate::numerics::square::{Matrix, identity};

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
