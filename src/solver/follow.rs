//! Handles pulled to their targets, every iterate a valid map.

use super::line_search::line_search;
use super::newton::minimize;
use super::objective::Objective;
use super::path::{Handles, Path, Rotation};
use super::points::Points;
use super::settings::{Settings, Status, Summary};
use super::watch::{Continued, Control, Taken, Watch};
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

/// What a round of advances must gain for another to be worth while, as a share of the path.
const LEAST_PROGRESS: f64 = 1e-3;

/// Steps without an advance after which the rest must settle first.
const PATIENCE: usize = 20;

/// How far the rest settles before handles that are stuck try again: see [`Settings::tolerance`].
const SETTLED: f64 = 1e-6;

/// By how much hardening must bring points nearer to their targets: it pulls 10⁶ times as strongly at the end, so points that can
/// arrive come nearer by about as much.
const HARDENED: f64 = 1e-3;

/// What rounding leaves of the distance of points from their targets, as a share of their coordinates.
const ROUNDING: f64 = 1e-12;

/// The strength of soft constraints beside the energy's mean curvature, while they travel and, rising tenfold, at the end.
const SOFT: f64 = 1e3;
const HARD: f64 = 1e9;

/// Moves the handles along their path to their targets, the other vertices following, and then minimizes `objective` with
/// the handles held.
///
/// Each iteration is one factorization and two or more solves: the Newton step with the handles held, and how the vertices
/// follow an advance of the handles to first order. Both are taken together, the advance no longer than inversions and the
/// quadratic model allow. The energy may rise while the handles travel; no iterate leaves the domain, in which `x` must
/// be. Where the handles cannot advance the rest settles first; if that gives them no room either, the map is the nearest
/// valid one on their path and the status [`Status::TargetsUnreachable`].
///
/// Points inside elements are the soft constraints of an [`Objective::constrained`] made of [`Handles::points`]. Their strength
/// is relative to the energy's curvature and grows once the targets are reached, one short minimization for each
/// decade.
pub fn follow<const D: usize>(
    objective: &mut Objective,
    x: &mut [f64],
    handles: &Handles,
    settings: &Settings,
    watch: &dyn Watch,
) -> Summary
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    objective.fix(&handles.vertices);
    let mut travel = Travel::<D>::new(objective, x, handles);
    if !travel.summary.energy_first.is_finite() {
        return travel.summary;
    }
    if objective.show(x, &travel.summary, Taken::default(), watch) == Control::Finish {
        return travel.summary.ended(Status::Stopped);
    }
    loop {
        let before = travel.s;
        if travel.advance(objective, x, settings, watch) == Control::Finish
            || travel.settle(objective, x, settings, watch) == Control::Finish
        {
            return travel.summary;
        }
        if travel.s >= 1.0 {
            travel.harden(objective, x, settings, watch);
            return travel.summary;
        }
        let is_spent = travel.summary.iterations >= settings.max_iterations;
        if is_spent || travel.s < before + LEAST_PROGRESS {
            let status = Status::TargetsUnreachable;
            return Summary {
                status,
                ..travel.summary
            };
        }
        travel.stride = FIRST_ADVANCE;
    }
}

struct Travel<'a, const D: usize> {
    handles: &'a Handles,
    path: Path<D>,
    points: Points,
    /// How much of the path lies behind.
    s: f64,
    /// The advance to try next.
    stride: f64,
    summary: Summary,
    newton: Vec<f64>,
    direction: Vec<f64>,
    trial: Vec<f64>,
}

