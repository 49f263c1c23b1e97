//! The pattern of a sparse symmetric matrix, and the failure of its factorization.

/// Nonzero pattern of a symmetric matrix: its lower triangle in compressed columns.
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

impl SymmetricPattern {
    /// Builds the pattern of entries `(column, row, value)` of the lower triangle, and the value of each stored entry:
    /// the sum of those at its place. Every diagonal entry must be among them.
    pub fn from_entries(n: usize, mut entries: Vec<(u32, u32, f64)>) -> (Self, Vec<f64>) {
        entries.sort_by_key(|&(column, row, _)| (column, row));
        let mut pattern = Self {
            n,
            col_ptr: vec![0; n + 1],
            row_idx: Vec::with_capacity(entries.len()),
        };
        let mut values = Vec::with_capacity(entries.len());
        for same in entries.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (column, row, _) = same[0];
            pattern.row_idx.push(row as usize);
            pattern.col_ptr[column as usize + 1] += 1;
            values.push(same.iter().map(|entry| entry.2).sum());
        }
        for column in 0..n {
            pattern.col_ptr[column + 1] += pattern.col_ptr[column];
        }
        (pattern, values)
    }

    /// Multiplies a vector by the matrix whose stored entries are `values`.
    pub fn multiply(&self, values: &[f64], vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for j in 0..self.n {
            let column = self.col_ptr[j]..self.col_ptr[j + 1];
            let mut sum = values[column.start] * vector[j];
            for slot in column.start + 1..column.end {
                let row = self.row_idx[slot];
                sum += values[slot] * vector[row];
                product[row] += values[slot] * vector[j];
            }
            product[j] += sum;
        }
    }
}

/// The matrix has a pivot that is not positive (or NaN): a normal outcome for an indefinite Hessian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite")]
pub struct NotPositiveDefinite;
