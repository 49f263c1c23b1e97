//! Handles pulled to their targets, every iterate a valid map.

use super::handles::{Handles, HandlesError};
use super::newton::minimize_with;
use super::objective::Objective;
use super::path::Rotation;
use super::relaxation::Relaxation;
use super::settings::{Settings, Status, Summary};
use super::travel::{SOFT, Travel};
use super::watch::{Continued, Control, Taken, Watch};
use crate::numerics::square::{Matrix, Square};

/// What a round of advances must gain for another to be worth while, as a share of the path.
pub(super) const LEAST_PROGRESS: f64 = 1e-3;

/// How far the rest settles before handles that are stuck try again: see [`Settings::tolerance`].
const SETTLED: f64 = 1e-6;

/// By how much hardening must bring points nearer to their targets: it pulls 10⁶ times as strongly at the end, so points that can
/// arrive come nearer by about as much.
pub(super) const HARDENED: f64 = 1e-3;

/// What rounding leaves of the distance of points from their targets, as a share of their coordinates.
pub(super) const ROUNDING: f64 = 1e-12;

/// The strength of the constraints at the end, beside the energy's mean curvature.
pub(super) const HARD: f64 = 1e9;

/// Moves the handles along their path to one station after another, the other vertices following; at each minimizes `objective`
/// with the handles held.
///
/// Each iteration is one factorization and two or more solves: the Newton step with the handles held, and how the vertices
/// follow an advance of the handles to first order. Both are taken together, the advance no longer than inversions and the
/// quadratic model allow. The energy may rise while the handles travel; no iterate leaves the domain, in which `x` must
/// be. Where the handles cannot advance the rest settles first; if that gives them no room either, the map is the nearest
/// valid one on their path and the status [`Status::TargetsUnreachable`].
///
/// Each station is settled before the next, as if the handles moved slowly: a long body that is not lags behind the handle
/// that drives it, and a bar twisted at one end gathers its twist there and loses turns long before it must. That is cheap, as
/// the true Hessian is definite at a minimum: taken for the next advance too, it gives the tangent of the minima, which leads so
/// near to the next one that three or four factorizations settle it. The projected Hessian gives no tangent where elements are
/// much compressed, and took twice as many.
///
/// Points inside elements are the soft constraints of an [`Objective::constrained`] made of [`Handles::points`]. Their strength
/// is relative to the energy's curvature and grows once the targets are reached, one short minimization for each
/// decade.
///
/// # Errors
/// If handles do not fit each other or the map. Then `x` is as it was.
pub fn follow<const D: usize>(
    objective: &mut Objective,
    x: &mut [f64],
    stations: &[Handles],
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Summary, HandlesError>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    let constraints = objective
        .constraints()
        .map_or(0, |points| points.rows.len());
    for handles in stations {
        handles.check(D, x.len())?;
        let points = handles.points.len();
        if points != constraints {
            return Err(HandlesError::Points {
                points,
                constraints,
            });
        }
    }
    let mut total = Summary::at_start(objective.value(x));
    let mut relaxation = Relaxation::new(settings.projection);
    for handles in stations {
        let counted = Continued {
            watch,
            before: total.iterations,
        };
        objective.fix(&handles.vertices);
        let mut travel = Travel::<D>::new(objective, x, handles, relaxation)?;
        travel.arrive(objective, x, settings, &counted);
        relaxation = travel.relaxation;
        total = total.followed_by(&travel.summary);
        if matches!(total.status, Status::TargetsUnreachable | Status::Stopped) {
            break;
        }
    }
    Ok(total)
}

impl<const D: usize> Travel<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Goes all the way, if that is possible.
    fn arrive(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        watch: &dyn Watch,
    ) {
        if !self.summary.energy_first.is_finite() {
            return;
        }
        if objective.show(x, &self.summary, Taken::default(), watch) == Control::Finish {
            self.summary.status = Status::Stopped;
            return;
        }
        loop {
            let before = self.s;
            if self.advance(objective, x, settings, watch) == Control::Finish
                || self.settle(objective, x, settings, watch) == Control::Finish
            {
                return;
            }
            if self.s >= 1.0 {
                return self.harden(objective, x, settings, watch);
            }
            let is_spent = self.summary.iterations >= settings.max_iterations;
            if is_spent || self.s < before + LEAST_PROGRESS {
                self.summary.status = Status::TargetsUnreachable;
                return;
            }
            self.start_over();
        }
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
            self.points.pull::<D>(objective, x, strength, 1.0);
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
        self.summary = before.followed_by(&minimize_with(
            &mut self.relaxation,
            objective,
            x,
            &settings,
            &counted,
        ));
        if self.summary.status == Status::Stopped {
            Control::Finish
        } else {
            Control::Continue
        }
    }
}
