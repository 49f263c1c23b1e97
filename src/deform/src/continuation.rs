//! What the barrier costs, and less of it.

use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use unwrapd_method::solver::{Settings, Status, Watch};

/// By how much β falls at a time.
const STEP: f64 = 0.1;

/// Times at most.
const MAX_STEPS: usize = 10;

/// What the unmodified energy must fall by for another step to be worth while, as a share of itself.
const LEAST_GAIN: f64 = 1e-3;

/// The same where the limit is wanted.
const LEAST_CHANGE: f64 = 1e-6;

impl Problem {
    /// Lowers β tenfold, again and again, while the unmodified energy falls, each time from the last map; returns the best. Every
    /// iterate is without inversion, as in [`solve`](Self::solve). A solution whose handles have not arrived stays as it is.
    ///
    /// Costs a minimization for each step, most of them short.
    pub fn with_weaker_barrier(
        &self,
        solution: Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        self.lowered(solution, LEAST_GAIN, settings, watch)
    }

    /// The unmodified energy that the map tends to as β tends to 0, to about six digits. What it is below the energy of the
    /// solution is the barrier's bias: both belong to the same minimum, and no element inverts on the way from one to the
    /// other, as it may where the barrier is left out at once.
    pub fn energy_without_barrier(
        &self,
        solution: &Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<f64, ProblemError> {
        let limit = self.lowered(solution.clone(), LEAST_CHANGE, settings, watch)?;
        Ok(limit.worth.energy)
    }

    /// The map after as many lowerings of β as each gain such a share of the energy.
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
            let wanted = best.worth.energy - least_gain * best.worth.energy.abs();
            if next.summary.status == Status::TargetsUnreachable || next.worth.energy > wanted {
                break;
            }
            best = Solution {
                summary: best.summary.followed_by(&next.summary),
                ..next
            };
        }
        Ok(best)
    }

    /// The same problem with its targets met, starting from a solution.
    fn from(&self, solution: &Solution) -> Self {
        Self {
            start: solution.x.clone(),
            stations: self.stations.last().cloned().into_iter().collect(),
            search: false,
            ..self.clone()
        }
    }
}
