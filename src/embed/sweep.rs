//! Gauss–Seidel: one vertex at a time to where its triangles like it.
//!
//! It removes in linear time the short-waved error that putting vertices back leaves, for which Newton's method would
//! need a factorization of the whole system.

use crate::energy::LocalTerm;
use crate::mesh::VertexFaces;

/// Halvings before a vertex stays where it is.
const MAX_HALVINGS: usize = 8;

/// Steps on a vertex in one visit, at most. A step widens a squeezed triangle by a third, as Newton's method does with 1/x², so
/// that this widens one by a factor of 5,000.
pub(super) const MOST_STEPS: usize = 30;

/// Share of the energy around a vertex that the last step must have taken off for another to follow. Most vertices are left
/// after one; the few that are not would otherwise carry what is left of the whole energy, and cost global steps: eleven
/// factorizations on the finest level instead of six (camelhead), fifteen instead of two (bimba_89k).
pub(super) const WORTH_ANOTHER: f64 = 0.02;

/// Visits every vertex `n_sweeps` times; the energy falls, and stays finite.
pub(super) fn sweep(term: &dyn LocalTerm, stars: &VertexFaces, n_sweeps: usize, x: &mut [f64]) {
    for _ in 0..n_sweeps {
        for v in 0..x.len() as u32 / 2 {
            settle_vertex(term, v, stars.of(v), x);
        }
    }
}

/// Newton steps on the vertex with these triangles around it, while they are worth it.
fn settle_vertex(term: &dyn LocalTerm, vertex: u32, around: &[u32], x: &mut [f64]) {
    for _ in 0..MOST_STEPS {
        if improve_vertex(term, vertex, around, x) < WORTH_ANOTHER {
            return;
        }
    }
}

/// One Newton step on the vertex with these triangles around it, halved until the energy falls; the share of the energy around
/// it that this takes off, 0 if it never falls.
///
/// A triangle's area is linear in one vertex, so no inversion can hide between the end points of a step.
pub(super) fn improve_vertex(
    term: &dyn LocalTerm,
    vertex: u32,
    around: &[u32],
    x: &mut [f64],
) -> f64 {
    let at = 2 * vertex as usize;
    let before = [x[at], x[at + 1]];
    let energy = term.value_around(around, x);
    let mut direction = term
        .derivatives_around(vertex, around, x)
        .newton_direction();
    for _ in 0..MAX_HALVINGS {
        x[at] = before[0] + direction[0];
        x[at + 1] = before[1] + direction[1];
        let new_energy = term.value_around(around, x);
        if new_energy < energy {
            return (energy - new_energy) / energy;
        }
        direction = direction.map(|d| 0.5 * d);
    }
    x[at] = before[0];
    x[at + 1] = before[1];
    0.0
}
