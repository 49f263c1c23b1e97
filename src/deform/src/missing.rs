//! Handles that can reach their targets although others cannot.

use super::body::axes;
use super::handle_path::{BEND, HandlePath, paths};
use super::handles::Aim;
use super::normalized::Frame;
use super::problem::Problem;
use super::problem_error::ProblemError;
use super::pull::TargetDistances;
use super::solve::Solution;
use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square};
use unwrapd_method::solver::{
    Continuation, Continued, Handles, LeastProgress, Objective, Settings, Status, Summary, Watch,
};

/// Most iterations, of all attempts and of each.
const MOST: usize = 1000;
const MOST_EACH: usize = 300;

/// Most iterations of an approach to targets that are known to be out of reach: a few dozen lead next to the obstacle,
/// more only crush the elements there.
const MOST_APPROACHING: usize = 30;

/// Distance from their targets, in edges of a mean element, within which handles are moved there together.
const NEAR: f64 = 2.0;

/// Bends for a handle that is tried alone: straight, then to the left and to the right.
const SIDES: [f64; 3] = [0.0, BEND, -BEND];

/// A map in which some handles did not arrive. Brings each handle that can be reached to its target, with the others
/// held where they are; the rest stay as near as they came.
///
/// If a set of handles does not arrive together, each half is tried, so that a few missing ones of many cost few
/// attempts.
pub(super) struct Missing<'a, const D: usize> {
    problem: &'a Problem,
    parts: Vec<Aim>,
    /// Number of parts that had to move at the start.
    n_moving: usize,
    /// Parts that have not arrived.
    away: Vec<usize>,
    x: Vec<f64>,
    energy: f64,
    is_stopped: bool,
}

