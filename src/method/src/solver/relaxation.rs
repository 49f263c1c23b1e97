//! Schedule of the negative curvature that is removed from the Hessian.

use super::objective::Objective;
use super::settings::Projection;
use crate::numerics::cholesky::NotPositiveDefinite;

/// ω in [0, 1]: negative eigenvalues of a triangle's Hessian are multiplied by τ = 1 − ω. With ω = 1 the matrix is
/// positive semidefinite and the step cautious, with ω = 0 it is the true Hessian and convergence quadratic.
#[derive(Clone, Copy, Debug)]
pub struct Relaxation {
    omega: f64,
    projection: Projection,
    /// Steps before ω may fall again.
    wait: u32,
    /// Steps to wait after the next failure.
    patience: u32,
}

/// Most steps to wait after a failure. Each failure doubles the wait: otherwise half of all factorizations would fail
/// where the true Hessian stays indefinite.
const MOST_PATIENCE: u32 = 16;

/// Factor by which ω falls: five steps lead from 1 to the true Hessian, and a step too far costs only one
/// factorization.
const LOWER: f64 = 0.25;

/// Smallest ω that still falls by that factor; a smaller one becomes 0, since the removed curvature no longer changes
/// the step but keeps convergence from being quadratic. Just above 4⁻⁴, so that the fifth fall gives 0.
const LEAST_LOWERED: f64 = 4e-3;

/// Factor by which ω rises after a short step, which takes back one fall, and its least value then, since 0 would stay
/// 0.
const RAISE_AFTER_SHORT: f64 = 4.0;
const LEAST_AFTER_SHORT: f64 = 0.05;

/// Factor and least value after a factorization that failed. It was wasted, so ω rises by more than one fall.
const RAISE_AFTER_INDEFINITE: f64 = 8.0;
const LEAST_AFTER_INDEFINITE: f64 = 0.02;

/// Steps longer than the first share of the direction show that the model is good, those shorter than the second that
/// it is bad. On a prototype, looser bounds (0.6 and 0.3, with 0.05 for [`SLOW`]) took up to 15 % more factorizations.
const LONG: f64 = 0.9;
const SHORT: f64 = 0.5;

/// Relative decrease of the energy below which convergence is slow.
const SLOW: f64 = 0.01;

/// Returns whether the model is good but convergence slow.
pub fn is_settling(length: f64, relative_decrease: f64) -> bool {
    length > LONG && relative_decrease < SLOW
}

impl Relaxation {
    pub fn new(projection: Projection) -> Self {
        Self {
            omega: 1.0,
            projection,
            wait: 0,
            patience: 1,
        }
    }

    /// Returns the factor of negative eigenvalues.
    pub fn tau(&self) -> f64 {
        1.0 - self.omega
    }

    /// Adapts ω to a step: nearly full ones that gain less than 1 % mean that the model is good and convergence slow,
    /// so ω falls; after short ones it rises.
    pub fn after_step(&mut self, length: f64, relative_decrease: f64) {
        if self.projection == Projection::PositiveSemidefinite {
            return;
        }
        if self.wait > 0 {
            self.wait -= 1;
        } else if is_settling(length, relative_decrease) {
            self.lower();
        } else if length < SHORT {
            self.omega = (RAISE_AFTER_SHORT * self.omega).clamp(LEAST_AFTER_SHORT, 1.0);
        }
    }

    /// Adapts ω after a factorization that served several directions: ω falls if they met no negative curvature of the
    /// true Hessian and the last gained little.
    pub fn after_service(&mut self, met_negative: bool, relative_decrease: f64) {
        if self.wait > 0 {
            self.wait -= 1;
        } else if !met_negative && is_settling(1.0, relative_decrease) {
            self.lower();
        }
    }

    fn lower(&mut self) {
        self.omega = if self.omega < LEAST_LOWERED {
            0.0
        } else {
            LOWER * self.omega
        };
    }

    /// Raises ω after a factorization that failed; returns `false` if the matrix was already the most definite one.
    pub fn after_indefinite(&mut self) -> bool {
        let exhausted = self.omega >= 1.0;
        self.wait = self.patience;
        self.patience = (2 * self.patience).min(MOST_PATIENCE);
        self.omega = (RAISE_AFTER_INDEFINITE * self.omega).clamp(LEAST_AFTER_INDEFINITE, 1.0);
        !exhausted
    }

    /// Sets ω to 1 after a direction along which no step helped; returns `false` if it was 1 already.
    pub fn after_useless_direction(&mut self) -> bool {
        let exhausted = self.omega >= 1.0;
        self.omega = 1.0;
        !exhausted
    }
}

// Newton's direction, from a matrix that is made positive definite.

/// Writes −H⁻¹g to `direction` and returns the Newton decrement; `None` as in [`once_definite`].
pub(super) fn newton_direction(
    objective: &mut Objective,
    x: &[f64],
    relaxation: &mut Relaxation,
    direction: &mut [f64],
    factorizations: &mut usize,
) -> Option<f64> {
    once_definite(
        objective,
        x,
        relaxation,
        factorizations,
        |objective: &mut Objective| objective.newton_direction(direction),
    )
}

/// Factors the Hessian at `x` by `factored`, removing more and more of its negative curvature until that succeeds, and
/// regularizing it at last. Returns `None` if even that fails, which happens only when derivatives overflow.
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
        if !relaxation.after_indefinite() && !objective.regularize() {
            return None;
        }
    }
}

// Line search.

/// An accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Length, as a share of the direction.
    pub length: f64,
    /// Energy after the step.
    pub energy: f64,
}

/// Start and direction of a line search.
#[derive(Clone, Copy, Debug)]
pub struct LineSearch<'a> {
    /// Start.
    pub x: &'a [f64],
    /// Direction.
    pub direction: &'a [f64],
    /// Energy at the start.
    pub energy: f64,
    /// Slope of the energy along the direction, negative.
    pub slope: f64,
}

/// Share of the distance to the first inversion that a step may take: the triangle that limits it keeps a twentieth of
/// its margin, so that the next direction is not stuck at the barrier.
const SAFETY: f64 = 0.95;

/// Armijo constant: share of the decrease predicted by the slope that a step must reach. The customary value (Nocedal
/// and Wright 2006, section 3.1).
const SUFFICIENT: f64 = 1e-4;

/// Most halvings: a step below 2⁻⁴⁰, about 1e-12, has no relevant effect.
const MAX_HALVINGS: usize = 40;

/// Returns the longest of the steps t, t/2, t/4, … that lowers the energy sufficiently, with its end point in `trial`;
/// t is the smaller of 1 and 0.95 times the largest step inside the domain.
///
/// Returns `None` if no step lowers the energy: it is at rounding, or the direction is useless. Usually takes one
/// evaluation, because the search starts inside the domain.
pub fn line_search(objective: &Objective, search: &LineSearch, trial: &mut [f64]) -> Option<Step> {
    let &LineSearch {
        x,
        direction,
        energy,
        slope,
    } = search;
    let mut length = (SAFETY * objective.largest_step(x, direction)).min(1.0);
    for _ in 0..MAX_HALVINGS {
        for ((trial, x), d) in trial.iter_mut().zip(x).zip(direction) {
            *trial = x + length * d;
        }
        let new_energy = objective.value(trial);
        if new_energy < energy && new_energy <= energy + SUFFICIENT * length * slope {
            return Some(Step {
                length,
                energy: new_energy,
            });
        }
        length *= 0.5;
    }
    None
}
