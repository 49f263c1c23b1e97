//! Handles that did not come to their targets.

use std::collections::HashMap;

use serde::Serialize;

use super::aims::Aim;
use super::normalized::Frame;
use super::problem::Problem;
use super::solve::Solution;
use crate::solver::Handles;

/// What counts as arrived: a distance of this share of a mean element's edge.
const ARRIVED: f64 = 1e-6;

/// A handle that did not come to its target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Unreached {
    /// Its place in the list of handles, from 0.
    pub handle: usize,
    /// How far it is from its target, in the unit of the mesh: of what it holds, what is farthest.
    pub distance: f64,
}

impl Problem {
    /// The handles that did not come to their targets, in the order of their list; none of a solution that has arrived.
    pub fn unreached(&self, solution: &Solution) -> Vec<Unreached> {
        let Some(targets) = self.stations.last().filter(|_| !solution.has_arrived()) else {
            return Vec::new();
        };
        let gaps = Gaps::new(self.body.dim(), targets, &solution.x);
        let least = self.least_gap();
        let of_handle = |(handle, aim)| Unreached {
            handle,
            distance: gaps.of(aim),
        };
        let all = self.aims.iter().enumerate().map(of_handle);
        all.filter(|handle| handle.distance > least).collect()
    }

    /// A distance that counts as none.
    pub(super) fn least_gap(&self) -> f64 {
        ARRIVED * Frame::of(&self.body).squared(1.0).sqrt()
    }
}

/// How far handles are from their targets.
pub(super) struct Gaps<'a> {
    dim: usize,
    targets: &'a Handles,
    x: &'a [f64],
    /// The place of each held vertex among the handles.
    places: HashMap<u32, usize>,
}

impl<'a> Gaps<'a> {
    /// In the map `x` of so many coordinates to a vertex.
    pub fn new(dim: usize, targets: &'a Handles, x: &'a [f64]) -> Self {
        Self {
            dim,
            targets,
            x,
            places: targets.vertices.iter().copied().zip(0..).collect(),
        }
    }

    /// Of all that a handle holds, the largest.
    pub fn of(&self, aim: &Aim) -> f64 {
        let held = aim.vertices.iter().filter_map(|v| self.places.get(v));
        let distances = held.map(|&i| self.of_vertex(i));
        let distances = distances.chain(aim.points.iter().map(|&i| self.of_point(i)));
        distances.fold(0.0, f64::max)
    }

    /// Of the handle at a vertex, by its place among them.
    fn of_vertex(&self, i: usize) -> f64 {
        let first = self.dim * self.targets.vertices[i] as usize;
        let at = |k: usize| self.x[first + k] - self.targets.targets[self.dim * i + k];
        (0..self.dim).map(|k| at(k) * at(k)).sum::<f64>().sqrt()
    }

    /// Of a point.
    fn of_point(&self, i: usize) -> f64 {
        let place = self.point(i);
        let targets = self.targets.point_targets[self.dim * i..].iter();
        let squares = place.iter().zip(targets).map(|(x, t)| (x - t) * (x - t));
        squares.sum::<f64>().sqrt()
    }

    /// Where a point is.
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
