//! How much of the negative curvature is removed: a schedule.

use super::settings::Projection;

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

/// Steps to wait after a failure at most. Each failure doubles the wait: where the true Hessian stays indefinite, half of all
/// factorizations would fail otherwise.
const MOST_PATIENCE: u32 = 16;

/// What ω is multiplied by when it falls: five steps from 1 are enough for the true Hessian, and a step too far costs no more
/// than a factorization.
const LOWER: f64 = 0.25;

/// An ω that would fall below a thousandth becomes 0: what is removed then no longer changes the step, but keeps convergence from
/// being quadratic.
const LEAST_LOWERED: f64 = 4e-3;

/// After a short step ω is multiplied by this, which takes one fall back, and raised to the other at least, since 0 would stay 0.
const RAISE_AFTER_SHORT: f64 = 4.0;
const LEAST_AFTER_SHORT: f64 = 0.05;

/// The same after a factorization that failed. It was wasted, so ω rises by more than one fall.
const RAISE_AFTER_INDEFINITE: f64 = 8.0;
const LEAST_AFTER_INDEFINITE: f64 = 0.02;

/// Steps longer than this share of the direction say that the model is good, those shorter than the other that it is bad.
const LONG: f64 = 0.9;
const SHORT: f64 = 0.5;

/// Gains below this share of the energy make the end slow.
const SLOW: f64 = 0.01;

/// Is the model good and the end slow?
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

    /// The factor of negative eigenvalues.
    pub fn tau(&self) -> f64 {
        1.0 - self.omega
    }

    /// After a step: nearly full ones that gain less than 1 % mean that the model is good and the end slow, so ω falls;
    /// short ones that the model is bad.
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

    /// After a factorization that several directions came from: ω falls if none of them met negative curvature of the true
    /// Hessian and the last gained little.
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

    /// After a factorization that failed: false if the matrix was already the most definite one.
    pub fn after_indefinite(&mut self) -> bool {
        let exhausted = self.omega >= 1.0;
        self.wait = self.patience;
        self.patience = (2 * self.patience).min(MOST_PATIENCE);
        self.omega = (RAISE_AFTER_INDEFINITE * self.omega).clamp(LEAST_AFTER_INDEFINITE, 1.0);
        !exhausted
    }

    /// After a direction along which no step helped: false if it came from the most definite matrix.
    pub fn after_useless_direction(&mut self) -> bool {
        let exhausted = self.omega >= 1.0;
        self.omega = 1.0;
        !exhausted
    }
}
