//! Points pulled softly to their targets, each as fast as the others let it.

use super::objective::Objective;
use super::relaxation::{LineSearch, Relaxation, line_search, newton_direction};
use super::settings::{Control, Settings, Status, Summary, Taken, Watch};

/// Strength of the pull relative to the energy's mean curvature: enough to press against an obstacle, too little to
/// crush it.
const STRENGTH: f64 = 10.0;

/// Longest and shortest distance at which a point is pulled ahead of itself, in edges of a mean element. Longer pulls
/// cross open space in fewer iterations and press harder against obstacles.
const FARTHEST_PULL: f64 = 4.0;
const NEAREST_PULL: f64 = 0.05;

/// A step longer than this share of the direction lets points be pulled farther ahead.
const LONG: f64 = 0.9;

/// Iterations between two checks of the progress. Longer windows are more patient with points that slide along
/// obstacles.
const WINDOW: usize = 20;

/// Least progress between two checks, as a share of the remaining distance. A smaller share goes on while points only
/// creep.
const LEAST_GAIN: f64 = 0.02;

/// Targets that points are pulled to softly.
#[derive(Clone, Copy, Debug)]
pub struct SoftTargets<'a> {
    /// A target for each of the objective's constraints, coordinates one after another.
    pub targets: &'a [f64],
    /// The edge of a mean element.
    pub edge: f64,
}

/// Pulls the constrained points of `objective` toward their targets until they come no nearer; `x` stays in the domain.
///
/// Each point is pulled toward a place a few edges ahead of its present position on the straight line to its target,
/// all with the same moderate strength: a blocked point waits or slides along the obstacle and holds back no other.
/// This is the substepping of Schüller et al. 2013, equation 11, with a step in units of length. The points end near
/// their targets, not on them.
///
/// Cost of an iteration: one factorization, one solve, one or two evaluations.
pub fn follow_softly(
    objective: &mut Objective,
    x: &mut [f64],
    goal: &SoftTargets,
    settings: &Settings,
    watch: &dyn Watch,
) -> Summary {
    let mut pulled = SoftPull::new(objective, x, settings);
    if !pulled.summary.energy_first.is_finite() {
        return pulled.summary;
    }
    let mut looked = distance(objective, x, goal.targets);
    while pulled.summary.iterations < settings.max_iterations {
        let Some(taken) = pulled.step(objective, x, goal) else {
            break;
        };
        if objective.show(x, &pulled.summary, taken, watch) == Control::Finish {
            return pulled.summary.ended(Status::Stopped);
        }
        // Stop once a whole window of iterations brings the points hardly nearer.
        if pulled.summary.iterations.is_multiple_of(WINDOW) {
            let now = distance(objective, x, goal.targets);
            if now > (1.0 - LEAST_GAIN) * looked {
                break;
            }
            looked = now;
        }
    }
    pulled.summary.energy_last = objective.energy(x);
    pulled.summary.ended(Status::TargetsUnreachable)
}

/// State between iterations.
struct SoftPull {
    alpha: f64,
    /// Distance at which points are pulled ahead of themselves, in edges.
    pull: f64,
    relaxation: Relaxation,
    summary: Summary,
    direction: Vec<f64>,
    trial: Vec<f64>,
}

impl SoftPull {
    fn new(objective: &mut Objective, x: &[f64], settings: &Settings) -> Self {
        objective.linearize(x, 0.0);
        Self {
            alpha: STRENGTH * objective.mean_diagonal(),
            pull: 1.0,
            relaxation: Relaxation::new(settings.projection),
            summary: Summary::at_start(objective.energy(x)),
            direction: vec![0.0; x.len()],
            trial: vec![0.0; x.len()],
        }
    }

    /// Runs one iteration; returns `None` if no direction and no shorter pull lowers the energy.
    fn step(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        goal: &SoftTargets,
    ) -> Option<Taken> {
        // Pull each point toward a place a little ahead of it, and find Newton's direction there.
        let ahead = ahead(objective, x, goal.targets, self.pull * goal.edge);
        objective.set_constraints(self.alpha, &ahead);
        let energy = objective.value(x);
        let decrement = newton_direction(
            objective,
            x,
            &mut self.relaxation,
            &mut self.direction,
            &mut self.summary.factorizations,
        )?;
        // Take a step; without one, continue only with a safer matrix or a shorter pull.
        let search = LineSearch {
            x,
            direction: &self.direction,
            energy,
            slope: -2.0 * decrement,
        };
        let step = line_search(objective, &search, &mut self.trial);
        self.summary.iterations += 1;
        let length = step.map_or(0.0, |step| step.length);
        if let Some(step) = step {
            x.copy_from_slice(&self.trial);
            self.summary.energy_last = step.energy;
            let decrease = (energy - step.energy) / energy.abs();
            self.relaxation.after_step(step.length, decrease);
        } else if !self.relaxation.after_useless_direction() && self.pull <= NEAREST_PULL {
            return None;
        }
        // Pull farther ahead after a full step, less far after a short one.
        let times = if length > LONG {
            2.0
        } else {
            0.5 + 0.5 * length
        };
        self.pull = (times * self.pull).clamp(NEAREST_PULL, FARTHEST_PULL);
        Some(Taken {
            mu: objective.shift(),
            sigma: length,
        })
    }
}

/// Returns the positions of the constrained points.
fn places(objective: &Objective, x: &[f64]) -> Vec<f64> {
    let constraints = objective.constraints();
    constraints.map_or(Vec::new(), |points| points.places(x).collect())
}

/// Returns the sum of the distances of the constrained points from their targets.
fn distance(objective: &Objective, x: &[f64], targets: &[f64]) -> f64 {
    let dim = objective.dim();
    let places = places(objective, x);
    let pairs = places.chunks_exact(dim).zip(targets.chunks_exact(dim));
    pairs.map(|(place, target)| gap(place, target)).sum()
}

fn gap(place: &[f64], target: &[f64]) -> f64 {
    let squares = place.iter().zip(target).map(|(x, t)| (x - t) * (x - t));
    squares.sum::<f64>().sqrt()
}

/// Returns the targets, each cut off at the distance `most` from its point on the straight line.
fn ahead(objective: &Objective, x: &[f64], targets: &[f64], most: f64) -> Vec<f64> {
    let dim = objective.dim();
    let places = places(objective, x);
    let pairs = places.chunks_exact(dim).zip(targets.chunks_exact(dim));
    let ahead = pairs.flat_map(|(place, target)| {
        let share = (most / gap(place, target)).min(1.0);
        let pairs = place.iter().zip(target);
        pairs.map(move |(x, t)| x + share * (t - x))
    });
    ahead.collect()
}
