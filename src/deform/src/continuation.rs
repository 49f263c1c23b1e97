//! Continuation to a weaker barrier, and the barrier's bias.

use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use unwrapd_method::solver::{Settings, Status, Watch};

/// Factor of β per step.
const STEP: f64 = 0.1;

/// Most steps: β is then 1e-10 of its start.
const MAX_STEPS: usize = 10;

/// Least decrease of the unmodified energy that makes another step worthwhile, as a share of that energy.
const LEAST_GAIN: f64 = 1e-3;

/// Least decrease when the limit for β → 0 is wanted: about six digits.
const LEAST_CHANGE: f64 = 1e-6;

impl Problem {
    /// Lowers β tenfold, again and again, while the unmodified energy falls, each time from the last map; returns the
    /// best. No iterate has an inversion, as in [`solve`](Self::solve). A solution whose handles have not arrived is
    /// returned unchanged.
    ///
    /// Costs one minimization per step, most of them short.
    pub fn with_weaker_barrier(
        &self,
        solution: Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        self.lowered(solution, LEAST_GAIN, settings, watch)
    }

    /// Returns the limit of the unmodified energy of the map as β tends to 0, to about six digits. Its difference from
    /// the energy of the solution is the barrier's bias: both belong to the same minimum, and no element inverts
    /// between them, as one might if the barrier were dropped at once.
    pub fn energy_without_barrier(
        &self,
        solution: &Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<f64, ProblemError> {
        let limit = self.lowered(solution.clone(), LEAST_CHANGE, settings, watch)?;
        Ok(limit.quality.energy)
    }

    /// Lowers β as long as each step decreases the energy by the share `least_gain`; returns the last map that did.
    fn lowered(
        &self,
        solution: Solution,
        least_gain: f64,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        if !solution.has_arrived() {
            return Ok(solution);
        }
        let mut best = solution;
        let mut beta = self.barrier.beta;
        for _ in 0..MAX_STEPS {
            beta *= STEP;
            let mut weaker = self.from(&best);
            weaker.barrier.beta = beta;
            let next = weaker.solve(settings, watch)?;
            let wanted = best.quality.energy - least_gain * best.quality.energy.abs();
            if next.summary.status == Status::TargetsUnreachable || next.quality.energy > wanted {
                break;
            }
            best = Solution {
                summary: best.summary.followed_by(&next.summary),
                ..next
            };
        }
        Ok(best)
    }

    /// Returns this problem with only its last station and without search, starting from a solution.
    fn from(&self, solution: &Solution) -> Self {
        Self {
            start: solution.x.clone(),
            stations: self.stations.last().cloned().into_iter().collect(),
            search: false,
            ..self.clone()
        }
    }
}
