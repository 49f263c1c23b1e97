//! Start at the targets for bodies whose boundary is held: the harmonic map into them, untangled.
//!
//! Handles that move from rest to targets far away may get stuck, because elements in their way are crushed. Where the
//! whole boundary is held there is a way around: the map in which every other vertex is the weighted mean of its
//! neighbors needs no path. In the plane it is valid if the targets are convex (Tutte 1963); otherwise some of its
//! elements are inverted, and untangling repairs them.
//!
//! A boundary that is not held gives no such map: its free vertices would shrink to their mean.

use super::body::{Body, BodyElements};
use super::problem::{Problem, parts};
use super::untangle::{bad_elements, untangled, unwatched};
use unwrapd_method::energy::{RestShape, dirichlet};
use unwrapd_method::solver::Objective;

impl Problem {
    /// Returns the vertices that stay in a [start at the targets](Self::start_at_targets): the held ones and those of
    /// parts without handles. `None` where there is no such start, or no need of one: a part with handles has a boundary
    /// vertex that is not held, something is at its targets only along a path, as a disc that turns, or the boundary
    /// is at its targets from the start.
    pub(super) fn held_with_boundary(&self) -> Option<Vec<u32>> {
        let [handles] = &self.stations[..] else {
            return None;
        };
        let is_along_path = !self.turned.is_empty() || !handles.points.is_empty();
        if is_along_path {
            return None;
        }
        let (part, n_parts) = parts(&self.body);
        let mut is_held = vec![false; self.body.n_vertices()];
        let mut has_handles = vec![false; n_parts];
        for &v in &handles.vertices {
            is_held[v as usize] = true;
            has_handles[part[v as usize] as usize] = true;
        }
        let is_free = |v: u32| !is_held[v as usize] && has_handles[part[v as usize] as usize];
        let boundary = (self.body.elements).boundary_vertices(self.body.n_vertices());
        let mut has_arrived = vec![false; self.body.n_vertices()];
        for v in self.arrived() {
            has_arrived[v as usize] = true;
        }
        let is_still = |&v: &u32| has_arrived[v as usize] || !is_held[v as usize];
        if boundary.iter().any(|&v| is_free(v)) || boundary.iter().all(is_still) {
            return None;
        }
        let vertices = 0..self.body.n_vertices() as u32;
        Some(vertices.filter(|&v| !is_free(v)).collect())
    }

    /// Returns a map without inversions in which the handles are exactly at their last targets and the vertices `held`
    /// stay, whatever the start of the others; `None` if no such map is found.
    ///
    /// Costs a linear system, and the untangling if that leaves inversions.
    pub(super) fn start_at_targets(&self, held: &[u32]) -> Option<Vec<f64>> {
        let mut x = self.at_targets();
        map_harmonically(&self.body, held, &mut x)?;
        let floor = self.floor();
        if bad_elements(&self.body, &x, floor).is_empty() {
            return Some(x);
        }
        untangled(&self.body, &x, held, floor, &unwatched).ok()
    }

    /// Returns the start with the held vertices at their last targets.
    fn at_targets(&self) -> Vec<f64> {
        let dim = self.body.dim();
        let mut x = self.start.clone();
        if let Some(handles) = self.stations.last() {
            let targets = handles.targets.chunks_exact(dim);
            for (&v, target) in handles.vertices.iter().zip(targets) {
                x[dim * v as usize..dim * (v as usize + 1)].copy_from_slice(target);
            }
        }
        x
    }
}

/// Moves the free vertices to the harmonic map of regular elements: each becomes the mean of its neighbors, in which
/// every edge weighs as much as it has elements. All weights are positive, whatever the shapes at rest.
fn map_harmonically(body: &Body, held: &[u32], x: &mut [f64]) -> Option<()> {
    let corners = body.corners();
    let (n, zeros) = (corners.len(), vec![0.0; x.len()]);
    let height = 0.75_f64.sqrt();
    let energy = match &body.elements {
        BodyElements::Triangles { .. } => {
            let regular = RestShape::from_edges([1.0, 0.0], [0.5, height]);
            dirichlet(&corners, &vec![regular; n], &vec![1.0; n], zeros)
        }
        BodyElements::Tetrahedra { .. } => {
            let apex = [0.5, height / 3.0, (2.0_f64 / 3.0).sqrt()];
            let base = [[0.0; 3], [1.0, 0.0, 0.0], [0.5, height, 0.0]];
            let [a, b, c] = base;
            let regular = RestShape::from_tetrahedron([a, b, c, apex]);
            dirichlet(&corners, &vec![regular; n], &vec![1.0; n], zeros)
        }
    };
    // The energy is quadratic: one Newton step leads to its minimum.
    let mut objective = Objective::new(body.n_vertices(), Box::new(energy));
    objective.fix(held);
    objective.linearize(x, 1.0);
    let mut step = vec![0.0; x.len()];
    objective.newton_direction(&mut step).ok()?;
    for (x, d) in x.iter_mut().zip(step) {
        *x += d;
    }
    Some(())
}
