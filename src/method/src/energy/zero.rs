//! No density.

use super::Density;
use crate::numerics::square::Matrix;

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
