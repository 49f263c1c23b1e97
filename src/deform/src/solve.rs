//! Solution of a problem.

use super::boundary_barrier::BoundaryBarrier;
use super::normalized::{Frame, MapQuality, Restored};
use super::problem::{Problem, Units};
use super::problem_error::ProblemError;
use serde::{Deserialize, Serialize};
use unwrapd_method::barrier::{Barrier, LEAST_GAIN, weaker_strengths};
use unwrapd_method::energy::{Positional, Term};
use unwrapd_method::solver::{
    Continued, LevenbergSettings, Objective, Settings, Status, Summary, Watch, levenberg,
};

/// Solver of a problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Projected Newton; targets advance as far as the map stays valid.
    #[default]
    Projected,
    /// The paper's iteration with soft constraints, for comparison.
    Levenberg,
}

/// A map and its measures.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Positions, coordinates one after another.
    pub x: Vec<f64>,
    /// Summary of the solver.
    pub summary: Summary,
    /// Quality of the map.
    pub quality: MapQuality,
}

impl Solution {
    /// Returns whether the handles came to their targets, as far as the status tells.
    pub(super) fn has_arrived(&self) -> bool {
        !matches!(
            self.summary.status,
            Status::TargetsUnreachable | Status::Stopped
        )
    }
}

impl Problem {
    /// Minimizes the energy with the handles at their targets; each station is settled before the next
    /// ([`follow`](unwrapd_method::solver::follow)). With a barrier no iterate has an inversion.
    ///
    /// A boundary that is held as a whole and does not follow soon starts at its targets, from the harmonic map,
    /// untangled. Handles that change places block each other. If they do not arrive on straight paths, up to eight sets of bent
    /// paths from the start and the [flow](unwrapd_method::solver::follow_softly()) are tried. If no attempt reaches all
    /// targets, each handle that can be reached alone is, and [`unreached`](Self::unreached) names the rest. With
    /// [`search`](Self::search) all bent paths are tried, and the map with the lowest energy is the solution.
    /// Iterations and factorizations are those of all attempts.
    ///
    /// # Errors
    /// If handles do not fit the body, or if their targets contradict every map without inversions.
    pub fn solve(&self, settings: &Settings, watch: &dyn Watch) -> Result<Solution, ProblemError> {
        self.check_handles()?;
        let out_of_reach = self.uncovered();
        if out_of_reach.is_empty() {
            self.check_targets()?;
        } else {
            self.without(&out_of_reach).check_targets()?;
        }
        self.solve_without(&out_of_reach, settings, watch)
    }

    /// Like [`solve`](Self::solve), also for targets that contradict every map without inversions: handles then come as
    /// near as they can.
    pub(super) fn approach(
        &self,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        self.check_handles()?;
        self.solve_without(&self.uncovered(), settings, watch)
    }

    /// Solves the problem; vertices that are known to be `out_of_reach` hold back no others.
    fn solve_without(
        &self,
        out_of_reach: &[u32],
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        let solution = self.solve_in_units(watch, &|problem, watch| {
            problem.solve_ways(out_of_reach, settings, watch)
        })?;
        let exact = self.rounding();
        Ok(self.checked(solution, exact))
    }

    /// Checks that the handles fit each other and the body.
    fn check_handles(&self) -> Result<(), ProblemError> {
        for handles in &self.stations {
            handles.check(self.body.dim(), self.start.len())?;
        }
        Ok(())
    }

    /// Solves the problem by the paper's iteration.
    pub fn solve_by_levenberg(
        &self,
        settings: &LevenbergSettings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        self.check_handles()?;
        let solution = self.solve_in_units(watch, &|problem, watch| {
            problem.iterate_softly(settings, watch)
        })?;
        let near = self.least_gap();
        Ok(self.checked(solution, near))
    }

    /// Solves the problem in the units in which its numbers are meant.
    fn solve_in_units(
        &self,
        watch: &dyn Watch,
        solve: &dyn Fn(&Self, &dyn Watch) -> Result<Solution, ProblemError>,
    ) -> Result<Solution, ProblemError> {
        let solution = match self.units {
            Units::Given => solve(self, watch)?,
            Units::Normalized => {
                let (inner, frame) = self.normalized();
                let shown = Restored::to(watch, &frame);
                let solution = solve(&inner, &shown)?;
                self.restored(&frame, &inner, &solution)
            }
        };
        Ok(solution)
    }