impl<'a, const D: usize> Travel<'a, D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    fn new(objective: &mut Objective, x: &[f64], handles: &'a Handles) -> Self {
        Self {
            handles,
            path: Path::new(handles, x),
            points: Points::new(objective, x, &handles.point_targets),
            s: 0.0,
            stride: FIRST_ADVANCE,
            summary: Summary::at_start(objective.value(x)),
            newton: vec![0.0; x.len()],
            direction: vec![0.0; x.len()],
            trial: vec![0.0; x.len()],
        }
    }

    /// Advances until the targets are reached or the handles are stuck.
    fn advance(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Control {
        self.points.pull(objective, x, SOFT, self.s);
        let mut stuck = 0;
        while self.s < 1.0 && stuck < PATIENCE && self.summary.iterations < settings.max_iterations
        {
            objective.linearize(x, 0.0);
            self.summary.factorizations += 1;
            let Ok(decrement) = objective.newton_direction(&mut self.newton) else {
                break;
            };
            let sigma = if self.step(objective, x) {
                stuck = 0;
                1.0
            } else {
                stuck += 1;
                self.relax(objective, x, decrement)
            };
            self.summary.iterations += 1;
            let mu = objective.shift();
            if objective.show(x, &self.summary, Taken { mu, sigma }, watch) == Control::Finish {
                self.summary.status = Status::Stopped;
                return Control::Finish;
            }
        }
        Control::Continue
    }

    /// An advance together with the Newton step; false if none that is worth while stays in the domain.
    fn step(&mut self, objective: &mut Objective, x: &mut [f64]) -> bool {
        while self.stride > LEAST_ADVANCE {
            let to = (self.s + self.stride).min(1.0);
            self.aim(objective, x, to);
            self.points.pull(objective, x, SOFT, to);
            let largest = SAFETY * objective.largest_step(x, &self.direction);
            if largest >= 1.0 && self.is_acceptable(objective, x) {
                x.copy_from_slice(&self.trial);
                self.s = to;
                self.stride *= 2.0;
                return true;
            }
            self.stride *= 0.5 * largest.clamp(0.2, 1.0);
        }
        self.points.pull(objective, x, SOFT, self.s);
        self.stride = 4.0 * LEAST_ADVANCE;
        false
    }

    /// Leaves in `direction` the Newton step and the advance to `to` together.
    fn aim(&mut self, objective: &mut Objective, x: &[f64], to: f64) {
        for (i, &v) in self.handles.vertices.iter().enumerate() {
            let place = self.path.position(i, to);
            let at = D * v as usize;
            for k in 0..D {
                self.direction[at + k] = place[k] - x[at + k];
            }
        }
        let moves = self.points.moves(self.s, to);
        objective.follow(&mut self.direction, &moves);
        for (d, n) in self.direction.iter_mut().zip(&self.newton) {
            *d += n;
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
    fn relax(&mut self, objective: &Objective, x: &mut [f64], decrement: f64) -> f64 {
        let from = (self.summary.energy_last, decrement);
        line_search(objective, x, &self.newton, from, &mut self.trial).map_or(0.0, |step| {
            x.copy_from_slice(&self.trial);
            self.summary.energy_last = step.energy;
            step.length
        })
    }

    /// Makes the points meet their targets; says so if they do not.
    fn harden(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        watch: &dyn Watch,
    ) {
        let before = self.points.farthest(objective, x);
        let mut strength = SOFT;
        while !self.points.is_empty() && strength < HARD {
            strength *= 10.0;
            self.points.pull(objective, x, strength, 1.0);
            self.summary.energy_last = objective.value(x);
            if self.settle(objective, x, settings, watch) == Control::Finish {
                return;
            }
        }
        let rounding = ROUNDING * x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if self.points.farthest(objective, x) > (HARDENED * before).max(rounding) {
            self.summary.status = Status::TargetsUnreachable;
        }
    }

    /// Minimizes with the handles held where they are.
    fn settle(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Control {
        let before = self.summary;
        let counted = Continued {
            watch,
            before: before.iterations,
        };
        let settings = Settings {
            max_iterations: settings.max_iterations.saturating_sub(before.iterations),
            tolerance: if self.s < 1.0 {
                settings.tolerance.min(SETTLED)
            } else {
                settings.tolerance
            },
            ..*settings
        };
        self.summary = before.followed_by(&minimize(objective, x, &settings, &counted));
        if self.summary.status == Status::Stopped {
            Control::Finish
        } else {
            Control::Continue
        }
    }
}
