//! Continuation of handles through stations; it may pause and resume.

use super::handles::{Handles, HandlesError, Rotation};
use super::load_steps::{LoadSteps, SOFT};
use super::newton::minimize_with;
use super::objective::Objective;
use super::relaxation::Relaxation;
use super::settings::{Continued, Control, LeastProgress, Settings, Status, Summary, Taken, Watch};
use crate::numerics::square::{Matrix, Square};

/// Least progress of a round of advances that makes another round worthwhile, as a share of the path. A smaller share
/// allows more rounds that bring little.
pub(super) const LEAST_PROGRESS: f64 = 1e-3;

/// Share of their distance that points may keep after hardening: the pull is 10⁶ times as strong at the end, so points
/// that can arrive come nearer by about that factor.
pub(super) const HARDENED: f64 = 1e-3;

/// Rounding error of the distance of points from their targets, as a share of their coordinates: about 5,000 units in
/// the last place.
pub(super) const ROUNDING: f64 = 1e-12;

/// Strength of the constraints at the end, relative to the energy's mean curvature: six decades above [`SOFT`].
pub(super) const HARD: f64 = 1e9;

/// Tolerance to which the free vertices settle before stuck handles try again: see [`Settings::tolerance`].
const SETTLED: f64 = 1e-6;

/// Most iterations of such a settling: elements that are nearly crushed take thousands to settle, and give no room.
const MOST_SETTLING: usize = 100;

/// State of a [`follow()`](super::follow()) that may pause.
pub struct Continuation<const D: usize> {
    stations: Vec<Handles>,
    /// Index of the station ahead.
    station: usize,
    load_steps: LoadSteps<D>,
    /// Totals of the stations passed.
    before: Summary,
    is_paused: bool,
}

impl<const D: usize> Continuation<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Starts from the map `x` through these stations. Without any, it minimizes with nothing held.
    ///
    /// # Errors
    /// If handles do not fit each other, the map or the objective.
    pub fn new(
        objective: &mut Objective,
        x: &[f64],
        mut stations: Vec<Handles>,
        settings: &Settings,
    ) -> Result<Self, HandlesError> {
        if stations.is_empty() {
            stations.push(Handles::default());
        }
        let constraints = (objective.constraints()).map_or(0, |points| points.rows.len());
        for handles in &stations {
            handles.check(D, x.len())?;
            let points = handles.points.len();
            if points != constraints {
                return Err(HandlesError::Points {
                    points,
                    constraints,
                });
            }
        }
        let relaxation = Relaxation::new(settings.projection);
        let load_steps = LoadSteps::new(objective, x, &stations[0], relaxation)?;
        Ok(Self {
            before: Summary::at_start(objective.value(x)),
            station: 0,
            load_steps,
            stations,
            is_paused: false,
        })
    }

    /// Returns whether the handles paused because they were slow. Otherwise they have arrived, are stuck or were
    /// stopped.
    pub fn is_paused(&self) -> bool {
        self.is_paused
    }

    /// Returns the share of the path that is done, from 0 to 1; all stations count equally.
    pub fn share(&self) -> f64 {
        (self.station as f64 + self.load_steps.s) / self.stations.len() as f64
    }

    /// Returns the totals so far and the status.
    pub fn summary(&self) -> Summary {
        self.before.followed_by(&self.load_steps.summary)
    }

    /// Continues from the map that the journey left in `x`, as long as it keeps the pace.
    ///
    /// # Errors
    /// If handles do not fit.
    pub fn go_on(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        least_progress: LeastProgress,
        watch: &dyn Watch,
    ) -> Result<(), HandlesError> {
        self.is_paused = false;
        loop {
            let Some(handles) = self.stations.get(self.station) else {
                return Ok(());
            };
            // Move toward the present station.
            objective.fix(&handles.vertices);
            let counted = Continued {
                watch,
                before: self.before.iterations,
            };
            self.is_paused =
                (self.load_steps).arrive(objective, x, settings, least_progress, &counted);
            // Stop at the last station, or where the handles are stuck, slow or stopped.
            let status = self.load_steps.summary.status;
            let is_last = self.station + 1 >= self.stations.len();
            if is_last || matches!(status, Status::TargetsUnreachable | Status::Stopped) {
                return Ok(());
            }
            // Continue to the next station; the relaxation found here carries over.
            self.station += 1;
            self.before = self.summary();
            let relaxation = self.load_steps.relaxation;
            objective.fix(&self.stations[self.station].vertices);
            self.load_steps =
                LoadSteps::new(objective, x, &self.stations[self.station], relaxation)?;
        }
    }
}

