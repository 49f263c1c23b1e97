//! Settings and results of the solver.

use serde::{Deserialize, Serialize};

/// Stopping criteria and regularization.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Most steps.
    pub max_iterations: usize,
    /// Converged when the decrease predicted by the quadratic model at its minimum (for a Newton step the decrement
    /// −½g·d) is at most this share of the energy, and at least half of the step could be taken.
    pub tolerance: f64,
    /// Treatment of negative curvature.
    pub projection: Projection,
}

impl Settings {
    /// Returns tolerance 1e-4 in at most 200 steps: enough for texture coordinates, and spares large meshes the slow
    /// tail.
    pub fn draft() -> Self {
        Self {
            max_iterations: 200,
            tolerance: 1e-4,
            projection: Projection::TrustRegion,
        }
    }

    /// Returns tolerance 1e-6 in at most 200 steps.
    pub fn normal() -> Self {
        Self {
            tolerance: 1e-6,
            ..Self::draft()
        }
    }

    /// Returns tolerance 1e-9 in at most 1000 steps, for comparisons.
    pub fn exact() -> Self {
        Self {
            max_iterations: 1000,
            tolerance: 1e-9,
            ..Self::draft()
        }
    }

    /// Returns tolerance 1e-6 in at most 5000 steps, for handles.
    pub fn follow() -> Self {
        Self {
            max_iterations: 5000,
            projection: Projection::Relaxed,
            ..Self::normal()
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::draft()
    }
}

/// Treatment of the negative curvature of each triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// Removes it until full steps gain little. From then on the factored matrix serves several directions, each found
    /// on the true Hessian within a trust region.
    #[default]
    TrustRegion,
    /// Removes less and less of it as full steps gain little: for following handles, whose stations take few steps
    /// each.
    Relaxed,
    /// Always removes it: best far from a minimum, slow near one.
    PositiveSemidefinite,
}

/// Outcome of a minimization. The map is valid in every case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// The decrement fell below the tolerance.
    Converged,
    /// No step lowers the energy any further, or the start was outside the domain.
    Stalled,
    /// After [`Settings::max_iterations`].
    IterationLimit,
    /// Handles could not be brought to their targets: the map is the nearest valid one on their way.
    TargetsUnreachable,
    /// The watcher said so.
    Stopped,
}

/// Summary of a minimization.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Summary {
    /// Status at the end.
    pub status: Status,
    /// Steps taken.
    pub iterations: usize,
    /// Matrices factored, failed attempts included.
    pub factorizations: usize,
    /// Energy of the start.
    pub energy_first: f64,
    /// Energy of the result.
    pub energy_last: f64,
}

impl Summary {
    /// Returns the summary of a minimization that has not begun.
    pub fn at_start(energy: f64) -> Self {
        Self {
            status: Status::Stalled,
            iterations: 0,
            factorizations: 0,
            energy_first: energy,
            energy_last: energy,
        }
    }

    pub(super) fn ended(self, status: Status) -> Self {
        Self { status, ..self }
    }

    /// Returns the sum of both, with the status and last energy of `next`.
    #[must_use]
    pub fn followed_by(&self, next: &Self) -> Self {
        Self {
            status: next.status,
            iterations: self.iterations + next.iterations,
            factorizations: self.factorizations + next.factorizations,
            energy_first: self.energy_first,
            energy_last: next.energy_last,
        }
    }

    /// Returns the summary of this minimization and another one of other elements.
    #[must_use]
    pub fn beside(&self, other: &Self) -> Self {
        Self {
            status: match self.status {
                Status::Converged => other.status,
                status => status,
            },
            iterations: self.iterations + other.iterations,
            factorizations: self.factorizations + other.factorizations,
            energy_first: self.energy_first + other.energy_first,
            energy_last: self.energy_last + other.energy_last,
        }
    }
}

// Reports of progress to a watcher, which may end the minimization early.

/// State of the solver after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterate {
    /// 0 for the start, then 1, 2, …
    pub iteration: usize,
    /// Energy with the barrier, without soft constraints; falls each time while no handle moves.
    pub energy: f64,
    /// Share of the energy whose only purpose is to keep elements from inverting.
    pub barrier: f64,
    /// Energy of the soft constraints, α‖Cx − d‖².
    pub constraint: f64,
    /// Smallest ratio of an element's size to its rest size.
    pub smallest: f64,
    /// Shift of the Hessian's diagonal in the step that led here.
    pub mu: f64,
    /// Length of that step as a share of the direction.
    pub sigma: f64,
    /// Strength of the soft constraints in that step.
    pub alpha: f64,
    /// Squared distance of the soft constraints from their targets, ‖Cx − d‖².
    pub residual: f64,
}

/// The step that leads to an iterate; zeros for the start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    /// See [`Iterate::mu`].
    pub mu: f64,
    /// See [`Iterate::sigma`].
    pub sigma: f64,
}

/// Decision of a watcher.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Continue.
    Continue,
    /// End with the present map.
    Finish,
}

/// Observer of iterates, which may end the minimization.
pub trait Watch {
    /// Called with the start and after every step.
    fn iterate(&self, iterate: &Iterate) -> Control;

    /// Called before [`iterate`](Self::iterate) with the positions of that iterate, coordinates one after another.
    fn positions(&self, _iterate: &Iterate, _x: &[f64]) {}
}

impl<F: Fn(&Iterate) -> Control> Watch for F {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self(iterate)
    }
}

/// A watch for a continued minimization, whose iterations are counted from `before`.
pub struct Continued<'a> {
    /// The watcher.
    pub watch: &'a dyn Watch,
    /// Number of iterations before.
    pub before: usize,
}

impl Continued<'_> {
    fn continued(&self, iterate: &Iterate) -> Iterate {
        Iterate {
            iteration: self.before + iterate.iteration,
            ..*iterate
        }
    }
}

impl Watch for Continued<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        self.watch.iterate(&self.continued(iterate))
    }

    fn positions(&self, iterate: &Iterate, x: &[f64]) {
        self.watch.positions(&self.continued(iterate), x);
    }
}

// Pace: the least progress of handles.

/// Least progress of handles along their path; slower ones pause.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastProgress {
    /// Iterations between two checks.
    pub window: usize,
    /// Least progress between two checks, as a share of the path.
    pub gain: f64,
}

impl LeastProgress {
    /// No least progress.
    pub const ANY: Self = Self {
        window: usize::MAX,
        gain: 0.0,
    };

    /// A pace that handles without obstacles always keep.
    pub const BRISK: Self = Self {
        window: 50,
        gain: 0.05,
    };

    /// A pace of 4000 iterations for the whole path: slower handles crush elements more and more, and hardly ever
    /// arrive.
    pub const PATIENT: Self = Self {
        window: 100,
        gain: 0.025,
    };

    /// Returns whether progress of `gain` in this number of iterations is too slow.
    pub fn is_missed(&self, gain: f64, iterations: usize) -> bool {
        iterations >= self.window && gain < self.gain
    }
}
