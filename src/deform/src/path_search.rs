//! Choice of paths to the targets: straight ones, and others if those do not lead there.

use super::missing::{Missing, PathAttempt, Trial};
use super::normalized::Frame;
use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use std::collections::HashSet;
use unwrapd_method::energy::{Positional, Row};
use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square};
use unwrapd_method::solver::{
    Continued, Handles, LeastProgress, RigidMotions, Settings, SoftTargets, Status, Summary, Watch,
    follow_softly,
};

/// Bends to one side that are tried before soft targets: they bring handles that change places past each other.
const FIRST: usize = 2;

/// Iterations within which a boundary that is held as a whole comes to its targets on straight paths, if at all: of the
/// 22 such problems that begin at rest, ten arrived within 14 and one in 25, and the others were stuck after
/// 50 to 300, each as costly as one of the 10 to 60 that a start at the targets takes.
const SOON: usize = 10;

/// Largest share of missing handles at which these are taken to be blocked individually: they get paths of their own,
/// and no bends of all paths are tried.
const FEW: f64 = 0.25;

impl Problem {
    /// Finds the best map within a bounded effort. Straight paths come first, or a start at the targets where the whole
    /// boundary is held, then paths bent to one side and the other, then soft targets, then other bends. The first that
    /// lead to all targets are taken; with [`search`](Self::search) all bends are tried. A path on which handles creep is
    /// abandoned, and only the one that led farthest is continued. Last, missing handles are tried alone.
    ///
    /// Vertices that are known to be out of reach do not hold back the others: these come first, then the former go as
    /// near as a short straight path leads.
    pub(super) fn solve_ways(
        &self,
        out_of_reach: &[u32],
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        if !out_of_reach.is_empty() {
            let others = self.without(out_of_reach);
            let solution = others.solve_ways(&[], settings, watch)?;
            return self.approached(solution, settings, watch);
        }
        let objective = self.objective()?;
        let mut start = self.start.clone();
        let is_pulled = self.stations.len() == 1 || !self.soft.is_empty();
        if start == self.body.rest && is_pulled {
            self.shake(&objective, &mut start);
        }
        let trial = Trial {
            total: Summary::at_start(objective.value(&start)),
            problem: self,
            objective,
            settings: *settings,
            watch,
        };
        if self.body.dim() == 2 {
            tried::<2>(trial, &start)
        } else {
            tried::<3>(trial, &start)
        }
    }

    /// Returns the problem without the handles at these vertices.
    pub(super) fn without(&self, vertices: &[u32]) -> Self {
        let left_out: HashSet<u32> = vertices.iter().copied().collect();
        let is_kept = |v: &u32| !left_out.contains(v);
        let mut problem = self.clone();
        for handles in &mut problem.stations {
            *handles = handles.kept(self.body.dim(), is_kept);
        }
        for aim in &mut problem.aims {
            aim.vertices.retain(is_kept);
        }
        problem
    }

    /// Moves the vertices that a solution has left out toward their targets, as far as a short straight path leads.
    fn approached(
        &self,
        solution: Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        if solution.summary.status == Status::Stopped {
            return Ok(solution);
        }
        let mut trial = Trial {
            total: solution.summary,
            problem: self,
            objective: self.objective()?,
            settings: *settings,
            watch,
        };
        let energy = solution.summary.energy_last;
        if self.body.dim() == 2 {
            let missing = Missing::<2>::new(self, &self.start, solution.x, energy);
            missing.approach(&mut trial)
        } else {
            let missing = Missing::<3>::new(self, &self.start, solution.x, energy);
            missing.approach(&mut trial)
        }
    }
}

/// Makes all attempts and returns the best solution.
fn tried<const D: usize>(mut trial: Trial, start: &[f64]) -> Result<Solution, ProblemError>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    // Straight paths, or a start at the targets.
    let search = trial.problem.search;
    let mut best = straight::<D>(&mut trial, start)?;
    if best.is_enough(search) {
        return Ok(best.into_solution(&trial));
    }
    // Paths all bent to one side.
    let bends = trial.problem.bends();
    let (first, others) = bends.split_at(bends.len().min(FIRST));
    best = bent(&mut trial, start, first, best)?;
    if best.is_enough(search) {
        return Ok(best.into_solution(&trial));
    }
    // Soft targets, after which few missing handles are tried alone.
    let mut softly = None;
    if !best.has_arrived() && trial.problem.stations.len() == 1 {
        let missing = pulled_softly::<D>(&mut trial, start)?;
        if missing.is_stopped() || missing.share() <= FEW && !search {
            return Ok(missing.into_solution(&trial));
        }
        softly = Some(missing);
    }
    // Other bends; the best attempt may then continue more slowly.
    best = bent(&mut trial, start, others, best)?;
    let have_arrived_softly = softly.as_ref().is_some_and(Missing::is_none);
    if best.is_paused() && !have_arrived_softly {
        best.go_on(&mut trial, LeastProgress::PATIENT)?;
    }
    // Choose between soft targets and the best attempt.
    match softly {
        Some(missing) if have_arrived_softly && best.has_arrived() => {
            Ok(if best.energy() < missing.energy() {
                best.into_solution(&trial)
            } else {
                missing.into_solution(&trial)
            })
        }
        Some(mut missing) if !best.has_arrived() && !best.is_stopped() => {
            missing.alone(&mut trial)?;
            Ok(missing.into_solution(&trial))
        }
        _ => Ok(best.into_solution(&trial)),
    }
}