impl<const D: usize> LoadSteps<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Moves the handles to the end of the path if that is possible at this pace; returns `true` if a slower pace might
    /// get them farther.
    fn arrive(
        &mut self,
        objective: &mut Objective,
        x: &mut [f64],
        settings: &Settings,
        least_progress: LeastProgress,
        watch: &dyn Watch,
    ) -> bool {
        // Refuse a start outside the domain; show a valid one.
        if !self.summary.energy_first.is_finite() {
            return false;
        }
        if objective.show(x, &self.summary, Taken::default(), watch) == Control::Finish {
            self.summary.status = Status::Stopped;
            return false;
        }
        // Advance and settle in rounds, as long as each brings the handles farther.
        loop {
            let (before, begun) = (self.s, self.summary.iterations);
            if self.advance(objective, x, settings, least_progress, watch) == Control::Finish
                || self.settle(objective, x, settings, watch) == Control::Finish
            {
                return false;
            }
            // At the targets: let the points of soft constraints arrive.
            if self.s >= 1.0 {
                self.harden(objective, x, settings, watch);
                return false;
            }
            // Give up where a round brought hardly any progress; pause where it was only slow.
            let is_spent = self.summary.iterations >= settings.max_iterations;
            let is_stuck = is_spent || self.s < before + LEAST_PROGRESS;
            let is_slow =
                least_progress.is_missed(self.s - before, self.summary.iterations - begun);
            if is_stuck || is_slow {
                self.summary.status = Status::TargetsUnreachable;
                return !is_stuck;
            }
            self.start_over();
        }
    }

    /// Hardens the constraints until the points meet their targets; sets the status if they do not.
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

    /// Minimizes with the handles held in place.
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
        let left = settings.max_iterations.saturating_sub(before.iterations);
        // Short of the targets, settle only as far as it may make room for the handles.
        let (most, tolerance) = if self.s < 1.0 {
            (left.min(MOST_SETTLING), settings.tolerance.min(SETTLED))
        } else {
            (left, settings.tolerance)
        };
        let settings = Settings {
            max_iterations: most,
            tolerance,
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

// Handles pulled to their targets, every iterate a valid map.

/// Moves the handles along their path from station to station while the other vertices follow; minimizes `objective`
/// with the handles held at each station.
///
/// Each iteration is one factorization and two or more solves: the Newton step with the handles held, and the
/// first-order response of the vertices to an advance of the handles. Both are taken together; the advance is no longer
/// than inversions and the quadratic model allow. The energy may rise while the handles move; no iterate leaves the
/// domain, which must contain `x`. Where the handles cannot advance, the free vertices settle first; if that makes no
/// room either, the map is the last valid one on the path and the status is
/// [`Status::TargetsUnreachable`].
///
/// Every station is settled before the next, as if the handles moved slowly. Otherwise a long body lags behind the
/// handle that drives it, and a bar twisted at one end gathers its twist there and loses turns early. Settling is
/// cheap, as the true Hessian is definite at a minimum: used for the next advance too, it gives the tangent of the
/// curve of minima, which leads so near to the next minimum that three or four factorizations settle it. The
/// projected Hessian gives no tangent where elements are strongly compressed, and took twice the factorizations.
///
/// Points inside elements are the soft constraints of an [`Objective::constrained`] made of [`Handles::points`]. Their
/// strength is relative to the energy's curvature and grows once the targets are reached, with one short minimization
/// per decade.
///
/// # Errors
/// If handles do not fit each other or the map. Then `x` is unchanged.
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
    let mut continuation = Continuation::<D>::new(objective, x, stations.to_vec(), settings)?;
    continuation.go_on(objective, x, settings, LeastProgress::ANY, watch)?;
    Ok(continuation.summary())
}
