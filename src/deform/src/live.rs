//! A problem that is solved while its handles change.

use super::body::BodyElements;
use super::problem::Problem;
use super::problem_error::ProblemError;
use unwrapd_maps::plane::are_disjoint;
use unwrapd_method::solver::{Handles, InteractiveContinuation, Objective, Stage, Summary};

/// Distance from their targets, for mean elements of size 1, within which handles have arrived: a body at rest stays at
/// rest.
const NEAR: f64 = 1e-9;

/// A problem in its own units, with its energy, its map and the drag of its handles.
pub(super) struct Live {
    /// The problem; its only station holds the present handles.
    problem: Problem,
    objective: Objective,
    x: Vec<f64>,
    continuation: LiveContinuation,
}

/// A drag in the plane or in space.
enum LiveContinuation {
    Planar(InteractiveContinuation<2>),
    Spatial(InteractiveContinuation<3>),
}

impl Live {
    pub fn new(problem: Problem) -> Result<Self, ProblemError> {
        let handles = problem.stations.last().cloned().unwrap_or_default();
        handles.check(problem.body.dim(), problem.start.len())?;
        let mut objective = problem.objective()?;
        let x = problem.start.clone();
        let continuation = match problem.body.dim() {
            2 => LiveContinuation::Planar(InteractiveContinuation::new(&mut objective, &x)?),
            _ => LiveContinuation::Spatial(InteractiveContinuation::new(&mut objective, &x)?),
        };
        let mut live = Self {
            problem,
            objective,
            x,
            continuation,
        };
        live.aim(handles)?;
        Ok(live)
    }

    /// Replaces the handles.
    pub fn aim(&mut self, handles: Handles) -> Result<(), ProblemError> {
        let (objective, x) = (&mut self.objective, &mut self.x);
        handles.check(objective.dim(), x.len())?;
        self.problem.stations = vec![handles];
        let handles = &self.problem.stations[0];
        if *x == self.problem.body.rest && self.problem.quality_as_given(x).residual > NEAR * NEAR {
            self.problem.shake(objective, x);
        }
        match &mut self.continuation {
            LiveContinuation::Planar(continuation) => continuation.aim(objective, x, handles)?,
            LiveContinuation::Spatial(continuation) => continuation.aim(objective, x, handles)?,
        }
        Ok(())
    }

    /// Runs one iteration, unless nothing is left to do.
    pub fn step(&mut self) -> Stage {
        let (objective, x) = (&mut self.objective, &mut self.x);
        match &mut self.continuation {
            LiveContinuation::Planar(continuation) => continuation.step(objective, x),
            LiveContinuation::Spatial(continuation) => continuation.step(objective, x),
        }
    }

    pub fn stage(&self) -> Stage {
        match &self.continuation {
            LiveContinuation::Planar(continuation) => continuation.stage(),
            LiveContinuation::Spatial(continuation) => continuation.stage(),
        }
    }

    pub fn summary(&self) -> &Summary {
        match &self.continuation {
            LiveContinuation::Planar(continuation) => continuation.summary(),
            LiveContinuation::Spatial(continuation) => continuation.summary(),
        }
    }

    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Moves the map back to `x`, with the present handles.
    pub fn put(&mut self, x: Vec<f64>) -> Result<(), ProblemError> {
        self.x = x;
        self.aim(self.problem.stations[0].clone())
    }

    /// Refuses a map outside the domain of the energy.
    pub fn check_domain(&self) -> Result<(), ProblemError> {
        let is_apart = match (&self.problem.boundary_barrier, &self.problem.body.elements) {
            (Some(_), BodyElements::Triangles { corners, .. }) => {
                are_disjoint(self.x.as_chunks().0, corners)
            }
            _ => true,
        };
        if is_apart && self.objective.value(&self.x).is_finite() {
            return Ok(());
        }
        Err(ProblemError::OutsideDomain)
    }

    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    pub fn analyses(&self) -> usize {
        self.objective.analyses()
    }
}
