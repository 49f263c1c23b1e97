//! The paper's iteration: Newton with a shift that grows until the matrix factors, and handles as soft constraints.

use super::objective::Objective;
use super::settings::{Control, Iterate, Status, Summary, Taken, Watch};

/// Parameters that the paper and its authors' code leave adjustable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevenbergSettings {
    /// Most steps.
    pub max_iterations: usize,
    /// Ends at a step shorter than this.
    pub min_step: f64,
    /// Largest ‖Cx − d‖² at which the constraints count as met.
    pub tolerance: f64,
    /// Enables targets that retreat toward the present positions while the shift is large, equations 10 and 11.
    pub substepping: bool,
    /// Lets α grow so that the constraints keep up with the energy, equations 12 and 13.
    pub alpha_update: bool,
    /// Initial α.
    pub alpha: f64,
    /// r: wanted ratio of the constraints to the energy.
    pub alpha_ratio: f64,
}

impl Default for LevenbergSettings {
    /// Returns the values of the authors' code.
    fn default() -> Self {
        Self {
            max_iterations: 5000,
            min_step: 1e-15,
            tolerance: 1e-8,
            substepping: true,
            alpha_update: true,
            alpha: 1e8,
            alpha_ratio: 1000.0,
        }
    }
}

/// t of the paper: largest α.
const LARGEST_ALPHA: f64 = 1e16;
/// Smallest α that an update gives.
const LEAST_ALPHA: f64 = 1e3;
/// Smallest σ of the authors' code.
const LEAST_SIGMA: f64 = 1e-21;
/// Shifts μ of the authors' code: the first, the least after a success, and the one at which they give up.
const FIRST_MU: f64 = 0.1;
const LEAST_MU: f64 = 1e-5;
const LARGEST_MU: f64 = 1e17;

/// Minimizes energy + α‖Cx − d‖² of an [`Objective::constrained`] as in section 3.2 of the paper, from an `x` inside
/// the domain; d are the targets with which it was made.
///
/// The Hessian is not projected: once it fails to factor, μ is added to its diagonal, ten times as much at each further
/// failure. A first try that succeeds resets μ to the least value, a second divides it by ten. The step σ starts from
/// the last one, doubles on success, and halves until the function falls and the point is inside the domain. Unlike in
/// the paper, no step is so long that an element would invert on the way. Every iterate is inside. [`Iterate::mu`] is μ
/// after the step: the next targets retreat by it, and a factorization that fails tries it first. From: Schüller et al.
/// 2013, section 3.2, with the constants of the authors' code; a shift replaces the one before instead of adding to it.
pub fn levenberg(
    objective: &mut Objective,
    x: &mut [f64],
    settings: &LevenbergSettings,
    watch: &dyn Watch,
) -> Summary {
    let destinations = objective
        .constraints()
        .map_or(Vec::new(), |c| c.targets.clone());
    let residual = |objective: &Objective, x: &[f64]| {
        objective
            .constraints()
            .map_or(0.0, |c| c.residual(x, &destinations))
    };
    let mut run = LevenbergRun::new(objective.energy(x), x.len(), settings.alpha);
    if !run.summary.energy_first.is_finite() {
        return run.summary;
    }
    if objective.show(x, &run.summary, Taken::default(), watch) == Control::Finish {
        return run.summary.ended(Status::Stopped);
    }
    while run.summary.iterations < settings.max_iterations {
        // Let the targets retreat while the shift is large.
        let share = if settings.substepping {
            1.0 / (1.0 + run.mu * run.mu)
        } else {
            1.0
        };
        run.aim(objective, x, &destinations, share);
        // Take a step.
        let Some(length) = run.step(objective, x) else {
            return run.summary.ended(Status::Stalled);
        };
        // Report it, and keep the constraints as strong as the energy.
        let gap = residual(objective, x);
        let taken = Taken {
            mu: run.mu,
            sigma: run.sigma,
        };
        let iterate = Iterate {
            residual: gap,
            ..objective.iterate(x, &run.summary, taken)
        };
        if settings.alpha_update {
            run.alpha = updated_alpha(run.alpha, run.summary.energy_last, gap, settings);
        }
        watch.positions(&iterate, x);
        if watch.iterate(&iterate) == Control::Finish {
            return run.summary.ended(Status::Stopped);
        }
        // End when the steps become negligible.
        if length < settings.min_step {
            let is_met = gap <= settings.tolerance;
            return run.summary.ended(if is_met {
                Status::Converged
            } else {
                Status::TargetsUnreachable
            });
        }
    }
    run.summary.ended(Status::IterationLimit)
}