impl<'a, const D: usize> Missing<'a, D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Finds the missing handles of the map `x`, which has this energy and began at `start`.
    pub fn new(problem: &'a Problem, start: &[f64], x: Vec<f64>, energy: f64) -> Self {
        let parts = problem.parts();
        let away = |x: &[f64]| away(problem, &parts, x, problem.least_gap(), f64::INFINITY);
        Self {
            n_moving: away(start).len(),
            away: away(&x),
            energy,
            is_stopped: false,
            problem,
            parts,
            x,
        }
    }

    /// Returns the share of the moving handles that are missing.
    pub fn share(&self) -> f64 {
        self.away.len() as f64 / self.n_moving.max(1) as f64
    }

    pub fn is_none(&self) -> bool {
        self.away.is_empty()
    }

    pub fn is_stopped(&self) -> bool {
        self.is_stopped
    }

    /// Returns the energy of the map.
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// Moves all missing handles to their targets or, if they do not arrive together, those that are near.
    pub fn together(&mut self, trial: &mut Trial) -> Result<(), ProblemError> {
        if self.away.len() > 1 {
            self.try_set(trial, &self.away.clone(), MOST_EACH)?;
        }
        let near = NEAR * Frame::of(&self.problem.body).squared(1.0).sqrt();
        let least = self.problem.least_gap();
        let mut set = away(self.problem, &self.parts, &self.x, least, near);
        set.retain(|part| self.away.contains(part));
        if set.len() > 1 {
            self.try_set(trial, &set, MOST_EACH)?;
        }
        Ok(())
    }

    /// Moves the missing handles to their targets together, by halves, or one by one.
    pub fn alone(&mut self, trial: &mut Trial) -> Result<(), ProblemError> {
        self.reach(trial, vec![self.away.clone()])
    }

    /// Moves the missing handles toward their targets on a short straight path, and returns where they came.
    pub fn approach(mut self, trial: &mut Trial) -> Result<Solution, ProblemError> {
        let set = self.away.clone();
        if !set.is_empty() {
            self.try_path(trial, &set, 0.0, MOST_APPROACHING)?;
        }
        Ok(self.into_solution(trial))
    }

    /// Returns the map as a solution.
    pub fn into_solution(self, trial: &Trial) -> Solution {
        let status = if self.is_stopped {
            Status::Stopped
        } else if self.away.is_empty() {
            Status::Converged
        } else {
            Status::TargetsUnreachable
        };
        trial.solution(self.x, status, self.energy)
    }

    /// Tries these sets, the last one first, and the halves of those that do not arrive.
    fn reach(&mut self, trial: &mut Trial, mut sets: Vec<Vec<usize>>) -> Result<(), ProblemError> {
        let end = trial.total.iterations + MOST;
        while let Some(set) = sets.pop() {
            let left = end.saturating_sub(trial.total.iterations);
            if left == 0 {
                break;
            }
            let has_arrived = self.try_set(trial, &set, left.min(MOST_EACH))?;
            if !has_arrived && set.len() > 1 {
                sets.extend(halves(&set));
            }
        }
        Ok(())
    }

    /// Tries to bring these parts to their targets, within `most` iterations per path; returns whether they arrive.
    fn try_set(
        &mut self,
        trial: &mut Trial,
        set: &[usize],
        most: usize,
    ) -> Result<bool, ProblemError> {
        // Try bent paths only for a part that is tried alone.
        let sides = match set.len() {
            0 => &[],
            1 => &SIDES[..],
            _ => &SIDES[..1],
        };
        for &side in sides {
            if self.is_stopped {
                break;
            }
            if self.try_path(trial, set, side, most)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Tries to bring these parts to their targets on paths with the bend `side` to the left; returns whether they
    /// arrive. Keeps the map even if they do not.
    fn try_path(
        &mut self,
        trial: &mut Trial,
        set: &[usize],
        side: f64,
        most: usize,
    ) -> Result<bool, ProblemError> {
        let station = self.only(set, side);
        let x = std::mem::take(&mut self.x);
        let mut attempt = PathAttempt::<D>::new(trial, x, vec![station], most)?;
        attempt.go_on(trial, LeastProgress::BRISK)?;
        let has_arrived = attempt.has_arrived();
        self.is_stopped = attempt.is_stopped();
        self.energy = attempt.energy();
        self.x = attempt.into_map();
        if has_arrived {
            self.away.retain(|part| !set.contains(part));
        }
        Ok(has_arrived)
    }

    /// Returns the handles of these parts with their targets, on paths with the bend `side` to the left, and all others
    /// held in place.
    fn only(&self, set: &[usize], side: f64) -> Handles {
        let targets = &self.problem.stations[0];
        let is_pulled = |v: u32| {
            set.iter()
                .any(|&part| self.parts[part].vertices.contains(&v))
        };
        let mut station = targets.clone();
        station.groups = targets.groups().to_vec();
        // A group of their own, so that no neighbor's travel moves them.
        let held = targets.n_groups() as u32;
        for (i, &v) in targets.vertices.iter().enumerate() {
            if !is_pulled(v) {
                let place = &self.x[D * v as usize..D * (v as usize + 1)];
                station.targets[D * i..D * (i + 1)].copy_from_slice(place);
                station.groups[i] = held;
            }
        }
        // Hold the points of all other parts where they are.
        let gaps = TargetDistances::new(D, targets, &self.x);
        for i in 0..targets.points.len() {
            if !set.iter().any(|&part| self.parts[part].points.contains(&i)) {
                station.point_targets[D * i..D * (i + 1)].copy_from_slice(&gaps.point(i));
            }
        }
        // Bend the paths of the parts to one side.
        if side != 0.0 {
            let axis = axes(&self.problem.body)[0];
            let paths = paths(D, &station, &self.x);
            station.bends = paths
                .iter()
                .map(|path: &HandlePath| path.left(axis).map(|x| side * x))
                .collect();
        }
        station
    }
}

impl Problem {
    /// Returns the parts that are pulled together: those of each handle of the user's list, or else each group and each
    /// point.
    fn parts(&self) -> Vec<Aim> {
        if !self.aims.is_empty() {
            return self.aims.clone();
        }
        let targets = &self.stations[0];
        let mut parts = vec![Aim::default(); targets.n_groups()];
        for (&vertex, &group) in targets.vertices.iter().zip(&*targets.groups()) {
            parts[group as usize].vertices.push(vertex);
        }
        parts.extend((0..targets.points.len()).map(Aim::at_point));
        parts
    }
}

/// Returns the parts that are farther than `least` from their targets, but nearer than `most`.
fn away(problem: &Problem, parts: &[Aim], x: &[f64], least: f64, most: f64) -> Vec<usize> {
    let gaps = TargetDistances::new(problem.body.dim(), &problem.stations[0], x);
    (0..parts.len())
        .filter(|part: &usize| {
            let gap = gaps.of(&parts[*part]);
            gap > least && gap < most
        })
        .collect()
}

/// Splits a set into halves, the second first; a single item stays one set.
fn halves<T: Copy>(set: &[T]) -> Vec<Vec<T>> {
    let (first, second) = set.split_at(set.len() / 2);
    let parts = [second, first].into_iter().filter(|part| !part.is_empty());
    parts.map(<[T]>::to_vec).collect()
}

// An attempt to bring handles to their targets.

/// Shared state of all attempts: the problem, the objective, the settings, and the work done so far.
pub(super) struct Trial<'a> {
    pub problem: &'a Problem,
    pub objective: Objective,
    pub settings: Settings,
    pub watch: &'a dyn Watch,
    pub total: Summary,
}

