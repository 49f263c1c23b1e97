//! Gauss–Seidel: one vertex at a time to where its triangles like it.
//!
//! It removes in linear time the short-waved error that putting vertices back leaves, for which Newton's method would
//! need a factorization of the whole system.

use crate::energy::LocalTerm;
use crate::mesh::VertexFaces;

/// Halvings before a vertex stays where it is.
const MAX_HALVINGS: usize = 8;

/// Visits every vertex `n_sweeps` times; the energy falls, and stays finite.
pub(super) fn sweep(term: &dyn LocalTerm, stars: &VertexFaces, n_sweeps: usize, x: &mut [f64]) {
    for _ in 0..n_sweeps {
        for v in 0..x.len() as u32 / 2 {
            improve_vertex(term, v, stars.of(v), x);
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
