//! Vertices of a map of the plane pulled to targets while others stay fixed.

use super::body::{Body, sole_vertex};
use super::handles::{Aim, paired_handles, with_points};
use super::line::{HeldPoint, LEAST_FREE};
use super::normalized::Frame;
use super::problem::{Model, Problem, Units};
use super::problem_error::ProblemError;
use super::soft::SoftPull;
use super::solve::Solution;
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use unwrapd_method::barrier::epsilon;
use unwrapd_method::energy::Row;
use unwrapd_method::solver::{Handles, LevenbergSettings, Settings, Status, Watch};

/// Distance from its target within which a vertex counts as arrived, for a mean triangle of area 1; it is then put
/// exactly on the target.
const ARRIVED: f64 = 1e-9;

/// Outcome and cost of pulling a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PullSummary {
    /// Status at the end.
    pub status: Status,
    /// Steps taken.
    pub iterations: usize,
    /// Matrices factored.
    pub factorizations: usize,
    /// The energy without the barrier, for a mean triangle of area 1.
    pub energy: f64,
    /// The sum of the squared distances of what is pulled from its targets, in the caller's unit.
    pub residual: f64,
    /// The smallest area of a triangle over its area at rest.
    pub smallest: f64,
    /// The handles that did not come to their targets, in the order of their list; distances in the caller's unit.
    pub unreached: Vec<Unreached>,
}

/// Fixed vertices of a planar body, and vertices and points that are pulled; targets in the unit of the body.
pub(super) struct Holds {
    /// Fixed vertices, in increasing order.
    pub fixed: Vec<u32>,
    pub pulled: Vec<(u32, [f64; 2])>,
    pub points: Vec<(Row, [f64; 2])>,
    /// Pull of the handles with weights.
    pub soft: SoftPull,
    /// For each pulled vertex the index of its handle in the caller's list, and likewise for each point.
    of_vertices: Vec<usize>,
    of_points: Vec<usize>,
}

/// The part of the map that a handle at a point pulls.
pub(super) enum Grip {
    /// Nothing: the vertices around the point stay fixed.
    Fixed,
    /// A vertex: the one at the point or, near fixed vertices, another of its triangle.
    Vertex(u32),
    /// The point itself.
    Point(Row),
}

impl Holds {
    /// Fixes these vertices; nothing is pulled yet.
    pub fn new(fixed: Vec<u32>) -> Self {
        Self {
            fixed,
            pulled: Vec::new(),
            points: Vec::new(),
            soft: SoftPull::default(),
            of_vertices: Vec::new(),
            of_points: Vec::new(),
        }
    }

    /// Lets a handle pull a vertex.
    pub fn pull_vertex(&mut self, handle: usize, vertex: u32, to: [f64; 2]) {
        self.pulled.push((vertex, to));
        self.of_vertices.push(handle);
    }

    /// Lets a handle pull a point.
    pub fn pull_point(&mut self, handle: usize, row: Row, to: [f64; 2]) {
        self.points.push((row, to));
        self.of_points.push(handle);
    }

    /// Lets a handle pull vertices and points, softly if it has a weight.
    pub fn pull(&mut self, handle: usize, held: Vec<HeldPoint<2>>, weight: Option<f64>) {
        if let Some(weight) = weight {
            self.soft.pull(&held, weight);
            return;
        }
        for (row, to) in held {
            match sole_vertex(&row) {
                Some(vertex) => self.pull_vertex(handle, vertex, to),
                None => self.pull_point(handle, row, to),
            }
        }
    }

    /// Returns which vertices are fixed, pulled or corners of pulled points.
    pub fn taken(&self, n_vertices: usize) -> Vec<bool> {
        let mut is_taken = vec![false; n_vertices];
        let pulled = self.pulled.iter().map(|hold| hold.0);
        let of_points = self
            .points
            .iter()
            .flat_map(|(row, _)| row)
            .map(|pair| pair.0);
        for v in self.fixed.iter().copied().chain(pulled).chain(of_points) {
            is_taken[v as usize] = true;
        }
        is_taken
    }

