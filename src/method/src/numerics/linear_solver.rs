//! Symmetric positive definite systems of any size.
//!
//! A factorization takes memory in proportion to n log n on surfaces, where a minimization peaks at about 2 kB per triangle, and
//! to n^(4/3) in solids: 4 kB per tetrahedron at 50,000, 7 at 100,000, 10 at 500,000 (`tests/bench/scale.rs`,
//! `tests/bench/solids.rs`). It is known before it is taken. Beyond a bound conjugate gradients take over: memory is then in
//! proportion to n, at the price of a time per direction that grows with the number of elements along the mesh.

use super::cholesky::{Cholesky, NotPositiveDefinite, SymmetricPattern, Work};
use super::conjugate_gradients::ConjugateGradients;

/// The memory that a factorization may take, its fronts' updates included. The factor of half a million tetrahedra is 2.4 GB, the
/// whole process then has 4.9 (`tests/bench/solids.rs`).
pub const MOST_BYTES: usize = 6 << 30;

/// A factorization where its memory, which is known once the pattern is analyzed, is within a bound; conjugate gradients beyond.
pub enum LinearSolver {
    /// Factors once for all right sides.
    Direct(Box<Cholesky>),
    /// Starts anew for each.
    Iterative(ConjugateGradients),
}

impl LinearSolver {
    /// For matrices of this pattern, made of blocks as [`Cholesky::analyze`] has them, within so many bytes.
    pub fn within(pattern: &SymmetricPattern, block: usize, most_bytes: usize) -> Self {
        match Cholesky::analyze_within(pattern, block, most_bytes) {
            Some(cholesky) => Self::Direct(Box::new(cholesky)),
            None => Self::Iterative(ConjugateGradients::new(pattern.n)),
        }
    }

    /// Takes a matrix by the values of its lower triangle, to be given again to [`solve`](Self::solve).
    pub fn prepare(&mut self, values: &[f64]) -> Result<(), NotPositiveDefinite> {
        match self {
            Self::Direct(cholesky) => cholesky.factor(values),
            Self::Iterative(_) => Ok(()),
        }
    }

    /// Replaces b by the solution x of Ax = b for the matrix prepared.
    pub fn solve(
        &mut self,
        pattern: &SymmetricPattern,
        values: &[f64],
        x: &mut [f64],
    ) -> Result<(), NotPositiveDefinite> {
        match self {
            Self::Direct(cholesky) => {
                cholesky.solve(x, 1);
                Ok(())
            }
            Self::Iterative(gradients) => gradients.solve(pattern, values, x),
        }
    }

    /// What one factorization takes, if there is one.
    pub fn work(&self) -> Option<Work> {
        match self {
            Self::Direct(cholesky) => Some(cholesky.work()),
            Self::Iterative(_) => None,
        }
    }
}