/// Follows straight paths. A boundary that is held as a whole has a second chance if it does not come to its targets
/// soon: a start that is there already.
fn straight<const D: usize>(
    trial: &mut Trial,
    start: &[f64],
) -> Result<PathAttempt<D>, ProblemError>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    let mut attempt = PathAttempt::<D>::bent(trial, start, &[])?;
    let Some(held) = trial.problem.held_with_boundary() else {
        attempt.go_on(trial, LeastProgress::BRISK)?;
        return Ok(attempt);
    };
    attempt.try_out(trial, SOON)?;
    if attempt.is_enough(trial.problem.search) {
        return Ok(attempt);
    }
    // Such a map may still be outside a bound on the distortion, or overlap where that is forbidden.
    let start = trial.problem.start_at_targets(&held);
    if let Some(x) = start.filter(|x| trial.objective.value(x).is_finite()) {
        let mut other = PathAttempt::bent(trial, &x, &[])?;
        other.go_on(trial, LeastProgress::ANY)?;
        attempt = attempt.or(other);
    }
    if !attempt.has_arrived() && !attempt.is_stopped() {
        attempt.go_on(trial, LeastProgress::BRISK)?;
    }
    Ok(attempt)
}

/// Returns the best of `best` and the attempts with these bends, or the first that is enough.
fn bent<const D: usize>(
    trial: &mut Trial,
    start: &[f64],
    bends: &[Vec<[f64; 3]>],
    mut best: PathAttempt<D>,
) -> Result<PathAttempt<D>, ProblemError>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    for bends in bends {
        if trial.is_spent() {
            break;
        }
        let mut attempt = PathAttempt::bent(trial, start, bends)?;
        attempt.go_on(trial, LeastProgress::BRISK)?;
        if attempt.is_enough(trial.problem.search) {
            return Ok(attempt);
        }
        best = best.or(attempt);
    }
    Ok(best)
}

/// Pulls the handles softly from `start`, then moves them from there to their targets, all together or those that are
/// near; if few are missing, moves these alone.
fn pulled_softly<'a, const D: usize>(
    trial: &mut Trial<'a>,
    start: &[f64],
) -> Result<Missing<'a, D>, ProblemError>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    let mut x = start.to_vec();
    pull_softly(trial, &trial.problem.stations[0], &mut x);
    let energy = trial.total.energy_last;
    let mut missing = Missing::new(trial.problem, start, x, energy);
    missing.together(trial)?;
    if missing.share() <= FEW {
        missing.alone(trial)?;
    }
    Ok(missing)
}

// Handles pulled softly to their targets, each as fast as the others let it.

/// Most iterations with soft targets. More let slow handles come nearer to their targets.
const MOST: usize = 500;

/// Moves the map `x` until the handles come no nearer to these targets; handles that can reach their targets are then
/// close to them.
fn pull_softly(trial: &mut Trial, targets: &Handles, x: &mut [f64]) {
    let dim = trial.problem.body.dim();
    // Hold the vertices that are at their targets; pull the others and all points.
    let place = |v: u32| &x[dim * v as usize..dim * (v as usize + 1)];
    let ends = targets.targets.chunks_exact(dim);
    let (held, pulled): (Vec<_>, Vec<_>) = targets
        .vertices
        .iter()
        .zip(ends)
        .partition(|pair: &(&u32, &[f64])| place(*pair.0) == pair.1);
    let held: Vec<u32> = held.into_iter().map(|(&v, _)| v).collect();
    let of_vertices = pulled.iter().map(|(v, _)| vec![(**v, 1.0)]);
    let rows: Vec<Row> = of_vertices.chain(targets.points.iter().cloned()).collect();
    let ends: Vec<f64> = (pulled.iter().flat_map(|(_, end)| end.iter()))
        .chain(&targets.point_targets)
        .copied()
        .collect();
    let constraints = |rows, targets| Positional {
        dim,
        rows,
        targets,
        alpha: 0.0,
    };
    // Pull them softly; those that are held alone may leave rigid motions.
    trial.objective.fix(&held);
    trial.objective.set_rigid_motions(RigidMotions::Free);
    trial.objective.pull_at(constraints(rows, ends.clone()));
    let goal = SoftTargets {
        targets: &ends,
        edge: Frame::of(&trial.problem.body).squared(1.0).sqrt(),
    };
    let settings = Settings {
        max_iterations: MOST.min(trial.settings.max_iterations),
        ..trial.settings
    };
    let watch = Continued {
        watch: trial.watch,
        before: trial.total.iterations,
    };
    let done = follow_softly(&mut trial.objective, x, &goal, &settings, &watch);
    // Restore the points of the handles, which the next attempt expects in the objective.
    trial.objective.pull_at(constraints(
        targets.points.clone(),
        targets.point_targets.clone(),
    ));
    trial
        .objective
        .set_rigid_motions(trial.problem.rigid_motions());
    trial.add(&done);
}
