//! Handles that can be reached, beside those that cannot.

use std::collections::HashSet;

use super::aims::Aim;
use super::problem::Problem;
use super::problem_error::ProblemError;
use super::solve::Solution;
use super::unreached::Gaps;
use crate::solver::{Continued, Handles, Settings, Status, Watch};

/// How often those that did not arrive are tried: others that arrived since may have made room.
const ROUNDS: usize = 2;

impl Problem {
    /// From a map whose handles did not all arrive: each that can be reached is, while the others are held where they are. The rest
    /// stay as near as they came.
    ///
    /// Of a set that does not arrive together each half is tried, so that few of many cost few attempts. Ways through
    /// several stations are as they were given: there, nothing is tried.
    pub(super) fn singly(
        &self,
        best: Solution,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Solution, ProblemError> {
        let [targets] = &self.stations[..] else {
            return Ok(best);
        };
        let (parts, least) = (self.parts(targets), self.least_gap());
        let gaps = Gaps::new(self.body.dim(), targets, &best.x);
        let mut missing: Vec<&Aim> = (parts.iter())
            .filter(|part| gaps.of(part) > least)
            .collect();
        let mut objective = self.objective()?;
        let (mut x, mut total) = (best.x.clone(), best.summary);
        for _ in 0..ROUNDS {
            let mut sets = halves(&missing);
            let before = missing.len();
            missing.clear();
            while let Some(set) = sets.pop() {
                let spent = total.iterations - best.summary.iterations;
                let Some(left) = settings.max_iterations.checked_sub(spent) else {
                    missing.extend(set);
                    continue;
                };
                let counted = Continued {
                    watch,
                    before: total.iterations,
                };
                let settings = Settings {
                    max_iterations: left,
                    ..*settings
                };
                let station = [self.only(targets, &set, &x)];
                let ended = self.follow(&mut objective, &mut x, &station, &settings, &counted)?;
                total = total.followed_by(&ended);
                match ended.status {
                    Status::Stopped => return Ok(self.solution(x, total)),
                    Status::TargetsUnreachable if set.len() == 1 => missing.extend(set),
                    Status::TargetsUnreachable => sets.extend(halves(&set)),
                    _ => {}
                }
            }
            if missing.is_empty() || missing.len() == before {
                break;
            }
        }
        total.status = if missing.is_empty() {
            Status::Converged
        } else {
            Status::TargetsUnreachable
        };
        Ok(self.solution(x, total))
    }

    /// What is pulled together: what one handle of the user's list holds, or else a group or a point.
    fn parts(&self, targets: &Handles) -> Vec<Aim> {
        if !self.aims.is_empty() {
            return self.aims.clone();
        }
        let mut parts = vec![Aim::default(); targets.n_groups()];
        for (&vertex, &group) in targets.vertices.iter().zip(&*targets.groups()) {
            parts[group as usize].vertices.push(vertex);
        }
        parts.extend((0..targets.points.len()).map(Aim::at_point));
        parts
    }

    /// The handles of these parts pulled to their targets, and all others held where they are.
    fn only(&self, targets: &Handles, set: &[&Aim], x: &[f64]) -> Handles {
        let dim = self.body.dim();
        let pulled: HashSet<u32> = set.iter().flat_map(|part| part.vertices.clone()).collect();
        let mut station = targets.clone();
        station.groups = targets.groups().to_vec();
        // A group of their own, so that no neighbor's travel moves them.
        let held = targets.n_groups() as u32;
        for (i, &v) in targets.vertices.iter().enumerate() {
            if !pulled.contains(&v) {
                let place = &x[dim * v as usize..dim * (v as usize + 1)];
                station.targets[dim * i..dim * (i + 1)].copy_from_slice(place);
                station.groups[i] = held;
            }
        }
        let gaps = Gaps::new(dim, targets, x);
        for i in 0..targets.points.len() {
            if !set.iter().any(|part| part.points.contains(&i)) {
                station.point_targets[dim * i..dim * (i + 1)].copy_from_slice(&gaps.point(i));
            }
        }
        station
    }
}

/// A set in two parts, the last of them first; one alone as it is.
fn halves<T: Copy>(set: &[T]) -> Vec<Vec<T>> {
    let (first, second) = set.split_at(set.len() / 2);
    let parts = [second, first].into_iter().filter(|part| !part.is_empty());
    parts.map(<[T]>::to_vec).collect()
}