struct LevenbergRun {
    summary: Summary,
    mu: f64,
    sigma: f64,
    alpha: f64,
    direction: Vec<f64>,
    trial: Vec<f64>,
}

impl LevenbergRun {
    fn new(energy: f64, n: usize, alpha: f64) -> Self {
        Self {
            summary: Summary::at_start(energy),
            mu: FIRST_MU,
            sigma: 1.0,
            alpha,
            direction: vec![0.0; n],
            trial: vec![0.0; n],
        }
    }

    /// Sets the targets to this share of the straight path from the constrained points to their destinations.
    fn aim(&self, objective: &mut Objective, x: &[f64], destinations: &[f64], share: f64) {
        let targets: Option<Vec<f64>> = objective.constraints().map(|constraints| {
            let places = constraints.places(x).zip(destinations);
            places
                .map(|(place, d)| place + share * (d - place))
                .collect()
        });
        if let Some(targets) = targets {
            objective.set_constraints(self.alpha, &targets);
        }
    }

    /// Takes one step and returns its length; `None` if no shift gives a direction.
    fn step(&mut self, objective: &mut Objective, x: &mut [f64]) -> Option<f64> {
        objective.linearize(x, 1.0);
        let mut shifted = 0.0;
        let mut tries = 0;
        loop {
            self.summary.factorizations += 1;
            tries += 1;
            if objective.newton_direction(&mut self.direction).is_ok() {
                break;
            }
            if self.mu > LARGEST_MU {
                return None;
            }
            objective.shift_diagonal(self.mu - shifted);
            shifted = self.mu;
            self.mu *= 10.0;
        }
        self.mu = match tries {
            1 => LEAST_MU,
            2 => 0.01 * self.mu,
            _ => 0.1 * self.mu,
        };
        self.search(objective, x);
        self.summary.iterations += 1;
        self.summary.energy_last = objective.energy(x);
        Some(self.sigma * self.direction.iter().map(|d| d * d).sum::<f64>().sqrt())
    }

    /// Halves or doubles σ until the function falls; leaves the point unchanged where no step of a relevant length
    /// helps. Rejects steps that would leave the domain and enter it again.
    fn search(&mut self, objective: &Objective, x: &mut [f64]) {
        let before = objective.value(x);
        let largest = objective.largest_step(x, &self.direction);
        let mut sigma = self.sigma;
        let mut is_first = true;
        while sigma > LEAST_SIGMA {
            for ((trial, x), d) in self.trial.iter_mut().zip(&*x).zip(&self.direction) {
                *trial = x + sigma * d;
            }
            if sigma < largest && objective.value(&self.trial) < before {
                x.copy_from_slice(&self.trial);
                self.sigma = sigma;
                if is_first {
                    self.sigma = (2.0 * sigma).min(1.0);
                }
                return;
            }
            sigma *= 0.5;
            is_first = false;
        }
        self.sigma = LEAST_SIGMA;
    }
}

/// Returns r·|E|/‖Cx − d‖², clamped and never falling (equations 12 and 13).
fn updated_alpha(alpha: f64, energy: f64, residual: f64, settings: &LevenbergSettings) -> f64 {
    let wanted = settings.alpha_ratio * energy.abs() / residual;
    alpha.max(wanted.clamp(LEAST_ALPHA, LARGEST_ALPHA))
}
