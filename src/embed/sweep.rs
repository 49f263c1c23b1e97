//! Gauss–Seidel: one vertex at a time to where its triangles like it.
//!
//! It removes in linear time the short-waved error that putting vertices back leaves, for which Newton's method would
//! need a factorization of the whole system.

use crate::energy::LocalTerm;

/// Halvings before a vertex stays where it is.
const MAX_HALVINGS: usize = 8;

/// The triangles at each vertex: those of vertex v are `triangles[starts[v]..starts[v + 1]]`.
pub(super) struct Stars {
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Stars {
    pub fn new(n_vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0; n_vertices + 1];
        for &v in triangles.as_flattened() {
            starts[v as usize + 1] += 1;
        }
        for v in 0..n_vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut lists = vec![0; 3 * triangles.len()];
        for (t, triangle) in triangles.iter().enumerate() {
            for &v in triangle {
                lists[next[v as usize] as usize] = t as u32;
                next[v as usize] += 1;
            }
        }
        Self {
            starts,
            triangles: lists,
        }
    }

    fn around(&self, v: usize) -> &[u32] {
        &self.triangles[self.starts[v] as usize..self.starts[v + 1] as usize]
    }
}

/// Visits every vertex `n_sweeps` times; the energy falls, and stays finite.
pub(super) fn sweep(term: &dyn LocalTerm, stars: &Stars, n_sweeps: usize, x: &mut [f64]) {
    for _ in 0..n_sweeps {
        for v in 0..x.len() / 2 {
            improve_vertex(term, v as u32, stars.around(v), x);
        }
    }
}

/// One Newton step on the vertex with these triangles around it, halved until the energy falls; false if it never does.
///
/// A triangle's area is linear in one vertex, so no inversion can hide between the end points of a step.
pub(super) fn improve_vertex(
    term: &dyn LocalTerm,
    vertex: u32,
    around: &[u32],
    x: &mut [f64],
) -> bool {
    let at = 2 * vertex as usize;
    let before = [x[at], x[at + 1]];
    let energy = term.value_around(around, x);
    let mut direction = term
        .derivatives_around(vertex, around, x)
        .newton_direction();
    for _ in 0..MAX_HALVINGS {
        x[at] = before[0] + direction[0];
        x[at + 1] = before[1] + direction[1];
        if term.value_around(around, x) < energy {
            return true;
        }
        direction = direction.map(|d| 0.5 * d);
    }
    x[at] = before[0];
    x[at + 1] = before[1];
    false
}