impl Trial<'_> {
    /// Returns whether the iterations are used up.
    pub fn is_spent(&self) -> bool {
        self.total.iterations >= self.settings.max_iterations
    }

    /// Adds the work of one more attempt.
    pub fn add(&mut self, more: &Summary) {
        self.total = self.total.followed_by(more);
    }

    /// Turns a map into a solution, with the work of all attempts.
    pub fn solution(&self, x: Vec<f64>, status: Status, energy_last: f64) -> Solution {
        let summary = Summary {
            status,
            energy_last,
            ..self.total
        };
        self.problem.solution(x, summary)
    }
}

/// A map and the journey of its handles.
pub(super) struct PathAttempt<const D: usize> {
    x: Vec<f64>,
    continuation: Continuation<D>,
    settings: Settings,
}

impl<const D: usize> PathAttempt<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    /// Starts from the map `x` through these stations, with at most `max_iterations` iterations.
    pub fn new(
        trial: &mut Trial,
        x: Vec<f64>,
        stations: Vec<Handles>,
        max_iterations: usize,
    ) -> Result<Self, ProblemError> {
        let settings = Settings {
            max_iterations,
            ..trial.settings
        };
        let continuation = Continuation::new(&mut trial.objective, &x, stations, &settings)?;
        Ok(Self {
            x,
            continuation,
            settings,
        })
    }

    /// Starts from `start` on paths with these bends, or on straight ones if `bends` is empty.
    pub fn bent(
        trial: &mut Trial,
        start: &[f64],
        bends: &[[f64; 3]],
    ) -> Result<Self, ProblemError> {
        let stations = trial.problem.stations.iter().map(|handles| Handles {
            bends: bends.to_vec(),
            ..handles.clone()
        });
        let stations = stations.collect();
        Self::new(
            trial,
            start.to_vec(),
            stations,
            trial.settings.max_iterations,
        )
    }

    /// Continues as long as it keeps the pace.
    pub fn go_on(
        &mut self,
        trial: &mut Trial,
        least_progress: LeastProgress,
    ) -> Result<(), ProblemError> {
        let before = self.continuation.summary();
        let watch = Continued {
            watch: trial.watch,
            before: trial.total.iterations - before.iterations,
        };
        let (objective, settings) = (&mut trial.objective, &self.settings);
        (self.continuation).go_on(objective, &mut self.x, settings, least_progress, &watch)?;
        let now = self.continuation.summary();
        trial.add(&Summary {
            iterations: now.iterations - before.iterations,
            factorizations: now.factorizations - before.factorizations,
            ..now
        });
        Ok(())
    }

    /// Continues for at most this many iterations, or to a minimum if the handles arrive within them.
    pub fn try_out(&mut self, trial: &mut Trial, most: usize) -> Result<(), ProblemError> {
        let settings = self.settings;
        self.settings.max_iterations = most.min(settings.max_iterations);
        self.go_on(trial, LeastProgress::ANY)?;
        self.settings = settings;
        if self.continuation.summary().status == Status::IterationLimit {
            self.go_on(trial, LeastProgress::ANY)?;
        }
        Ok(())
    }

    /// Returns whether it may continue at a slower pace.
    pub fn is_paused(&self) -> bool {
        self.continuation.is_paused()
    }

    pub fn is_stopped(&self) -> bool {
        self.continuation.summary().status == Status::Stopped
    }

    /// Returns whether no more attempts are needed. With `search` all are made, unless stopped.
    pub fn is_enough(&self, search: bool) -> bool {
        self.is_stopped() || self.has_arrived() && !search
    }

    pub fn has_arrived(&self) -> bool {
        let status = self.continuation.summary().status;
        !matches!(status, Status::TargetsUnreachable | Status::Stopped)
    }

    /// Returns the energy of its map.
    pub fn energy(&self) -> f64 {
        self.continuation.summary().energy_last
    }

    /// Returns the better attempt: that of the lower energy if both have arrived, otherwise the one that has or has
    /// come farther.
    pub fn or(self, other: Self) -> Self {
        let is_better = match (self.has_arrived(), other.has_arrived()) {
            (true, true) => other.energy() < self.energy(),
            (false, false) => other.continuation.share() > self.continuation.share(),
            (_, arrived) => arrived,
        };
        if is_better { other } else { self }
    }

    /// Returns its map.
    pub fn into_map(self) -> Vec<f64> {
        self.x
    }

    /// Returns its map as a solution.
    pub fn into_solution(self, trial: &Trial) -> Solution {
        let summary = self.continuation.summary();
        trial.solution(self.x, summary.status, summary.energy_last)
    }
}
