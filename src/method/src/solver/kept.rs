//! A factorization that serves several advances of handles.

use super::objective::Objective;
use super::path::Rotation;
use super::travel::Travel;
use crate::numerics::square::{Matrix, Square};

/// Flops beyond which a factorization takes longer than everything else in a frame, about 5 ms.
const COSTLY: f64 = 1e8;

/// Most advances per factorization.
const MOST_ADVANCES: usize = 24;

/// Largest gradient after an advance, as a share of its right-hand side; beyond it the factorization is renewed.
const WORN: f64 = 0.5;

/// Use of a factorization since it was made.
pub(super) struct Kept {
    advances: usize,
    /// Norm of the last right-hand side.
    norm: f64,
}

impl Kept {
    /// Keeps the factorization that an objective has just made; returns `None` if making one is cheap.
    pub fn of(objective: &Objective) -> Option<Self> {
        let is_costly = objective.work().is_some_and(|work| work.flops > COSTLY);
        is_costly.then_some(Self {
            advances: 0,
            norm: 0.0,
        })
    }

    /// Moves the handles to their targets while the other vertices follow. Returns `None`, without moving anything, if
    /// this needs a new factorization.
    ///
    /// This is a step of the modified Newton method. It leaves little of the gradient while the matrix is a good
    /// approximation, which is checked before the next step. Cost: one gradient, one solve, one largest step.
    pub fn advance<const D: usize>(
        self,
        travel: &mut Travel<D>,
        objective: &mut Objective,
        x: &mut [f64],
    ) -> Option<Self>
    where
        Matrix<D>: Square<D> + Rotation<D>,
    {
        // The strength of points is measured by assembling a Hessian, which the factorization then does not belong to.
        let may_serve = self.advances < MOST_ADVANCES && travel.points.is_empty();
        if !may_serve || !objective.renew_gradient(x) {
            return None;
        }
        let left = objective
            .gradient()
            .iter()
            .map(|g| g * g)
            .sum::<f64>()
            .sqrt();
        if self.advances > 0 && left > WORN * self.norm {
            return None;
        }
        Some(Self {
            norm: travel.step_with_kept(objective, x)?,
            advances: self.advances + 1,
        })
    }
}