    /// Changes the status of a solution that counts as arrived although some held vertex is farther than `most` from
    /// its target.
    fn checked(&self, mut solution: Solution, most: f64) -> Solution {
        if matches!(solution.summary.status, Status::Converged | Status::Stalled)
            && !self.is_at_targets(&solution.x, most)
        {
            solution.summary.status = Status::TargetsUnreachable;
        }
        solution
    }

    /// Converts a solution of the normalized problem to this one. Vertices exactly at their targets there are so here,
    /// bit for bit.
    fn restored(&self, frame: &Frame, inner: &Self, solution: &Solution) -> Solution {
        let mut x = frame.outward(&solution.x);
        let dim = self.body.dim();
        if let (Some(given), Some(normalized)) = (self.stations.last(), inner.stations.last()) {
            for (i, &v) in given.vertices.iter().enumerate() {
                let (place, target) = (dim * v as usize, dim * i);
                if solution.x[place..place + dim] == normalized.targets[target..target + dim] {
                    x[place..place + dim].copy_from_slice(&given.targets[target..target + dim]);
                }
            }
        }
        Solution {
            x,
            quality: solution.quality.restored(frame),
            summary: solution.summary,
        }
    }

    fn iterate_softly(
        &self,
        settings: &LevenbergSettings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        // Pull the handles of the first station by soft constraints.
        let terms = self.pulled_terms()?;
        let first = self.stations.first().cloned().unwrap_or_default();
        let constraints = Positional {
            dim: self.body.dim(),
            rows: first.vertices.iter().map(|&v| vec![(v, 1.0)]).collect(),
            targets: first.targets,
            alpha: settings.alpha,
        };
        let mut objective = Objective::constrained(self.body.n_vertices(), terms, constraints);
        // Minimize at one station after the other, each from the map of the last.
        let mut x = self.start.clone();
        let mut total = Summary::at_start(objective.energy(&x));
        for handles in &self.stations {
            objective.set_constraints(settings.alpha, &handles.targets);
            let watch = Continued {
                watch,
                before: total.iterations,
            };
            let summary = levenberg(&mut objective, &mut x, settings, &watch);
            total = total.followed_by(&summary);
            if summary.status == Status::Stopped {
                break;
            }
        }
        Ok(self.solution(x, total))
    }

    /// Creates the objective: the energy with the barrier, and the points that handles pull.
    pub(super) fn objective(&self) -> Result<Objective, ProblemError> {
        let terms = self.pulled_terms()?;
        let n_vertices = self.body.n_vertices();
        let mut objective = match self.stations.first().filter(|h| !h.points.is_empty()) {
            None => Objective::of_terms(n_vertices, terms),
            Some(handles) => {
                let points = Positional {
                    dim: self.body.dim(),
                    rows: handles.points.clone(),
                    targets: handles.point_targets.clone(),
                    alpha: 0.0,
                };
                Objective::constrained(n_vertices, terms, points)
            }
        };
        objective.set_rigid_motions(self.rigid_motions());
        Ok(objective)
    }

    pub(super) fn terms(&self, barrier: Barrier) -> Result<Vec<Box<dyn Term>>, ProblemError> {
        let mut terms = self.body.terms(&self.energy, barrier, self.bound)?;
        terms.extend(self.boundary_term().map(|term| Box::new(term) as _));
        Ok(terms)
    }

    /// Returns the terms of the objective: energy, barriers and the pull of handles with weights.
    pub(super) fn pulled_terms(&self) -> Result<Vec<Box<dyn Term>>, ProblemError> {
        let mut terms = self.terms(self.barrier)?;
        terms.extend(self.soft.term(self.body.dim()));
        Ok(terms)
    }

    /// Returns the barrier of the boundary, as strong as that of an ordinary element.
    pub(super) fn boundary_term(&self) -> Option<BoundaryBarrier> {
        let beta = self.barrier.beta * self.body.mean_weight(&self.energy);
        Some(self.boundary_barrier.as_ref()?.with_beta(beta))
    }

    pub(super) fn solution(&self, x: Vec<f64>, summary: Summary) -> Solution {
        Solution {
            quality: self.quality(&x),
            summary,
            x,
        }
    }
}

// Continuation to a weaker barrier, and the barrier's bias.

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
        for beta in weaker_strengths(self.barrier.beta) {
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
