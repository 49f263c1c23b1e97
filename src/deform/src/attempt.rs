//! An attempt to bring handles to their targets.

use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square};
use unwrapd_method::solver::{
    Continuation, Continued, Handles, LeastProgress, Objective, Settings, Status, Summary, Watch,
};

/// Shared state of all attempts: the problem, the objective, the settings, and the work done so far.
pub(super) struct Trial<'a> {
    pub problem: &'a Problem,
    pub objective: Objective,
    pub settings: Settings,
    pub watch: &'a dyn Watch,
    pub total: Summary,
}

impl Trial<'_> {
    /// Returns whether the iterations are used up.
    pub fn is_spent(&self) -> bool {
        self.total.iterations >= self.settings.max_iterations
    }

    /// Adds the work of one more attempt.
    pub fn add(&mut self, more: &Summary) {
        self.total = self.total.followed_by(more);
    }

    /// Turns a map into a solution, with the work of all attempts.
    pub fn solution(&self, x: Vec<f64>, status: Status, energy_last: f64) -> Solution {
        let summary = Summary {
            status,
            energy_last,
            ..self.total
        };
        self.problem.solution(x, summary)
    }
}

/// A map and the journey of its handles.
pub(super) struct Attempt<const D: usize> {
    x: Vec<f64>,
    continuation: Continuation<D>,
    settings: Settings,
}

impl<const D: usize> Attempt<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Starts from the map `x` through these stations, with at most `max_iterations` iterations.
    pub fn new(
        trial: &mut Trial,
        x: Vec<f64>,
        stations: Vec<Handles>,
        max_iterations: usize,
    ) -> Result<Self, ProblemError> {
        let settings = Settings {
            max_iterations,
            ..trial.settings
        };
        let continuation = Continuation::new(&mut trial.objective, &x, stations, &settings)?;
        Ok(Self {
            x,
            continuation,
            settings,
        })
    }

    /// Starts from `start` on paths with these bends, or on straight ones if `bends` is empty.
    pub fn bent(
        trial: &mut Trial,
        start: &[f64],
        bends: &[[f64; 3]],
    ) -> Result<Self, ProblemError> {
        let stations = trial.problem.stations.iter().map(|handles| Handles {
            bends: bends.to_vec(),
            ..handles.clone()
        });
        let stations = stations.collect();
        Self::new(
            trial,
            start.to_vec(),
            stations,
            trial.settings.max_iterations,
        )
    }

    /// Continues as long as it keeps the pace.
    pub fn go_on(
        &mut self,
        trial: &mut Trial,
        least_progress: LeastProgress,
    ) -> Result<(), ProblemError> {
        let before = self.continuation.summary();
        let watch = Continued {
            watch: trial.watch,
            before: trial.total.iterations - before.iterations,
        };
        let (objective, settings) = (&mut trial.objective, &self.settings);
        (self.continuation).go_on(objective, &mut self.x, settings, least_progress, &watch)?;
        let now = self.continuation.summary();
        trial.add(&Summary {
            iterations: now.iterations - before.iterations,
            factorizations: now.factorizations - before.factorizations,
            ..now
        });
        Ok(())
    }

    /// Returns whether it may continue at a slower pace.
    pub fn is_paused(&self) -> bool {
        self.continuation.is_paused()
    }

    pub fn is_stopped(&self) -> bool {
        self.continuation.summary().status == Status::Stopped
    }

    /// Returns whether no more attempts are needed. With `search` all are made, unless stopped.
    pub fn is_enough(&self, search: bool) -> bool {
        self.is_stopped() || self.has_arrived() && !search
    }

    pub fn has_arrived(&self) -> bool {
        let status = self.continuation.summary().status;
        !matches!(status, Status::TargetsUnreachable | Status::Stopped)
    }

    /// Returns the energy of its map.
    pub fn energy(&self) -> f64 {
        self.continuation.summary().energy_last
    }

    /// Returns the better attempt: that of the lower energy if both have arrived, otherwise the one that has or has
    /// come farther.
    pub fn or(self, other: Self) -> Self {
        let is_better = match (self.has_arrived(), other.has_arrived()) {
            (true, true) => other.energy() < self.energy(),
            (false, false) => other.continuation.share() > self.continuation.share(),
            (_, arrived) => arrived,
        };
        if is_better { other } else { self }
    }

    /// Returns its map.
    pub fn into_map(self) -> Vec<f64> {
        self.x
    }

    /// Returns its map as a solution.
    pub fn into_solution(self, trial: &Trial) -> Solution {
        let summary = self.continuation.summary();
        trial.solution(self.x, summary.status, summary.energy_last)
    }
}
