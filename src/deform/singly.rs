//! Handles that can be reached, beside those that cannot.

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
        let mut missing = self.missing(targets, &best.x);
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

    /// The ways whose handles are not at their targets, by their numbers.
    fn missing(&self, targets: &Handles, x: &[f64]) -> Vec<usize> {
        let dim = self.body.dim();
        let gaps = Gaps { dim, targets, x };
        let mut of_ways = vec![0.0_f64; targets.n_ways()];
        for (i, &group) in targets.groups().iter().enumerate() {
            let gap = &mut of_ways[group as usize];
            *gap = gap.max(gaps.of_vertex(i));
        }
        let of_points = of_ways[targets.n_groups()..].iter_mut();
        for (i, gap) in of_points.enumerate() {
            *gap = gaps.of_point(i);
        }
        let least = self.least_gap();
        let left = of_ways.iter().enumerate().filter(|(_, gap)| **gap > least);
        left.map(|(way, _)| way).collect()
    }

    /// The handles of these ways pulled to their targets, and all others held where they are.
    fn only(&self, targets: &Handles, set: &[usize], x: &[f64]) -> Handles {
        let dim = self.body.dim();
        let mut station = targets.clone();
        let groups = targets.groups();
        for (i, (&v, &group)) in targets.vertices.iter().zip(&*groups).enumerate() {
            if !set.contains(&(group as usize)) {
                let place = &x[dim * v as usize..dim * (v as usize + 1)];
                station.targets[dim * i..dim * (i + 1)].copy_from_slice(place);
            }
        }
        let gaps = Gaps { dim, targets, x };
        let n_groups = targets.n_groups();
        for i in 0..targets.points.len() {
            if !set.contains(&(n_groups + i)) {
                station.point_targets[dim * i..dim * (i + 1)].copy_from_slice(&gaps.point(i));
            }
        }
        station
    }
}

/// A set in two parts, the last of them first; one alone as it is.
fn halves(set: &[usize]) -> Vec<Vec<usize>> {
    let (first, second) = set.split_at(set.len() / 2);
    let parts = [second, first].into_iter().filter(|part| !part.is_empty());
    parts.map(<[usize]>::to_vec).collect()
}
