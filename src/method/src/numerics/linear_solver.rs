//! Symmetric positive definite systems of any size.
//!
//! A factorization takes memory in proportion to n log n on surfaces, where a minimization peaks at about 2 kB per
//! triangle, and to n^(4/3) in solids: 4 kB per tetrahedron at 50,000, 7 at 100,000, 10 at 500,000
//! (`tests/bench/scale.rs`, `tests/bench/solids.rs`). The amount is known before it is allocated. Beyond a bound
//! conjugate gradients take over: memory is then in proportion to n, but the time per direction grows with the number
//! of elements along the mesh.

use super::cholesky::{Cholesky, NotPositiveDefinite, SymmetricPattern, Work};
use super::conjugate_gradients::ConjugateGradients;

/// Most memory of a factorization, including the updates of its fronts. The factor of half a million tetrahedra is 2.4
/// GB, the whole process then has 4.9 (`tests/bench/solids.rs`).
pub const MOST_BYTES: usize = 6 << 30;

/// A factorization if its memory, which is known once the pattern is analyzed, is within a bound; otherwise conjugate
/// gradients.
pub enum LinearSolver {
    /// Factors once for all right-hand sides.
    Direct(Box<Cholesky>),
    /// Iterates anew for each right-hand side.
    Iterative(ConjugateGradients),
}

impl LinearSolver {
    /// Creates a solver for matrices of this pattern, made of blocks as in [`Cholesky::analyze`], within `most_bytes`.
    pub fn within(pattern: &SymmetricPattern, block: usize, most_bytes: usize) -> Self {
        match Cholesky::analyze_within(pattern, block, most_bytes) {
            Some(cholesky) => Self::Direct(Box::new(cholesky)),
            None => Self::Iterative(ConjugateGradients::new(pattern.n)),
        }
    }

    /// Prepares solving with a matrix, given by the values of its lower triangle; the same values must be passed to
    /// [`solve`](Self::solve).
    pub fn prepare(&mut self, values: &[f64]) -> Result<(), NotPositiveDefinite> {
        match self {
            Self::Direct(cholesky) => cholesky.factor(values),
            Self::Iterative(_) => Ok(()),
        }
    }

    /// Replaces b in `x` by the solution of Ax = b for the prepared matrix.
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

    /// Returns the cost of one factorization; `None` for conjugate gradients.
    pub fn work(&self) -> Option<Work> {
        match self {
            Self::Direct(cholesky) => Some(cholesky.work()),
            Self::Iterative(_) => None,
        }
    }
}
