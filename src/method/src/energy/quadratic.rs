//! Quadratic forms of the displacement.

use super::{Assembly, Term};
use crate::numerics::stencils::Stencils;

/// ½ Σᵢⱼ Qᵢⱼ (xᵢ − x⁰ᵢ)·(xⱼ − x⁰ⱼ): one symmetric positive semidefinite matrix Q over the vertices, the same for each
/// coordinate, on displacements from the rest positions x⁰.
///
/// Minimum 0, at rest. Domain: everywhere. From: Schüller et al. 2013, section 4 (Dirichlet, Laplacian). Tests:
/// `energy::taylor_quadratic`.
pub struct Quadratic {
    dim: usize,
    rest: Vec<f64>,
    diagonal: Vec<f64>,
    /// Row, column < row, entry.
    entries: Vec<(u32, u32, f64)>,
    /// For each vertex the start of its row in `rows`, whose items are the other vertex and the entry.
    starts: Vec<usize>,
    rows: Vec<(u32, f64)>,
}

impl Quadratic {
    /// Creates the energy. `rest` holds `dim` coordinates per vertex; Q is given by its diagonal and every entry `(row,
    /// column, value)` with row > column, each at most once.
    pub fn new(
        dim: usize,
        rest: Vec<f64>,
        diagonal: Vec<f64>,
        entries: Vec<(u32, u32, f64)>,
    ) -> Self {
        debug_assert!(entries.iter().all(|&(row, column, _)| row > column));
        let (starts, rows) = rows(diagonal.len(), &entries);
        Self {
            dim,
            rest,
            diagonal,
            entries,
            starts,
            rows,
        }
    }

    /// Returns a coordinate of Q times the displacement.
    fn image(&self, x: &[f64], coordinate: usize) -> f64 {
        let (vertex, k) = (coordinate / self.dim, coordinate % self.dim);
        let moved = |coordinate: usize| x[coordinate] - self.rest[coordinate];
        let mut image = self.diagonal[vertex] * moved(coordinate);
        for &(other, q) in &self.rows[self.starts[vertex]..self.starts[vertex + 1]] {
            image += q * moved(self.dim * other as usize + k);
        }
        image
    }
}

/// Expands the lower triangle of a symmetric matrix to whole rows, each in the order of `entries`.
fn rows(n: usize, entries: &[(u32, u32, f64)]) -> (Vec<usize>, Vec<(u32, f64)>) {
    let mut starts = vec![0; n + 1];
    for &(row, column, _) in entries {
        starts[row as usize + 1] += 1;
        starts[column as usize + 1] += 1;
    }
    for vertex in 0..n {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut rows = vec![(0, 0.0); 2 * entries.len()];
    for &(row, column, q) in entries {
        for (vertex, other) in [(row, column), (column, row)] {
            rows[next[vertex as usize]] = (other, q);
            next[vertex as usize] += 1;
        }
    }
    (starts, rows)
}

impl Term for Quadratic {
    fn dim(&self) -> usize {
        self.dim
    }

    fn stencils(&self) -> Stencils {
        let pairs = self
            .entries
            .iter()
            .flat_map(|&(row, column, _)| [column, row]);
        Stencils::uniform(2, pairs)
    }

    fn value(&self, x: &[f64]) -> f64 {
        let moves = x.iter().zip(&self.rest).map(|(x, rest)| x - rest);
        let products = moves.enumerate().map(|(i, y)| self.image(x, i) * y);
        0.5 * products.sum::<f64>()
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for i in 0..x.len() {
            assembly.add_to_gradient(i, self.image(x, i));
        }
        for (vertex, &q) in self.diagonal.iter().enumerate() {
            assembly.add_diagonal_identity(vertex as u32, q);
        }
        for (index, &(_, _, q)) in self.entries.iter().enumerate() {
            assembly.add_pair_identity(index, 0, q);
        }
    }
}
