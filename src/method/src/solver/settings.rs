//! What the solver is told and what it tells.

use serde::{Deserialize, Serialize};

/// When to stop and how to regularize.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Steps at most.
    pub max_iterations: usize,
    /// Converged when the decrease that the quadratic model promises at its minimum (for a Newton step the decrement −½g·d) is
    /// at most this share of the energy, and at least half of the step could be taken.
    pub tolerance: f64,
    /// What to do about negative curvature.
    pub projection: Projection,
}

impl Settings {
    /// Tolerance 1e-4: enough for texture coordinates, and spares large meshes the tail.
    pub fn draft() -> Self {
        Self {
            max_iterations: 200,
            tolerance: 1e-4,
            projection: Projection::TrustRegion,
        }
    }

    /// Tolerance 1e-6.
    pub fn normal() -> Self {
        Self {
            tolerance: 1e-6,
            ..Self::draft()
        }
    }

    /// Tolerance 1e-9, for comparisons; 1000 steps.
    pub fn exact() -> Self {
        Self {
            max_iterations: 1000,
            tolerance: 1e-9,
            ..Self::draft()
        }
    }

    /// For handles: tolerance 1e-6, 5000 steps.
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

/// How negative curvature of a triangle enters the matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// It is removed until full steps gain little. From then on the factored matrix serves several directions, each found on
    /// the true Hessian within a trust region.
    #[default]
    TrustRegion,
    /// Less and less of it is removed as full steps gain little: what handles are followed with, whose stations want few
    /// steps each.
    Relaxed,
    /// It is always removed: best far from a minimum, slow near one.
    PositiveSemidefinite,
}

/// How a minimization ended. The map is valid in every case.
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

/// What a minimization did.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Summary {
    /// How it ended.
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
    /// Of a minimization that has not begun.
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

    /// Of both, the other after this one.
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
}
