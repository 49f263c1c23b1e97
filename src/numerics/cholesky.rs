//! Sparse Cholesky A = LLᵀ: analyzed once per pattern, factored anew for each set of values.
//!
//! The work is faer's supernodal LLT with an approximate minimum degree order, on one thread: its two-thread mode was
//! measured to be slower, and charts run in parallel one level up. Results therefore depend on the values alone.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side, Spec};

/// Work per stored entry, as a share of the library's own threshold, from which columns are factored in groups. That threshold
/// leaves planar meshes of some thousand vertices to a column at a time, which is slower there.
const SUPERNODAL_FROM: SupernodalThreshold = SupernodalThreshold(0.1);

/// Where a symmetric matrix may be nonzero: its lower triangle in compressed columns.
///
/// Column `j` holds the rows `row_idx[col_ptr[j]..col_ptr[j + 1]]`, sorted, the first of them `j` itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SymmetricPattern {
    /// Number of rows and columns.
    pub n: usize,
    /// Start of each column in `row_idx`; `n + 1` entries.
    pub col_ptr: Vec<usize>,
    /// Row of each stored entry.
    pub row_idx: Vec<usize>,
}

/// The matrix has a pivot that is not positive (or not a number): a normal outcome for an indefinite Hessian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite")]
pub struct NotPositiveDefinite;

/// A factorization that is reused for many matrices of one pattern.
pub struct Cholesky {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    workspace: MemBuffer,
}

impl Cholesky {
    /// Orders the pattern to reduce fill and reserves all memory that factoring and solving for up to two right-hand
    /// sides will need.
    ///
    /// # Panics
    /// If the pattern is not as [`SymmetricPattern`] describes: that is a mistake of the caller, not of its input.
    pub fn analyze(pattern: &SymmetricPattern) -> Self {
        let SymmetricPattern {
            n,
            col_ptr,
            row_idx,
        } = pattern;
        let pattern =
            SymbolicSparseColMat::new_checked(*n, *n, col_ptr.clone(), None, row_idx.clone());
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SUPERNODAL_FROM,
                ..CholeskySymbolicParams::default()
            },
        )
        .expect("indices fit in usize");
        let factor = vec![0.0; symbolic.len_val()];
        let requirement = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default())
            .or(symbolic.solve_in_place_scratch::<f64>(2, Par::Seq));
        Self {
            pattern,
            symbolic,
            factor,
            workspace: MemBuffer::new(requirement),
        }
    }

    /// Factors the matrix whose stored entries are `values`, in the order of the pattern's `row_idx`.
    ///
    /// After [`NotPositiveDefinite`] there is no factor to solve with until the next success.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), NotPositiveDefinite> {
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), values);
        let outcome = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            matrix,
            Side::Lower,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.workspace),
            Spec::default(),
        );
        outcome.map(|_| ()).map_err(|_| NotPositiveDefinite)
    }

    /// Replaces each of the `n_rhs` columns b of `rhs` (column-major) by the solution x of Ax = b.
    ///
    /// # Panics
    /// If `rhs` does not hold `n · n_rhs` numbers.
    pub fn solve(&mut self, rhs: &mut [f64], n_rhs: usize) {
        let n = self.symbolic.nrows();
        let factor = LltRef::new(&self.symbolic, &self.factor);
        // Two columns at a time: that is what the workspace was reserved for.
        for columns in rhs.chunks_mut((2 * n).max(1)).take(n_rhs.div_ceil(2)) {
            let n_columns = columns.len() / n;
            factor.solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(columns, n, n_columns),
                Par::Seq,
                MemStack::new(&mut self.workspace),
            );
        }
    }

    /// Number of rows of the matrix.
    pub fn n(&self) -> usize {
        self.symbolic.nrows()
    }
}
