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

/// Is the model good and the end slow?
pub fn is_settling(length: f64, relative_decrease: f64) -> bool {
    length > 0.9 && relative_decrease < 0.01
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
        } else if length < 0.5 {
            self.omega = (4.0 * self.omega).clamp(0.05, 1.0);
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
        self.omega = if self.omega < 4e-3 {
            0.0
        } else {
            0.25 * self.omega
        };
    }

    /// After a factorization that failed: false if the matrix was already the most definite one.
    pub fn after_indefinite(&mut self) -> bool {
        let exhausted = self.omega >= 1.0;
        self.wait = self.patience;
        self.patience = (2 * self.patience).min(MOST_PATIENCE);
        self.omega = (8.0 * self.omega).clamp(0.02, 1.0);
        !exhausted
    }

    /// After a direction along which no step helped: false if it came from the most definite matrix.
    pub fn after_useless_direction(&mut self) -> bool {
        let exhausted = self.omega >= 1.0;
        self.omega = 1.0;
        !exhausted
    }
}