    pub fn is_fixed(&self, vertex: u32) -> bool {
        self.fixed.binary_search(&vertex).is_ok()
    }

    /// Returns what a handle at a point of an element pulls.
    pub fn grip(&self, row: Row) -> Grip {
        if let Some(vertex) = sole_vertex(&row) {
            return if self.is_fixed(vertex) {
                Grip::Fixed
            } else {
                Grip::Vertex(vertex)
            };
        }
        let free = || row.iter().filter(|(vertex, _)| !self.is_fixed(*vertex));
        if free().map(|(_, weight)| weight).sum::<f64>() >= LEAST_FREE {
            return Grip::Point(row);
        }
        let heaviest = free().max_by(|a, b| a.1.total_cmp(&b.1));
        heaviest.map_or(Grip::Fixed, |&(vertex, _)| Grip::Vertex(vertex))
    }

    /// Returns the vertices and points that each of the caller's handles pulls, by the number of the handle.
    fn aims(&self) -> BTreeMap<usize, Aim> {
        let mut aims: BTreeMap<usize, Aim> = BTreeMap::new();
        for (handle, (vertex, _)) in self.of_vertices.iter().zip(&self.pulled) {
            aims.entry(*handle).or_default().vertices.push(*vertex);
        }
        for (point, handle) in self.of_points.iter().enumerate() {
            aims.entry(*handle).or_default().points.push(point);
        }
        aims
    }

    /// Returns the handles of all fixed and pulled vertices and points. Fixed vertices form a group of their own, so
    /// that no neighbor's motion moves them.
    pub fn handles(&self, body: &Body, start: &[[f64; 2]]) -> Result<Handles, ProblemError> {
        let pulled: Vec<u32> = self.pulled.iter().map(|hold| hold.0).collect();
        let mut groups = vec![0; self.fixed.len()];
        groups.extend(body.groups(&pulled).into_iter().map(|group| group + 1));
        let stay = self.fixed.iter().map(|&v| start[v as usize]);
        let targets = stay.chain(self.pulled.iter().map(|hold| hold.1));
        let targets: Vec<Vec<f64>> = targets.map(Vec::from).collect();
        let bound = paired_handles(2, &[&self.fixed[..], &pulled].concat(), &targets, &groups)?;
        let (points, point_targets): (Vec<Row>, Vec<[f64; 2]>) =
            self.points.iter().cloned().unzip();
        with_points(bound, points, point_targets.into_flattened())
    }
}

/// A map of the plane after pulling.
pub(super) struct PulledMap {
    /// Positions in the unit of the body.
    pub vertices: Vec<[f64; 2]>,
    pub summary: PullSummary,
}

/// Settings of a pull.
pub(super) struct How<'a> {
    pub model: &'a Model,
    /// See [`Problem::search`].
    pub search: bool,
    /// The body's unit of length in the caller's unit.
    pub unit: f64,
}

/// Pulls vertices of a planar body whose mean triangle has an area of about 1.
pub(super) fn pull(
    body: Body,
    start: &[[f64; 2]],
    holds: &Holds,
    how: &How,
    watch: &dyn Watch,
) -> Result<PulledMap, ProblemError> {
    // Pull, and collect the handles that did not arrive.
    let (handles, unit) = (holds.handles(&body, start)?, how.unit);
    let aims = holds.aims();
    let problem = Problem {
        aims: aims.values().cloned().collect(),
        search: how.search,
        ..pulled(body, start, handles, holds.soft.clone(), how.model)?
    };
    let solution = problem.approach(&Settings::follow(), watch)?;
    let numbers: Vec<usize> = aims.into_keys().collect();
    let unreached = problem.unreached(&solution).into_iter();
    let unreached = unreached.map(|aim| Unreached {
        handle: numbers[aim.handle],
        distance: aim.distance * unit,
    });
    let unreached: Vec<Unreached> = unreached.collect();
    // Move the vertices that arrived onto their targets, exactly.
    let mut vertices = solution.x.as_chunks::<2>().0.to_vec();
    arrive(&mut vertices, &problem.stations[0]);
    // Measure that map with energies for a mean triangle of area 1.
    let normalized = Problem {
        units: Units::Normalized,
        ..problem
    };
    let quality = normalized.quality(vertices.as_flattened());
    Ok(PulledMap {
        summary: PullSummary {
            status: solution.summary.status,
            iterations: solution.summary.iterations,
            factorizations: solution.summary.factorizations,
            energy: quality.energy,
            residual: quality.residual * unit * unit,
            smallest: quality.smallest,
            unreached,
        },
        vertices,
    })
}

