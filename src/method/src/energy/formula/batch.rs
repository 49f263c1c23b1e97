//! Densities that take all elements in one call.
//!
//! A call of an interpreter costs more than an element does: its functions take arrays ([`DensityBatch`]).
//! [`Batched`] makes a [`Density`] of them, checked like a formula.

use super::check::{check, is_finite_inverted};
use super::parser::FormulaError;
use crate::energy::{Density, DensityBatch};
use crate::numerics::square::Matrix;
use std::sync::Arc;

/// A custom density of functions on arrays.
///
/// Minimum at the identity, in its neighborhood. Domain: where ψ is finite, and only det J > 0 where it or a derivative
/// is not finite at σ_D = 0 or below; the functions are then never called with such elements. Clones share the
/// functions. Tests: `formula::a_batch_is_the_density_that_it_computes`.
#[derive(Clone)]
pub struct Batched<const D: usize> {
    functions: Arc<dyn DensityBatch<D>>,
    floor: f64,
}

impl<const D: usize> Batched<D> {
    /// Creates the density, and checks that it is an energy of deformation.
    pub fn new(functions: impl DensityBatch<D> + 'static) -> Result<Self, FormulaError> {
        let mut batched = Self {
            functions: Arc::new(functions),
            floor: f64::NEG_INFINITY,
        };
        check(&batched)?;
        if !is_finite_inverted(&batched) {
            batched.floor = 0.0;
        }
        Ok(batched)
    }
}

impl<const D: usize> DensityBatch<D> for Batched<D> {
    fn values(&self, sigmas: &[[f64; D]]) -> Vec<f64> {
        let is_inside = |sigma: &[f64; D]| sigma[D - 1] > self.floor;
        if sigmas.iter().all(is_inside) {
            return self.functions.values(sigmas);
        }
        let inside: Vec<_> = sigmas.iter().copied().filter(is_inside).collect();
        let mut values = self.functions.values(&inside).into_iter();
        let of = |sigma| is_inside(sigma).then(|| values.next()).flatten();
        (sigmas.iter().map(of))
            .map(|value| value.unwrap_or(f64::INFINITY))
            .collect()
    }

    fn gradients(&self, sigmas: &[[f64; D]]) -> Vec<[f64; D]> {
        self.functions.gradients(sigmas)
    }

    fn hessians(&self, sigmas: &[[f64; D]]) -> Vec<Matrix<D>> {
        self.functions.hessians(sigmas)
    }
}

impl<const D: usize> Density<D> for Batched<D> {
    fn floor(&self) -> f64 {
        self.floor
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        self.values(&[*sigma])[0]
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        self.gradients(&[*sigma])[0]
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        self.hessians(&[*sigma])[0]
    }

    fn batch(&self) -> Option<&dyn DensityBatch<D>> {
        Some(self)
    }
}
