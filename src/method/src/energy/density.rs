//! The interfaces of a density, for one element and for many, and of a barrier.

use crate::numerics::square::Matrix;
use std::fmt;

/// An energy per rest size as a function ψ of the signed singular values σ₁ ≥ … ≥ |σ_D| of the Jacobian.
///
/// Three functions make an energy: gradient, Hessian and its projection in the coordinates of the vertices follow from
/// them. ψ must be symmetric in its arguments.
pub trait Density<const D: usize>: Send + Sync {
    /// Returns the bound of det J = Πσ above which ψ is finite; −∞ if it is finite everywhere.
    fn floor(&self) -> f64;

    /// Returns ψ(σ), +∞ outside the domain.
    fn value(&self, sigma: &[f64; D]) -> f64;

    /// Returns ∂ψ/∂σᵢ.
    fn gradient(&self, sigma: &[f64; D]) -> [f64; D];

    /// Returns ∂²ψ/∂σᵢ∂σⱼ.
    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D>;

    /// Returns gradient and Hessian. A density that computes both at once overrides this.
    fn derivatives(&self, sigma: &[f64; D]) -> ([f64; D], Matrix<D>) {
        (self.gradient(sigma), self.hessian(sigma))
    }

    /// Returns the functions that take all elements in one call, if the density has such.
    fn batch(&self) -> Option<&dyn DensityBatch<D>> {
        None
    }

    /// Returns the curvature against a rotation in the plane of the axes i and j, (ψᵢ + ψⱼ)/(σᵢ + σⱼ), given the
    /// gradient.
    ///
    /// Override this if the quotient can be computed without a division, as in [`FoldoverFree`](super::FoldoverFree),
    /// or if the density minimizes a model other than its own Hessian, as [`FrozenArap`](super::FrozenArap) does.
    fn twist(&self, sigma: &[f64; D], gradient: &[f64; D], i: usize, j: usize) -> f64 {
        // Where two singular values cancel a rotation has no axis; rounding of σ is of this relative size.
        (gradient[i] + gradient[j])
            / (sigma[i] + sigma[j])
                .max(1e-8 * sigma[0])
                .max(f64::MIN_POSITIVE)
    }
}

/// ψ(σ) of many elements, and its derivatives, as in [`Density`]. Each method returns one item per element.
pub trait DensityBatch<const D: usize>: Send + Sync {
    /// Returns ψ, +∞ outside the domain.
    fn values(&self, sigmas: &[[f64; D]]) -> Vec<f64>;

    /// Returns ∂ψ/∂σᵢ.
    fn gradients(&self, sigmas: &[[f64; D]]) -> Vec<[f64; D]>;

    /// Returns ∂²ψ/∂σᵢ∂σⱼ.
    fn hessians(&self, sigmas: &[[f64; D]]) -> Vec<Matrix<D>>;
}

/// A function φ of an element's size, det J, added to the density's share before the projection.
pub trait Guard: Send + Sync {
    /// Returns the bound of det J above which φ is finite; −∞ if it is finite everywhere.
    fn floor(&self, rest_size: f64) -> f64;

    /// Returns φ(det J) of an element, not weighted by its size; +∞ at and below the floor.
    fn value(&self, det: f64, rest_size: f64) -> f64;

    /// Returns φ′ and φ″ at a det J above the floor.
    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2];
}

/// So that options that hold a density can be printed.
impl<const D: usize> fmt::Debug for dyn Density<D> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Density")
            .field("floor", &self.floor())
            .finish_non_exhaustive()
    }
}

/// Distance of a density's value at half the size from that at rest, relative to it, below which sizes do not matter.
const SAME_VALUE: f64 = 1e-9;

/// Returns whether ψ prefers a size: conformal energies are the same for all similarities, so nothing but a barrier or
/// fixed vertices keeps their maps from collapsing.
pub fn prefers_a_size<const D: usize>(density: &dyn Density<D>) -> bool {
    let [half, rest] = [0.5, 1.0].map(|sigma| density.value(&[sigma; D]));
    (half - rest).abs() > SAME_VALUE * rest.abs()
}

// No density.

/// ψ = 0: for a barrier alone, next to an energy that is not a sum over elements. Domain: every J.
#[derive(Clone, Copy, Debug, Default)]
pub struct Zero;

impl<const D: usize> Density<D> for Zero {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, _: &[f64; D]) -> f64 {
        0.0
    }

    fn gradient(&self, _: &[f64; D]) -> [f64; D] {
        [0.0; D]
    }

    fn hessian(&self, _: &[f64; D]) -> Matrix<D> {
        [[0.0; D]; D]
    }
}
