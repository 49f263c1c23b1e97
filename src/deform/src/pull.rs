//! Vertices of a map of the plane pulled to targets while others stay fixed.

use serde::Serialize;

use super::aims::Aim;
use super::body::Body;
use super::locate::sole_vertex;
use super::paired::{handles, with_points};
use super::problem::{Model, Problem};
use super::problem_error::ProblemError;
use super::units::Units;
use super::unreached::Unreached;
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

/// Least total weight of movable vertices in a point that is pulled itself: with less, they would have to move more
/// than twice as far as the point.
const LEAST_FREE: f64 = 0.5;

/// Fixed vertices of a planar body, and vertices and points that are pulled; targets in the unit of the body.
pub(super) struct Holds {
    /// Fixed vertices, in increasing order.
    pub fixed: Vec<u32>,
    pub pulled: Vec<(u32, [f64; 2])>,
    pub points: Vec<(Row, [f64; 2])>,
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

    /// Returns one aim per pulled vertex, then one per point.
    fn aims(&self) -> Vec<Aim> {
        let vertices = self.pulled.iter().map(|hold| Aim::at_vertex(hold.0));
        let points = (0..self.points.len()).map(Aim::at_point);
        vertices.chain(points).collect()
    }

    /// Converts unreached [aims](Self::aims) to the caller's handles, with distances in the caller's unit.
    fn named(&self, unreached: Vec<Unreached>, unit: f64) -> Vec<Unreached> {
        let handles = [&self.of_vertices[..], &self.of_points].concat();
        let named = unreached.into_iter().map(|aim| Unreached {
            handle: handles[aim.handle],
            distance: aim.distance * unit,
        });
        let mut named: Vec<Unreached> = named.collect();
        named.sort_by_key(|unreached| unreached.handle);
        named
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
        let bound = handles(2, &[&self.fixed[..], &pulled].concat(), &targets, &groups)?;
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
    let problem = Problem {
        aims: holds.aims(),
        search: how.search,
        ..pulled(body, start, handles, how.model)?
    };
    let solution = problem.solve(&Settings::follow(), watch)?;
    let unreached = holds.named(problem.unreached(&solution), unit);
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
    let is_near = |(x, t): (&f64, &f64)| (x - t).abs() <= ARRIVED * t.abs().max(1.0);
    place.iter().zip(target).all(is_near)
}