/// Creates the problem of a planar body whose mean triangle has an area of about 1.
pub(super) fn pulled(
    body: Body,
    start: &[[f64; 2]],
    handles: Handles,
    soft: SoftPull,
    model: &Model,
) -> Result<Problem, ProblemError> {
    let smallest = |sizes: Vec<f64>| sizes.into_iter().fold(f64::INFINITY, f64::min);
    let epsilon = epsilon(
        smallest(body.determinants()),
        smallest(body.determinants_at(start.as_flattened())),
    );
    let problem = Problem {
        start: start.as_flattened().to_vec(),
        untangled: 0,
        energy: model.energy.clone(),
        bound: model.max_conformal,
        boundary_barrier: None,
        barrier: model.barrier(&body, Some(epsilon))?,
        stations: vec![handles],
        turned: Vec::new(),
        aims: Vec::new(),
        soft,
        search: false,
        levenberg: LevenbergSettings::default(),
        units: Units::Given,
        body,
    };
    problem.guarded(model)
}

/// Puts vertices that are at their targets up to rounding exactly on them.
pub(super) fn arrive(vertices: &mut [[f64; 2]], handles: &Handles) {
    let targets = handles.targets.as_chunks::<2>().0;
    for (&v, target) in handles.vertices.iter().zip(targets) {
        let place = &mut vertices[v as usize];
        if is_arrived(place, target) {
            *place = *target;
        }
    }
}

/// Returns whether a place is the target up to rounding.
pub(super) fn is_arrived(place: &[f64], target: &[f64]) -> bool {
    place
        .iter()
        .zip(target)
        .all(|(x, t): (&f64, &f64)| (x - t).abs() <= ARRIVED * t.abs().max(1.0))
}

// Handles that did not reach their targets.

/// Largest distance of a held vertex from its target, as a share of the longest side of the body and the targets.
const EXACT: f64 = 1e-12;
/// Distance within which handles held by soft constraints count as arrived, as a share of a mean element's edge.
const REACHED: f64 = 1e-6;

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
        let gaps = TargetDistances::new(self.body.dim(), targets, &solution.x);
        let least = self.least_gap();
        let all: Vec<Unreached> = self
            .aims
            .iter()
            .enumerate()
            .map(|(handle, aim)| Unreached {
                handle,
                distance: gaps.of(aim),
            })
            .collect();
        let beyond = |least: f64| {
            // Also where the distance is no number.
            all.iter()
                .filter(|handle: &&Unreached| !matches!(handle.distance, d if d <= least))
                .copied()
                .collect::<Vec<_>>()
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
        let gaps = TargetDistances::new(self.body.dim(), targets, x);
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
        REACHED * Frame::of(&self.body).squared(1.0).sqrt()
    }
}

/// Distances of handles from their targets.
pub(super) struct TargetDistances<'a> {
    dim: usize,
    targets: &'a Handles,
    x: &'a [f64],
    /// Index of each held vertex among the handles.
    places: HashMap<u32, usize>,
}

impl<'a> TargetDistances<'a> {
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
