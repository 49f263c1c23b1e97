//! A part of the forest of fronts that one task factors, with its memory.

use super::fronts::{BranchExtent, Front, FrontRun};
use super::kernels::{FactorColumns, WriteUpdate};
use super::plan::FactorPlan;
use super::symbolic::NotPositiveDefinite;
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::traits::pulp::Arch;
use faer::{Accum, MatMut, MatRef, Par};

/// Fronts, children before parents, their panels, and two stacks for their updates.
///
/// The updates of fronts of even depth lie on one stack, those of odd depth on the other: when a front is formed, its
/// children's updates are on top of the stack that it does not write to. The plan knows the exact places.
pub(super) struct Branch {
    pub fronts: Vec<u32>,
    pub panels: Vec<f64>,
    pub updates: [Vec<f64>; 2],
    pub vectors: Vectors,
}

impl From<BranchExtent> for Branch {
    fn from(extent: BranchExtent) -> Self {
        Self {
            fronts: extent.fronts,
            panels: vec![0.0; extent.panels],
            updates: extent.updates.map(|n| vec![0.0; n]),
            vectors: Vectors::new(extent.pivots, extent.below, extent.highest),
        }
    }
}

impl Branch {
    /// Factors the fronts of this branch; `others` are the branches that grow on it, in order.
    pub fn factor(
        &mut self,
        plan: &FactorPlan,
        values: &[f64],
        others: &[Self],
    ) -> Result<(), NotPositiveDefinite> {
        let Self {
            fronts,
            panels,
            updates,
            ..
        } = self;
        let [even, odd] = updates;
        for &k in fronts.iter() {
            let (front, place) = plan.front(k);
            let (mine, theirs) = if front.depth.is_multiple_of(2) {
                (&mut *even, &*odd)
            } else {
                (&mut *odd, &*even)
            };
            let children = || {
                plan.children(front).map(|(child, at)| {
                    let stack = match others.get(at.branch as usize) {
                        Some(other) => &other.updates[child.depth % 2],
                        None => theirs,
                    };
                    (child, &stack[at.update..at.update + child.update_len()])
                })
            };
            // Assemble the panel: entries of the matrix, then the updates of the children.
            let panel = &mut panels[place.panel..place.panel + front.panel_len()];
            panel.fill(0.0);
            plan.scatter.add(k as usize, values, panel, front.stride());
            for (child, update) in children() {
                let mut target = UpdatedColumns {
                    columns: 0..front.padded(),
                    values: &mut *panel,
                    stride: front.stride(),
                };
                target.add(
                    update,
                    child.update_stride(),
                    &plan.fronts.runs[child.runs.clone()],
                );
            }
            // Eliminate the pivots.
            factor_panel(front, panel)?;
            // Form the update for the parent; what the children add to it comes last.
            if front.below > 0 {
                let own = &mut mine[place.update..place.update + front.update_len()];
                write_update(front, panel, own);
                for (child, update) in children() {
                    let mut target = UpdatedColumns::update(front, own);
                    target.add(
                        update,
                        child.update_stride(),
                        &plan.fronts.runs[child.runs.clone()],
                    );
                }
            }
        }
        Ok(())
    }

    /// Writes the solution at its pivots in the order of the matrix.
    pub fn put_solution(&self, plan: &FactorPlan, x: &mut [f64]) {
        for &k in &self.fronts {
            let (front, place) = plan.front(k);
            let pivots = &self.vectors.pivots[place.pivots..][..front.pivots];
            plan.scatter_back(front, pivots, x);
        }
    }
}

/// Columns of a front to which the updates of its children are added.
struct UpdatedColumns<'a> {
    /// The columns, as rows of the panel.
    columns: std::ops::Range<usize>,
    /// Values, starting at row and column `columns.start` or, for the panel, at row 0.
    values: &'a mut [f64],
    stride: usize,
}

impl<'a> UpdatedColumns<'a> {
    fn update(front: &Front, values: &'a mut [f64]) -> Self {
        Self {
            columns: front.padded()..usize::MAX,
            values,
            stride: front.update_stride(),
        }
    }

    /// Adds the lower triangle of a child's update.
    fn add(&mut self, update: &[f64], stride: usize, runs: &[FrontRun]) {
        let from = self.columns.start;
        for (i, run) in runs.iter().enumerate() {
            let parent = run.parent as usize;
            if !self.columns.contains(&parent) {
                continue;
            }
            for c in 0..run.length as usize {
                let source = &update[(run.child as usize + c) * stride..][..stride];
                let target = &mut self.values[(parent - from + c) * self.stride..][..self.stride];
                let length = run.length as usize - c;
                add_to(
                    &mut target[parent - from + c..][..length],
                    &source[run.child as usize + c..][..length],
                );
                for run in &runs[i + 1..] {
                    let length = run.length as usize;
                    add_to(
                        &mut target[run.parent as usize - from..][..length],
                        &source[run.child as usize..][..length],
                    );
                }
            }
        }
    }
}

fn add_to(target: &mut [f64], source: &[f64]) {
    for (t, s) in target.iter_mut().zip(source) {
        *t += s;
    }
}

// Workspace of a solve in a branch.

/// A right-hand side on its way through the fronts of a branch, which becomes the solution on the way back.
pub(super) struct Vectors {
    /// Values at the pivots, front after front.
    pub pivots: Vec<f64>,
    /// Contributions below the pivots, front after front; on the way back the solution there.
    pub below: Vec<f64>,
    /// Unknowns of a front in the order of its panel: as long as the highest panel.
    pub local: Vec<f64>,
}

impl Vectors {
    pub fn new(pivots: usize, below: usize, highest: usize) -> Self {
        Self {
            pivots: vec![0.0; pivots],
            below: vec![0.0; below],
            local: vec![0.0; highest],
        }
    }
}

// One front: factors its panel and forms its update.

/// Columns that are factored before everything to their right is updated with a matrix product. Wider blocks make the
/// products larger but leave more of the work to the kernels of this module.
const BLOCK: usize = 96;

/// Height from which a panel no longer stays in the innermost cache; below it the kernels of this module are faster.
const LARGE: usize = 320;

/// Rows of a product per task. Fewer balance better, more multiply faster.
const TASK_ROWS: usize = 256;

/// Factors the panel of a front, which holds the assembled matrix.
fn factor_panel(front: &Front, panel: &mut [f64]) -> Result<(), NotPositiveDefinite> {
    let (height, stride) = (front.height(), front.stride());
    // Factor a panel that stays in the cache at once, a larger one in blocks of columns.
    let block = if height < LARGE { front.pivots } else { BLOCK };
    for from in (0..front.pivots).step_by(block.max(1)) {
        let to = front.pivots.min(from + block);
        // Subtract the products with the columns factored so far.
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
        // Factor the columns of the block.
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
fn write_update(front: &Front, panel: &[f64], update: &mut [f64]) {
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
