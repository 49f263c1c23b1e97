//! Handles on their way: advances along their path, each together with a Newton step of the rest.

use super::handles::{Handles, HandlesError};
use super::line_search::{Search, line_search};
use super::newton_direction::newton_direction;
use super::objective::Objective;
use super::pace::Pace;
use super::path::{Path, Rotation};
use super::points::Points;
use super::relaxation::Relaxation;
use super::settings::{Settings, Status, Summary};
use super::watch::{Control, Taken, Watch};
use crate::numerics::cholesky::NotPositiveDefinite;
use crate::numerics::square::{Matrix, Square};

/// A first advance along the path: all of it, since a small deformation needs no more.
const FIRST_ADVANCE: f64 = 1.0;

/// Advances shorter than this are not tried: the vertices in the way have to move first.
const LEAST_ADVANCE: f64 = 1e-4;

/// Share of the way to the first inversion that an advance may take. Less of it means more and shorter
/// advances.
const SAFETY: f64 = 0.9;

/// How far the energy may rise above twice what the quadratic model promises, as a share of the energy.
const SURPRISE: f64 = 2.0;

/// Below this share of the sum of the weights an energy is that of a body at rest, where any advance is a surprise.
const UNSTRAINED: f64 = 0.02;

/// Steps without an advance after which the rest must settle first.
pub(super) const PATIENCE: usize = 20;

/// The strength of soft constraints beside the energy's mean curvature, while they travel; it rises tenfold at a time at the end.
pub(super) const SOFT: f64 = 1e3;

/// The handles and the map on the way.
pub(super) struct Travel<const D: usize> {
    vertices: Vec<u32>,
    path: Path<D>,
    pub points: Points,
    /// How much of the path lies behind.
    pub s: f64,
    /// The advance to try next.
    stride: f64,
    pub summary: Summary,
    /// How convex the energy is near the map.
    pub relaxation: Relaxation,
    newton: Vec<f64>,
    direction: Vec<f64>,
    trial: Vec<f64>,
}

impl<const D: usize> Travel<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// At the beginning of the way, the map being `x`.
    pub fn new(
        objective: &mut Objective,
        x: &[f64],
        handles: &Handles,
        relaxation: Relaxation,
    ) -> Result<Self, HandlesError> {
        let start = Summary::at_start(objective.value(x));
        Self::continued(objective, x, handles, (relaxation, start))
    }

    /// The same after what was done before, the energy being known.
    pub fn continued(
        objective: &mut Objective,
        x: &[f64],
        handles: &Handles,
        (relaxation, summary): (Relaxation, Summary),
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

    /// All the rest of the way at once with the factorization of another point, together with the Newton step, in one solve; the norm of
    /// its right side. `None`, and nothing is moved, if the whole step does not stay in the domain.
    ///
    /// The energy is not looked at, and not known afterward.
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

    /// Lets the next advance be long again, since the map has settled.
    pub fn start_over(&mut self) {
        self.stride = FIRST_ADVANCE;
    }

    /// Advances until the targets are reached or the handles are stuck, or miss the pace.
    pub fn advance(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        (settings, pace): (&Settings, Pace),
        watch: &dyn Watch,
    ) -> Control {
        self.points.pull::<D>(objective, x, SOFT, self.s);
        let mut stuck = 0;
        let (mut passed, mut looked) = (self.s, self.summary.iterations);
        while self.s < 1.0 && stuck < PATIENCE && self.summary.iterations < settings.max_iterations
        {
            let since = self.summary.iterations - looked;
            if pace.is_missed(self.s - passed, since) {
                break;
            }
            if since >= pace.window {
                (passed, looked) = (self.s, self.summary.iterations);
            }
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

    /// One iteration: an advance together with the Newton step or, if none is possible, the Newton step alone. The length of that
    /// as a share of the direction; `None` if no matrix gives one.
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

    /// Leaves the Newton step in `newton`; its decrement, `None` if no matrix gives one.
    pub fn find_newton_step(&mut self, objective: &mut Objective, x: &[f64]) -> Option<f64> {
        newton_direction(
            objective,
            x,
            &mut self.relaxation,
            &mut self.newton,
            &mut self.summary.factorizations,
        )
    }

    /// An advance together with the Newton step; false if none that is worth while stays in the domain.
    fn step(&mut self, objective: &mut Objective, x: &mut [f64]) -> bool {
        while self.stride > LEAST_ADVANCE {
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
            self.stride *= 0.5 * largest.clamp(0.2, 1.0);
        }
        self.points.pull::<D>(objective, x, SOFT, self.s);
        self.stride = 4.0 * LEAST_ADVANCE;
        false
    }

    /// Leaves in `direction` the Newton step and the advance to `to` together.
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

    /// Leaves in `direction` the moves of the handles to `to`; elsewhere it has no meaning.
    fn take_moves(&mut self, x: &[f64], to: f64) {
        for (i, &v) in self.vertices.iter().enumerate() {
            let place = self.path.position(i, to);
            let at = D * v as usize;
            for k in 0..D {
                self.direction[at + k] = place[k] - x[at + k];
            }
        }
    }

    /// Is the energy after the direction about what the model promises? Leaves the point in `trial`.
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

    /// The Newton step alone, with a line search; its length, 0 if none helps.
    pub fn relax(&mut self, objective: &Objective, x: &mut [f64], decrement: f64) -> f64 {
        let search = Search {
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
