//! Handles that did not reach their targets.

use std::collections::HashMap;

use serde::Serialize;

use super::aims::Aim;
use super::normalized::Frame;
use super::problem::Problem;
use super::solve::Solution;
use unwrapd_method::solver::{Handles, Status};

/// Largest distance of a held vertex from its target, as a share of the longest side of the body and the targets.
const EXACT: f64 = 1e-12;
/// Distance within which handles held by soft constraints count as arrived, as a share of a mean element's edge.
const ARRIVED: f64 = 1e-6;

/// A handle that did not come to its target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Unreached {
    /// Its place in the list of handles, from 0.
    pub handle: usize,
    /// Distance from its target, in the unit of the mesh: the largest over everything that it holds.
    pub distance: f64,
}

impl Problem {
    /// Returns the handles that did not reach their targets, in the order of their list.
    pub fn unreached(&self, solution: &Solution) -> Vec<Unreached> {
        let Some(targets) = self.stations.last() else {
            return Vec::new();
        };
        if matches!(solution.summary.status, Status::Converged | Status::Stalled) {
            return Vec::new();
        }
        let gaps = Gaps::new(self.body.dim(), targets, &solution.x);
        let least = self.least_gap();
        let of_handle = |(handle, aim)| Unreached {
            handle,
            distance: gaps.of(aim),
        };
        let all: Vec<Unreached> = self.aims.iter().enumerate().map(of_handle).collect();
        let beyond = |least: f64| {
            // Also where the distance is no number.
            let is_off = |handle: &&Unreached| !matches!(handle.distance, d if d <= least);
            all.iter().filter(is_off).copied().collect::<Vec<_>>()
        };
        let missed = beyond(least);
        if missed.is_empty() && solution.summary.status == Status::TargetsUnreachable {
            return beyond(self.rounding());
        }
        missed
    }

    /// Returns whether every held vertex is within `most` of its target, and every held point as near as soft
    /// constraints bring it.
    pub(super) fn is_at_targets(&self, x: &[f64], most: f64) -> bool {
        let Some(targets) = self.stations.last() else {
            return true;
        };
        let gaps = Gaps::new(self.body.dim(), targets, x);
        let near = self.least_gap();
        (0..targets.vertices.len()).all(|i| gaps.of_vertex(i) <= most)
            && (0..targets.points.len()).all(|i| gaps.of_point(i) <= near)
    }

    /// Returns the rounding error of the distance of a held vertex from its target.
    pub(super) fn rounding(&self) -> f64 {
        EXACT * self.size()
    }

    /// Returns the longest side of the box around the body and the targets.
    fn size(&self) -> f64 {
        let dim = self.body.dim();
        let targets = self.stations.last().map_or(&[][..], |last| &last.targets);
        let side = |k: usize| {
            let of = |all: &'_ [f64]| {
                let along = all.iter().skip(k).step_by(dim);
                along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| {
                    [low.min(x), high.max(x)]
                })
            };
            let [[a, b], [c, d]] = [of(&self.body.rest), of(targets)];
            b.max(d) - a.min(c)
        };
        (0..dim).map(side).fold(0.0, f64::max)
    }

    /// Returns the distance below which a handle counts as arrived.
    pub(super) fn least_gap(&self) -> f64 {
        ARRIVED * Frame::of(&self.body).squared(1.0).sqrt()
    }
}

/// Distances of handles from their targets.
pub(super) struct Gaps<'a> {
    dim: usize,
    targets: &'a Handles,
    x: &'a [f64],
    /// Index of each held vertex among the handles.
    places: HashMap<u32, usize>,
}

impl<'a> Gaps<'a> {
    /// Measures the map `x` with `dim` coordinates per vertex.
    pub fn new(dim: usize, targets: &'a Handles, x: &'a [f64]) -> Self {
        Self {
            dim,
            targets,
            x,
            places: targets.vertices.iter().copied().zip(0..).collect(),
        }
    }

    /// Returns the largest distance among the vertices and points of a handle.
    pub fn of(&self, aim: &Aim) -> f64 {
        let held = aim.vertices.iter().filter_map(|v| self.places.get(v));
        let distances = held.map(|&i| self.of_vertex(i));
        let distances = distances.chain(aim.points.iter().map(|&i| self.of_point(i)));
        distances.fold(0.0, f64::max)
    }

    /// Returns the distance of the `i`-th held vertex.
    fn of_vertex(&self, i: usize) -> f64 {
        let first = self.dim * self.targets.vertices[i] as usize;
        let at = |k: usize| self.x[first + k] - self.targets.targets[self.dim * i + k];
        (0..self.dim).map(|k| at(k) * at(k)).sum::<f64>().sqrt()
    }

    /// Returns the distance of a point.
    fn of_point(&self, i: usize) -> f64 {
        let place = self.point(i);
        let targets = self.targets.point_targets[self.dim * i..].iter();
        let squares = place.iter().zip(targets).map(|(x, t)| (x - t) * (x - t));
        squares.sum::<f64>().sqrt()
    }

    /// Returns the position of a point.
    pub fn point(&self, i: usize) -> Vec<f64> {
        let mut place = vec![0.0; self.dim];
        for &(v, weight) in &self.targets.points[i] {
            let corner = &self.x[self.dim * v as usize..];
            for (sum, x) in place.iter_mut().zip(corner) {
                *sum += weight * x;
            }
        }
        place
    }
}
