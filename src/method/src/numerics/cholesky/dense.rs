//! One front: factors its panel and forms its update.

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::traits::pulp::Arch;
use faer::{Accum, MatMut, MatRef, Par};

use super::fronts::Front;
use super::kernels::{FactorColumns, WriteUpdate};
use super::pattern::NotPositiveDefinite;

/// Columns that are factored before everything to their right is updated with a matrix product.
const BLOCK: usize = 96;

/// Height from which a panel no longer stays in the innermost cache; below it the kernels of this module are faster.
const LARGE: usize = 320;

/// Rows of a product per task.
const TASK_ROWS: usize = 256;

/// Factors the panel of a front, which holds the assembled matrix.
pub(super) fn factor_panel(front: &Front, panel: &mut [f64]) -> Result<(), NotPositiveDefinite> {
    let (height, stride) = (front.height(), front.stride());
    let block = if height < LARGE { front.pivots } else { BLOCK };
    for from in (0..front.pivots).step_by(block.max(1)) {
        let to = front.pivots.min(from + block);
        if from > 0 {
            let (left, right) = panel.split_at_mut(from * stride);
            let left = MatRef::from_column_major_slice_with_stride(left, height, from, stride);
            let left = left.submatrix(from, 0, height - from, from);
            let right = &mut right[..(to - from) * stride];
            let right =
                MatMut::from_column_major_slice_with_stride_mut(right, height, to - from, stride);
            let right = right.submatrix_mut(from, 0, height - from, to - from);
            product(
                right,
                Accum::Add,
                left,
                left.submatrix(0, 0, to - from, from),
            );
        }
        let columns = FactorColumns {
            panel,
            stride,
            height,
            from,
            to,
        };
        if !Arch::new().dispatch(columns) {
            return Err(NotPositiveDefinite);
        }
    }
    Ok(())
}

/// Writes the lower triangle of −LLᵀ for the rows below the pivots.
pub(super) fn write_update(front: &Front, panel: &[f64], update: &mut [f64]) {
    let (first, stride, size) = (front.padded(), front.stride(), front.below);
    if front.height() < LARGE {
        return Arch::new().dispatch(WriteUpdate {
            panel,
            stride,
            first,
            update,
            size,
        });
    }
    let below =
        MatRef::from_column_major_slice_with_stride(panel, front.height(), front.pivots, stride);
    let below = below.submatrix(first, 0, size, front.pivots);
    let update =
        MatMut::from_column_major_slice_with_stride_mut(update, size, size, front.update_stride());
    write_triangle(update, below);
}

/// Computes C −= A Bᵀ, or C = −A Bᵀ. Rows are split into tasks by their number alone, so that the sums do not depend on
/// the number of threads.
fn product(c: MatMut<'_, f64>, accumulate: Accum, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    let rows = c.nrows();
    if rows <= TASK_ROWS {
        matmul(c, accumulate, a, b.transpose(), -1.0, Par::Seq);
        return;
    }
    let half = (rows / 2).next_multiple_of(TASK_ROWS);
    let (upper, lower) = c.split_at_row_mut(half);
    let (a_upper, a_lower) = a.split_at_row(half);
    rayon::join(
        || product(upper, accumulate, a_upper, b),
        || product(lower, accumulate, a_lower, b),
    );
}

/// Computes the lower triangle of C = −A Aᵀ, split into tasks like [`product`].
fn write_triangle(c: MatMut<'_, f64>, a: MatRef<'_, f64>) {
    let rows = c.nrows();
    if rows <= TASK_ROWS {
        triangular::matmul(
            c,
            BlockStructure::TriangularLower,
            Accum::Replace,
            a,
            BlockStructure::Rectangular,
            a.transpose(),
            BlockStructure::Rectangular,
            -1.0,
            Par::Seq,
        );
        return;
    }
    let half = (rows / 2).next_multiple_of(TASK_ROWS);
    let (upper, _, lower_left, lower_right) = c.split_at_mut(half, half);
    let (a_upper, a_lower) = a.split_at_row(half);
    rayon::join(
        || write_triangle(upper, a_upper),
        || {
            rayon::join(
                || product(lower_left, Accum::Replace, a_lower, a_upper),
                || write_triangle(lower_right, a_lower),
            )
        },
    );
}
