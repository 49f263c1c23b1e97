//! Soft positional constraints.

use super::{Assembly, Term};
use crate::numerics::stencils::Stencils;

/// A linear function of positions with a target value: vertices, in increasing order, with their weights. For a point
/// in an element these are its barycentric coordinates.
pub type Row = Vec<(u32, f64)>;

/// α‖Cx − t‖² with a sparse C that is the same for each coordinate.
///
/// Minimum 0, where Cx = t. Unit: α times a length squared. Domain: everywhere. From: Schüller et al. 2013, equation 9.
/// Tests: `energy::taylor_positional`.
#[derive(Clone, Debug)]
pub struct Positional {
    /// Coordinates per position.
    pub dim: usize,
    /// The rows of C.
    pub rows: Vec<Row>,
    /// t: a position for each row, coordinates one after another.
    pub targets: Vec<f64>,
    /// α, the strength.
    pub alpha: f64,
}

impl Positional {
    /// Iterates over Cx: the position of each row, coordinates one after another.
    pub fn places<'a>(&'a self, x: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let rows = self.rows.iter();
        rows.flat_map(move |row| (0..self.dim).map(move |k| self.place(row, k, x)))
    }

    /// Returns coordinate `k` of the position of a row.
    fn place(&self, row: &Row, k: usize, x: &[f64]) -> f64 {
        let weighted = row.iter().map(|&(v, w)| w * x[self.dim * v as usize + k]);
        weighted.sum()
    }

    /// Adds 2αCᵀ·`moves` to `sum`: the growth of the negative gradient when the targets move.
    pub fn add_pull(&self, moves: &[f64], sum: &mut [f64]) {
        for (row, moves) in self.rows.iter().zip(moves.chunks(self.dim)) {
            for &(v, weight) in row {
                for (k, t) in moves.iter().enumerate() {
                    sum[self.dim * v as usize + k] += 2.0 * self.alpha * weight * t;
                }
            }
        }
    }

    /// Returns ‖Cx − d‖² for these positions d.
    pub fn residual(&self, x: &[f64], targets: &[f64]) -> f64 {
        let gaps = self.places(x).zip(targets).map(|(place, t)| place - t);
        gaps.map(|gap| gap * gap).sum()
    }
}

impl Term for Positional {
    fn dim(&self) -> usize {
        self.dim
    }

    fn stencils(&self) -> Stencils {
        let vertices: Vec<Vec<u32>> = (self.rows.iter())
            .map(|row| row.iter().map(|&(v, _)| v).collect())
            .collect();
        Stencils::of(vertices.iter().map(Vec::as_slice))
    }

    fn value(&self, x: &[f64]) -> f64 {
        self.alpha * self.residual(x, &self.targets)
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for (index, row) in self.rows.iter().enumerate() {
            for k in 0..self.dim {
                let gap = self.place(row, k, x) - self.targets[self.dim * index + k];
                for &(v, weight) in row {
                    let share = 2.0 * self.alpha * weight * gap;
                    assembly.add_to_gradient(self.dim * v as usize + k, share);
                }
            }
            let mut pair = 0;
            for (j, &(v, weight)) in row.iter().enumerate() {
                let factor = 2.0 * self.alpha * weight;
                assembly.add_diagonal_identity(v, factor * weight);
                for &(_, other) in &row[..j] {
                    assembly.add_pair_identity(index, pair, factor * other);
                    pair += 1;
                }
            }
        }
    }
}
