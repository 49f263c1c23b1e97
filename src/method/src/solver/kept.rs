//! A factorization that is kept for several advances of handles.

use super::objective::Objective;
use super::path::Rotation;
use super::travel::Travel;
use crate::numerics::square::{Matrix, Square};

/// A factorization of more operations than this takes longer than all else in a frame, some 5 ms.
const COSTLY: f64 = 1e8;

/// Advances with one factorization at most.
const MOST_ADVANCES: usize = 24;

/// What an advance leaves of the right side of its system, at most: else the factorization has to be renewed.
const WORN: f64 = 0.5;

/// How a factorization has served since it was made.
pub(super) struct Kept {
    advances: usize,
    /// The norm of the last right side.
    norm: f64,
}

impl Kept {
    /// The factorization that an objective has just made, if making it takes long.
    pub fn of(objective: &Objective) -> Option<Self> {
        let is_costly = objective.work().is_some_and(|work| work.flops > COSTLY);
        is_costly.then_some(Self {
            advances: 0,
            norm: 0.0,
        })
    }

    /// Brings the handles to their targets, the other vertices following; `None`, and nothing has moved, if another factorization is
    /// wanted for that.
    ///
    /// This is a step of the modified Newton method. It leaves little of the gradient while the matrix is good, which is looked at
    /// before the next. Cost: one gradient, one solve, one largest step.
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
