//! Continuation of handles: advances along their path, each together with a Newton step of the free vertices.

use super::handles::{Handles, HandlesError, Path, Rotation, aside};
use super::objective::Objective;
use super::relaxation::{LineSearch, Relaxation, line_search, newton_direction};
use super::settings::{Control, LeastProgress, Settings, Status, Summary, Taken, Watch};
use crate::numerics::cholesky::NotPositiveDefinite;
use crate::numerics::square::{Matrix, Square};

/// First advance: the whole path, since a small deformation needs no more.
const FIRST_ADVANCE: f64 = 1.0;

/// Shortest advance that is tried; before a shorter one the vertices in the way have to move.
const LEAST_ADVANCE: f64 = 1e-4;

/// Share of the distance to the first inversion that an advance may take. A smaller share means more and shorter
/// advances: when it was chosen, 0.5 took a third more iterations on the reference problems
/// (`tests/bench/reference.py`).
const SAFETY: f64 = 0.9;

/// Largest rise of the energy above twice the predicted one, as a share of the energy. Larger values allow longer
/// advances, smaller ones keep the map nearer to the minimum on the way.
const SURPRISE: f64 = 2.0;

/// Least reference energy for that comparison, as a share of the sum of the weights: at rest any advance would exceed
/// it.
const UNSTRAINED: f64 = 0.02;

/// Steps without an advance after which the free vertices must settle first.
pub(super) const PATIENCE: usize = 20;

/// Strength of soft constraints relative to the energy's mean curvature while they move; at the end it rises tenfold at
/// a time. Stronger ones keep points nearer to their paths but make the Hessian stiffer.
pub(super) const SOFT: f64 = 1e3;

/// State of the handles along their path.
pub(super) struct LoadSteps<const D: usize> {
    vertices: Vec<u32>,
    path: Path<D>,
    pub points: Points,
    /// Share of the path that is done.
    pub s: f64,
    /// Next advance to try.
    stride: f64,
    pub summary: Summary,
    /// Relaxation of the Hessian near the map.
    pub relaxation: Relaxation,
    newton: Vec<f64>,
    direction: Vec<f64>,
    trial: Vec<f64>,
}

