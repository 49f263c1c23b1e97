//! Newton's direction, from a matrix that is made positive definite.

use super::objective::Objective;
use super::relaxation::Relaxation;
use crate::numerics::cholesky::NotPositiveDefinite;

/// Writes −H⁻¹g to `direction` and returns the Newton decrement; `None` as in [`once_definite`].
pub(super) fn newton_direction(
    objective: &mut Objective,
    x: &[f64],
    relaxation: &mut Relaxation,
    direction: &mut [f64],
    factorizations: &mut usize,
) -> Option<f64> {
    let solved = |objective: &mut Objective| objective.newton_direction(direction);
    once_definite(objective, x, relaxation, factorizations, solved)
}

/// Factors the Hessian at `x` by `factored`, removing more and more of its negative curvature until that succeeds.
/// Returns `None` if it fails even with all of it removed, which happens only when derivatives overflow.
pub(super) fn once_definite<T>(
    objective: &mut Objective,
    x: &[f64],
    relaxation: &mut Relaxation,
    factorizations: &mut usize,
    mut factored: impl FnMut(&mut Objective) -> Result<T, NotPositiveDefinite>,
) -> Option<T> {
    loop {
        objective.linearize(x, relaxation.tau());
        *factorizations += 1;
        if let Ok(found) = factored(objective) {
            return Some(found);
        }
        if !relaxation.after_indefinite() {
            return None;
        }
    }
}
