//! The dense matrices of the factorization, and how they fit into each other.

use super::kernels::LANES;
use super::symbolic::{Graph, NONE, Supernodes};
use std::ops::Range;

/// A dense symmetric matrix whose first columns are eliminated and whose remainder, the update, is added to its parent.
///
/// Its panel holds the pivot columns: rows `0..pivots` are those of the pivots, rows from `padded` on the others, with
/// zeros in between. Columns are a multiple of [`LANES`] apart.
#[derive(Clone, Debug)]
pub(super) struct Front {
    /// First unknown that is eliminated here, in the new numbering.
    pub first: usize,
    /// Number of unknowns that are eliminated here.
    pub pivots: usize,
    /// Number of unknowns that are only updated.
    pub below: usize,
    /// Vertices of the updated unknowns, increasing: a range of [`Fronts::rows`].
    pub rows: Range<usize>,
    /// Their places in the parent: a range of [`Fronts::runs`].
    pub runs: Range<usize>,
    pub parent: u32,
    /// Children: a range of [`Fronts::children`].
    pub children: Range<usize>,
    /// Depth below the root; its parity chooses the stack of the update.
    pub depth: usize,
}

/// Successive unknowns of a child's update that are also successive in its parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrontRun {
    pub child: u32,
    /// Place in the rows of the parent's panel.
    pub parent: u32,
    pub length: u32,
}

/// All fronts, children before parents.
pub(super) struct Fronts {
    pub list: Vec<Front>,
    pub rows: Vec<u32>,
    pub runs: Vec<FrontRun>,
    pub children: Vec<u32>,
}

impl Front {
    /// Returns the first row of the panel after those of the pivots and their padding.
    pub fn padded(&self) -> usize {
        self.pivots.next_multiple_of(LANES)
    }

    /// Returns the number of rows of the panel.
    pub fn height(&self) -> usize {
        self.padded() + self.update_stride()
    }

    /// Returns the distance between columns of the panel: an odd multiple of [`LANES`], so that a row does not fall
    /// into one cache set.
    pub fn stride(&self) -> usize {
        LANES * ((self.height() / LANES) | 1)
    }

    /// Returns the distance between columns of the update.
    pub fn update_stride(&self) -> usize {
        self.below.next_multiple_of(LANES)
    }

    pub fn panel_len(&self) -> usize {
        self.stride() * self.pivots
    }

    pub fn update_len(&self) -> usize {
        self.update_stride() * self.below
    }

    /// Returns the number of multiply–adds of the elimination.
    pub fn flops(&self) -> f64 {
        let (k, m) = (self.pivots as f64, (self.pivots + self.below) as f64);
        k * m * m - k * k * m + k * k * k / 3.0
    }
}

impl Fronts {
    /// Creates the fronts from the graph in its new numbering.
    pub fn new(graph: &Graph, supernodes: &Supernodes, block: usize) -> Self {
        let n = supernodes.parent.len();
        let mut fronts = Self {
            list: Vec::with_capacity(n),
            rows: Vec::new(),
            runs: Vec::new(),
            children: Vec::with_capacity(n),
        };
        // Find the children and the rows of each front, children before parents.
        let children = fronts.gather_children(&supernodes.parent);
        let mut seen = vec![NONE; graph.n()];
        for (k, children) in children.into_iter().enumerate() {
            let (from, to) = (supernodes.starts[k], supernodes.starts[k + 1]);
            let rows = fronts.gather_rows(graph, from..to, children.clone(), k as u32, &mut seen);
            fronts.list.push(Front {
                first: block * from as usize,
                pivots: block * (to - from) as usize,
                below: block * rows.len(),
                rows,
                runs: 0..0,
                parent: supernodes.parent[k],
                children,
                depth: 0,
            });
        }
        // Find the depths from the roots down.
        for k in (0..n).rev() {
            if fronts.list[k].parent != NONE {
                fronts.list[k].depth = fronts.list[fronts.list[k].parent as usize].depth + 1;
            }
        }
        // Find the places of each front's rows in its parent.
        for k in 0..n {
            let start = fronts.runs.len();
            if fronts.list[k].parent != NONE {
                fronts.gather_runs(k, block);
            }
            fronts.list[k].runs = start..fronts.runs.len();
        }
        fronts
    }

    fn gather_children(&mut self, parent: &[u32]) -> Vec<Range<usize>> {
        let mut ends = vec![0; parent.len() + 1];
        for &p in parent.iter().filter(|&&p| p != NONE) {
            ends[p as usize + 1] += 1;
        }
        for k in 0..parent.len() {
            ends[k + 1] += ends[k];
        }
        self.children.resize(ends[parent.len()], 0);
        let mut next = ends.clone();
        for (k, &p) in parent.iter().enumerate().filter(|(_, p)| **p != NONE) {
            self.children[next[p as usize]] = k as u32;
            next[p as usize] += 1;
        }
        ends.windows(2).map(|w| w[0]..w[1]).collect()
    }

    /// Appends the vertices that the pivots and the updates of the children reach beyond the pivots; returns their
    /// range.
    fn gather_rows(
        &mut self,
        graph: &Graph,
        pivots: Range<u32>,
        children: Range<usize>,
        mark: u32,
        seen: &mut [u32],
    ) -> Range<usize> {
        let start = self.rows.len();
        for j in pivots.clone() {
            for &i in graph.of(j).iter().rev().take_while(|&&i| i >= pivots.end) {
                if std::mem::replace(&mut seen[i as usize], mark) != mark {
                    self.rows.push(i);
                }
            }
        }
        for child in children {
            let rows = self.list[self.children[child] as usize].rows.clone();
            for at in rows {
                let i = self.rows[at];
                if i >= pivots.end && std::mem::replace(&mut seen[i as usize], mark) != mark {
                    self.rows.push(i);
                }
            }
        }
        self.rows[start..].sort_unstable();
        start..self.rows.len()
    }

    /// Appends the places of the rows of a front in its parent.
    fn gather_runs(&mut self, k: usize, block: usize) {
        let front = &self.list[k];
        let parent = &self.list[front.parent as usize];
        let parent_rows = &self.rows[parent.rows.clone()];
        let start = self.runs.len();
        let mut at = 0;
        for (i, &v) in self.rows[front.rows.clone()].iter().enumerate() {
            let unknown = block * v as usize;
            let place = if unknown < parent.first + parent.pivots {
                unknown - parent.first
            } else {
                at += parent_rows[at..].partition_point(|&w| w < v);
                parent.padded() + block * at
            };
            let (child, place) = ((block * i) as u32, place as u32);
            match self.runs[start..].last_mut() {
                Some(run)
                    if run.parent + run.length == place && place as usize != parent.padded() =>
                {
                    run.length += block as u32;
                }
                _ => self.runs.push(FrontRun {
                    child,
                    parent: place,
                    length: block as u32,
                }),
            }
        }
    }
}

// Memory of a branch, known from the plan.

/// Sizes of the arrays of a branch, in numbers.
#[derive(Default)]
pub(super) struct BranchExtent {
    pub fronts: Vec<u32>,
    pub panels: usize,
    pub updates: [usize; 2],
    /// Pivots of all its fronts.
    pub pivots: usize,
    pub below: usize,
    /// Rows of the highest panel.
    pub highest: usize,
}

impl BranchExtent {
    pub fn bytes(&self) -> usize {
        let [even, odd] = self.updates;
        let vectors = self.pivots + self.below + self.highest;
        size_of::<f64>() * (self.panels + even + odd + vectors)
    }
}
