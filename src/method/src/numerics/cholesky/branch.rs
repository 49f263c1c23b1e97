//! A part of the forest of fronts that one task factors, with its memory.

use super::dense::{factor_panel, write_update};
use super::extent::Extent;
use super::fronts::{Front, Run};
use super::pattern::NotPositiveDefinite;
use super::plan::Plan;
use super::vectors::Vectors;

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

impl From<Extent> for Branch {
    fn from(extent: Extent) -> Self {
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
        plan: &Plan,
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
                let mut target = Target {
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
                    let mut target = Target::update(front, own);
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
    pub fn put_solution(&self, plan: &Plan, x: &mut [f64]) {
        for &k in &self.fronts {
            let (front, place) = plan.front(k);
            let pivots = &self.vectors.pivots[place.pivots..][..front.pivots];
            plan.scatter_back(front, pivots, x);
        }
    }
}

/// Columns of a front to which the updates of its children are added.
struct Target<'a> {
    /// The columns, as rows of the panel.
    columns: std::ops::Range<usize>,
    /// Values, starting at row and column `columns.start` or, for the panel, at row 0.
    values: &'a mut [f64],
    stride: usize,
}

impl<'a> Target<'a> {
    fn update(front: &Front, values: &'a mut [f64]) -> Self {
        Self {
            columns: front.padded()..usize::MAX,
            values,
            stride: front.update_stride(),
        }
    }

    /// Adds the lower triangle of a child's update.
    fn add(&mut self, update: &[f64], stride: usize, runs: &[Run]) {
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
