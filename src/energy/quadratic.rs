//! Energies of the displacement that are quadratic forms.

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
}

impl Quadratic {
    /// `rest` holds `dim` coordinates per vertex; of Q the diagonal, and every entry `(row, column, value)` with
    /// row > column, each at most once.
    pub fn new(
        dim: usize,
        rest: Vec<f64>,
        diagonal: Vec<f64>,
        entries: Vec<(u32, u32, f64)>,
    ) -> Self {
        debug_assert!(entries.iter().all(|&(row, column, _)| row > column));
        Self {
            dim,
            rest,
            diagonal,
            entries,
        }
    }

    fn displacement(&self, x: &[f64]) -> Vec<f64> {
        x.iter().zip(&self.rest).map(|(x, rest)| x - rest).collect()
    }

    /// Q times a displacement.
    fn image(&self, y: &[f64]) -> Vec<f64> {
        let diagonal = y.iter().enumerate();
        let mut image: Vec<f64> = diagonal
            .map(|(i, y)| self.diagonal[i / self.dim] * y)
            .collect();
        for &(row, column, q) in &self.entries {
            let (row, column) = (self.dim * row as usize, self.dim * column as usize);
            for k in 0..self.dim {
                image[row + k] += q * y[column + k];
                image[column + k] += q * y[row + k];
            }
        }
        image
    }
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
        let y = self.displacement(x);
        0.5 * self
            .image(&y)
            .iter()
            .zip(&y)
            .map(|(q, y)| q * y)
            .sum::<f64>()
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for (i, g) in self.image(&self.displacement(x)).into_iter().enumerate() {
            assembly.add_to_gradient(i, g);
        }
        for (vertex, &q) in self.diagonal.iter().enumerate() {
            assembly.add_diagonal_identity(vertex as u32, q);
        }
        for (index, &(_, _, q)) in self.entries.iter().enumerate() {
            assembly.add_pair_identity(index, 0, q);
        }
    }
}
