//! What the barrier costs, and less of it.

use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use crate::barrier::BarrierKind;
use crate::solver::{Settings, Status, Watch};

/// By how much β falls at a time.
const STEP: f64 = 0.1;

/// Times at most.
const MAX_STEPS: usize = 10;

/// What the unmodified energy must fall by for another step to be worth while, as a share of itself.
const LEAST_GAIN: f64 = 1e-3;

impl Problem {
    /// Lowers β tenfold, again and again, while the unmodified energy falls, each time from the last map; returns the best. Every
    /// iterate is without inversion, as in [`solve`](Self::solve).
    ///
    /// Costs a minimization for each step, most of them short.
    pub fn with_weaker_barrier(
        &self,
        solution: Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        let mut best = solution;
        let mut beta = self.barrier.beta;
        for _ in 0..MAX_STEPS {
            beta *= STEP;
            let mut weaker = self.from(&best);
            weaker.barrier.beta = beta;
            let next = weaker.solve(settings, watch)?;
            let wanted = best.worth.energy - LEAST_GAIN * best.worth.energy.abs();
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

    /// The unmodified energy of the map that minimizing without a barrier leads to from this one; elements may invert on the
    /// way. What it is below the energy of the solution is the barrier's bias.
    pub fn energy_without_barrier(
        &self,
        solution: &Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<f64, ProblemError> {
        let mut free = self.from(solution);
        free.barrier.kind = BarrierKind::None;
        free.boundary_barrier = None;
        Ok(free.solve(settings, watch)?.worth.energy)
    }

    /// The same problem with its targets met, starting from a solution.
    fn from(&self, solution: &Solution) -> Self {
        Self {
            start: solution.x.clone(),
            stations: self.stations.last().cloned().into_iter().collect(),
            ..self.clone()
        }
    }
}