impl<const D: usize> LoadSteps<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Starts at the beginning of the path, from the map `x`.
    pub fn new(
        objective: &mut Objective,
        x: &[f64],
        handles: &Handles,
        relaxation: Relaxation,
    ) -> Result<Self, HandlesError> {
        let start = Summary::at_start(objective.value(x));
        Self::continued(objective, x, handles, relaxation, start)
    }

    /// Like [`new`](Self::new), after earlier work and with a known energy.
    pub fn continued(
        objective: &mut Objective,
        x: &[f64],
        handles: &Handles,
        relaxation: Relaxation,
        summary: Summary,
    ) -> Result<Self, HandlesError> {
        Ok(Self {
            vertices: handles.vertices.clone(),
            path: Path::new(handles, x)?,
            points: Points::new(objective, x, handles),
            s: 0.0,
            stride: FIRST_ADVANCE,
            summary,
            relaxation,
            newton: vec![0.0; x.len()],
            direction: vec![0.0; x.len()],
            trial: vec![0.0; x.len()],
        })
    }

    /// Takes the rest of the path at once, together with the Newton step, in one solve with the factorization of
    /// another point. Returns the norm of its right-hand side; `None`, without moving anything, if the whole step would
    /// leave the domain.
    ///
    /// Does not evaluate the energy, which is unknown afterward.
    pub fn step_with_kept(&mut self, objective: &mut Objective, x: &mut [f64]) -> Option<f64> {
        self.take_moves(x, 1.0);
        let norm = objective.step_and_follow(&mut self.direction).ok()?;
        if SAFETY * objective.largest_step(x, &self.direction) < 1.0 {
            return None;
        }
        for (x, d) in x.iter_mut().zip(&self.direction) {
            *x += d;
        }
        self.s = 1.0;
        self.summary.iterations += 1;
        self.summary.energy_last = f64::NAN;
        Some(norm)
    }

    /// Resets the next advance to its full length once the map has settled.
    pub fn start_over(&mut self) {
        self.stride = FIRST_ADVANCE;
    }

    /// Advances until the targets are reached, or the handles are stuck or miss the pace.
    pub fn advance(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        least_progress: LeastProgress,
        watch: &dyn Watch,
    ) -> Control {
        self.points.pull::<D>(objective, x, SOFT, self.s);
        // Count iterations without progress, and measure the pace in windows of iterations.
        let mut stuck = 0;
        let (mut passed, mut looked) = (self.s, self.summary.iterations);
        while self.s < 1.0 && stuck < PATIENCE && self.summary.iterations < settings.max_iterations
        {
            let since = self.summary.iterations - looked;
            if least_progress.is_missed(self.s - passed, since) {
                break;
            }
            if since >= least_progress.window {
                (passed, looked) = (self.s, self.summary.iterations);
            }
            // Advance together with a Newton step, and show the iterate.
            let before = self.s;
            let Some(sigma) = self.iterate(objective, x) else {
                break;
            };
            stuck = if self.s > before { 0 } else { stuck + 1 };
            let mu = objective.shift();
            if objective.show(x, &self.summary, Taken { mu, sigma }, watch) == Control::Finish {
                self.summary.status = Status::Stopped;
                return Control::Finish;
            }
        }
        Control::Continue
    }

    /// Runs one iteration: an advance together with the Newton step or, if none is possible, the Newton step alone.
    /// Returns the length of the step as a share of the direction; `None` if no matrix gives one.
    pub fn iterate(&mut self, objective: &mut Objective, x: &mut [f64]) -> Option<f64> {
        loop {
            let decrement = self.find_newton_step(objective, x)?;
            let sigma = if self.step(objective, x) {
                1.0
            } else if self.relaxation.after_useless_direction() {
                self.start_over();
                continue;
            } else {
                self.relax(objective, x, decrement)
            };
            self.summary.iterations += 1;
            return Some(sigma);
        }
    }

    /// Writes the Newton step to `newton` and returns its decrement; `None` if no matrix gives one.
    pub fn find_newton_step(&mut self, objective: &mut Objective, x: &[f64]) -> Option<f64> {
        newton_direction(
            objective,
            x,
            &mut self.relaxation,
            &mut self.newton,
            &mut self.summary.factorizations,
        )
    }

    /// Tries advances together with the Newton step; returns `false` if no advance of a relevant length is acceptable.
    fn step(&mut self, objective: &mut Objective, x: &mut [f64]) -> bool {
        while self.stride > LEAST_ADVANCE {
            // Aim at the end of the advance, with the targets of the points there.
            let to = (self.s + self.stride).min(1.0);
            if self.aim(objective, x, to).is_err() {
                break;
            }
            self.points.pull::<D>(objective, x, SOFT, to);
            let largest = SAFETY * objective.largest_step(x, &self.direction);
            if largest >= 1.0 && self.is_acceptable(objective, x) {
                x.copy_from_slice(&self.trial);
                self.s = to;
                self.stride *= 2.0;
                return true;
            }
            // Halve the advance; shorten it further where an inversion is near.
            self.stride *= 0.5 * largest.clamp(0.2, 1.0);
        }
        // No advance is acceptable: restore the targets and try a short one in the next iteration.
        self.points.pull::<D>(objective, x, SOFT, self.s);
        self.stride = 4.0 * LEAST_ADVANCE;
        false
    }

    /// Writes the sum of the Newton step and the response to an advance to `to` into `direction`.
    fn aim(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        to: f64,
    ) -> Result<(), NotPositiveDefinite> {
        self.take_moves(x, to);
        let moves = self.points.moves::<D>(self.s, to);
        objective.follow(&mut self.direction, moves)?;
        for (d, n) in self.direction.iter_mut().zip(&self.newton) {
            *d += n;
        }
        Ok(())
    }

    /// Writes the moves of the handles to `to` into `direction`; its other entries are meaningless.
    fn take_moves(&mut self, x: &[f64], to: f64) {
        for (i, &v) in self.vertices.iter().enumerate() {
            let place = self.path.position(i, to);
            let at = D * v as usize;
            for k in 0..D {
                self.direction[at + k] = place[k] - x[at + k];
            }
        }
    }

    /// Returns whether the energy after the direction is about as predicted by the model. Leaves the point in `trial`.
    fn is_acceptable(&mut self, objective: &Objective, x: &[f64]) -> bool {
        for ((trial, x), d) in self.trial.iter_mut().zip(x).zip(&self.direction) {
            *trial = x + d;
        }
        let energy = self.summary.energy_last;
        let promised = objective.model_change(&self.direction).max(0.0);
        let unit = objective
            .reference(energy)
            .max(UNSTRAINED * objective.scale());
        let new_energy = objective.value(&self.trial);
        let is_acceptable = new_energy <= energy + 2.0 * promised + SURPRISE * unit;
        if is_acceptable {
            self.summary.energy_last = new_energy;
        }
        is_acceptable
    }

    /// Takes the Newton step alone, with a line search; returns its length, 0 if no step helps.
    pub fn relax(&mut self, objective: &Objective, x: &mut [f64], decrement: f64) -> f64 {
        let search = LineSearch {
            x,
            direction: &self.newton,
            energy: self.summary.energy_last,
            slope: -2.0 * decrement,
        };
        line_search(objective, &search, &mut self.trial).map_or(0.0, |step| {
            x.copy_from_slice(&self.trial);
            self.summary.energy_last = step.energy;
            step.length
        })
    }
}

