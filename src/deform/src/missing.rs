//! Handles that can reach their targets although others cannot.

use super::aims::Aim;
use super::attempt::{Attempt, Trial};
use super::axes::axes;
use super::handle_path::{BEND, HandlePath, paths};
use super::normalized::Frame;
use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use super::unreached::Gaps;
use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square};
use unwrapd_method::solver::{Handles, LeastProgress, Status};

/// Most iterations, of all attempts and of each.
const MOST: usize = 1000;
const MOST_EACH: usize = 300;

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
            // Keep the map of each attempt, even where the parts did not arrive.
            let station = self.only(set, side);
            let x = std::mem::take(&mut self.x);
            let mut attempt = Attempt::<D>::new(trial, x, vec![station], most)?;
            attempt.go_on(trial, LeastProgress::BRISK)?;
            let has_arrived = attempt.has_arrived();
            self.is_stopped = attempt.is_stopped();
            self.energy = attempt.energy();
            self.x = attempt.into_map();
            if has_arrived {
                self.away.retain(|part| !set.contains(part));
                return Ok(true);
            }
        }
        Ok(false)
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
        let gaps = Gaps::new(D, targets, &self.x);
        for i in 0..targets.points.len() {
            if !set.iter().any(|&part| self.parts[part].points.contains(&i)) {
                station.point_targets[D * i..D * (i + 1)].copy_from_slice(&gaps.point(i));
            }
        }
        // Bend the paths of the parts to one side.
        if side != 0.0 {
            let axis = axes(&self.problem.body)[0];
            let paths = paths(D, &station, &self.x);
            let bent = |path: &HandlePath| path.left(axis).map(|x| side * x);
            station.bends = paths.iter().map(bent).collect();
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
    let gaps = Gaps::new(problem.body.dim(), &problem.stations[0], x);
    let is_away = |part: &usize| {
        let gap = gaps.of(&parts[*part]);
        gap > least && gap < most
    };
    (0..parts.len()).filter(is_away).collect()
}

/// Splits a set into halves, the second first; a single item stays one set.
fn halves<T: Copy>(set: &[T]) -> Vec<Vec<T>> {
    let (first, second) = set.split_at(set.len() / 2);
    let parts = [second, first].into_iter().filter(|part| !part.is_empty());
    parts.map(<[T]>::to_vec).collect()
}
