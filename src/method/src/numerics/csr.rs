//! Sparse matrices in the row format of other programs.

use super::cholesky::SymmetricPattern;

/// A sparse matrix by rows: row `i` has the values `data[indptr[i]..indptr[i + 1]]` in the columns `indices[…]`, which
/// increase.
#[derive(Clone, Debug, PartialEq)]
pub struct Csr {
    /// Stored values.
    pub data: Vec<f64>,
    /// Column of each value.
    pub indices: Vec<usize>,
    /// Start of each row, and the end of the last.
    pub indptr: Vec<usize>,
}

impl Csr {
    /// Expands the lower triangle of a symmetric matrix, given by columns with increasing rows, to the whole matrix.
    pub fn of_lower(pattern: &SymmetricPattern, values: &[f64]) -> Self {
        let columns = || (0..pattern.n).map(|c| (c, pattern.col_ptr[c]..pattern.col_ptr[c + 1]));
        // Count the entries of each row, both triangles.
        let mut indptr = vec![0; pattern.n + 1];
        for (column, entries) in columns() {
            for &row in &pattern.row_idx[entries] {
                indptr[row + 1] += 1;
                indptr[column + 1] += usize::from(row != column);
            }
        }
        for row in 0..pattern.n {
            indptr[row + 1] += indptr[row];
        }
        let n_stored = indptr[pattern.n];
        let (mut data, mut indices) = (vec![0.0; n_stored], vec![0; n_stored]);
        let mut next = indptr.clone();
        let mut put = |row: usize, column: usize, value: f64| {
            (data[next[row]], indices[next[row]]) = (value, column);
            next[row] += 1;
        };
        // Fill the rows. When a column is read, its row already has everything left of the diagonal.
        for (column, entries) in columns() {
            for k in entries {
                let row = pattern.row_idx[k];
                put(column, row, values[k]);
                if row != column {
                    put(row, column, values[k]);
                }
            }
        }
        Self {
            data,
            indices,
            indptr,
        }
    }
}