// Points inside elements on their paths to targets: soft constraints of an objective.

/// Points on straight or bent paths, held with a strength relative to the energy's curvature.
pub(super) struct Points {
    origins: Vec<f64>,
    ways: Vec<f64>,
    /// Bend of each path; empty if all are straight.
    bends: Vec<[f64; 3]>,
    /// Workspace for positions and moves.
    room: Vec<f64>,
    /// Mean curvature of the energy at the start; 0 before it is known.
    unit: f64,
}

impl Points {
    /// Creates the paths of the constraints of `objective` from their positions in `x` to their targets; sets their
    /// strength to 0.
    pub fn new(objective: &mut Objective, x: &[f64], handles: &Handles) -> Self {
        let origins: Vec<f64> = objective
            .constraints()
            .map_or(Vec::new(), |constraints| constraints.places(x).collect());
        objective.set_constraints(0.0, &origins);
        let targets = handles.point_targets.iter();
        let ways = targets
            .zip(&origins)
            .map(|(target, origin)| target - origin);
        let ways: Vec<f64> = ways.collect();
        Self {
            room: vec![0.0; ways.len()],
            ways,
            bends: (handles.bends.iter().skip(handles.n_groups()))
                .copied()
                .collect(),
            origins,
            unit: 0.0,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.ways.is_empty()
    }

    /// Returns the largest distance, in one coordinate, of a point from its target.
    pub fn farthest(&self, objective: &Objective, x: &[f64]) -> f64 {
        let Some(constraints) = objective.constraints() else {
            return 0.0;
        };
        let targets = self.origins.iter().zip(&self.ways).map(|(o, way)| o + way);
        let distances = constraints
            .places(x)
            .zip(targets)
            .map(|(x, t)| (x - t).abs());
        distances.fold(0.0, f64::max)
    }

    /// Returns the moves of the targets between two shares of the path.
    pub fn moves<const D: usize>(&mut self, from: f64, to: f64) -> &[f64] {
        for (room, way) in self.room.iter_mut().zip(&self.ways) {
            *room = (to - from) * way;
        }
        self.bend_room::<D>(to, 1.0);
        self.bend_room::<D>(from, -1.0);
        &self.room
    }

    /// Adds `times` the offset of the bent paths from straight ones at `s` to the workspace.
    fn bend_room<const D: usize>(&mut self, s: f64, times: f64) {
        let rooms = self.room.as_chunks_mut::<D>().0.iter_mut();
        let ways = rooms.zip(self.ways.as_chunks::<D>().0);
        for ((room, way), bend) in ways.zip(&self.bends) {
            for (room, aside) in room.iter_mut().zip(aside(*way, *bend, s)) {
                *room += times * aside;
            }
        }
    }

    /// Moves the targets to the share `s` of their paths and sets the strength, in units of the energy's mean
    /// curvature, which is measured at `x` the first time.
    pub fn pull<const D: usize>(
        &mut self,
        objective: &mut Objective,
        x: &[f64],
        strength: f64,
        s: f64,
    ) {
        if self.is_empty() {
            return;
        }
        if self.unit == 0.0 {
            objective.linearize(x, 0.0);
            self.unit = objective.mean_diagonal();
        }
        let ways = self.origins.iter().zip(&self.ways);
        for (room, (origin, way)) in self.room.iter_mut().zip(ways) {
            *room = origin + s * way;
        }
        self.bend_room::<D>(s, 1.0);
        objective.set_constraints(strength * self.unit, &self.room);
    }
}
