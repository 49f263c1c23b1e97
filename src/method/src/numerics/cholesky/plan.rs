//! The symbolic factorization, which does not depend on the values.

use super::fronts::{BranchExtent, Front, Fronts};
use super::symbolic::{self, Graph, NONE, SymmetricPattern, supernodes};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use feral_metis::{CscPattern, metis_order};

/// Number of multiplications from which the subtrees of the forest are factored in parallel: a few milliseconds.
const PARALLEL_FROM: f64 = 3e7;

/// Largest share of the work of a subtree that is one task: small enough that tasks balance, large enough that most of
/// the tree is in some task.
const TASK_SHARE: f64 = 1.0 / 24.0;

/// The symbolic factorization.
pub(super) struct FactorPlan {
    /// Old number of each vertex.
    pub order: Vec<u32>,
    /// Unknowns per vertex.
    pub block: usize,
    pub fronts: Fronts,
    pub places: Vec<EntryPlace>,
    pub scatter: Scatter,
}

/// Place of a front's numbers in its branch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EntryPlace {
    pub branch: u32,
    pub panel: usize,
    pub update: usize,
    pub pivots: usize,
    pub below: usize,
}

impl FactorPlan {
    pub fn new(pattern: &SymmetricPattern, block: usize) -> (Self, Vec<BranchExtent>) {
        let graph = Graph::new(pattern, block);
        let order = fill_reducing_order(&graph, block);
        let (order, parent) = in_postorder(&graph, &order);
        let counts = symbolic::column_counts(&graph.reordered(&order), &parent);
        let supernodes = supernodes(&parent, &counts, block);
        let order = composed(&order, &supernodes.order);
        let reordered = graph.reordered(&order);
        let fronts = Fronts::new(&reordered, &supernodes, block);
        let scatter = Scatter::new(pattern, block, &graph, &reordered, &order, &fronts);
        let (places, extents) = layout(&fronts);
        let plan = Self {
            order,
            block,
            fronts,
            places,
            scatter,
        };
        (plan, extents)
    }
}

impl FactorPlan {
    pub fn front(&self, k: u32) -> (&Front, &EntryPlace) {
        (&self.fronts.list[k as usize], &self.places[k as usize])
    }

    /// Returns the children of a front, whose updates it receives.
    pub fn children(&self, front: &Front) -> impl Iterator<Item = (&Front, &EntryPlace)> {
        let children = &self.fronts.children[front.children.clone()];
        children.iter().map(|&child| self.front(child))
    }

    /// Returns the first unknown, in the matrix, of each vertex among a front's pivots.
    fn vertices(&self, front: &Front) -> impl Iterator<Item = usize> {
        let vertices = front.first / self.block..(front.first + front.pivots) / self.block;
        let old = &self.order[vertices];
        old.iter().map(|&old| self.block * old as usize)
    }

    /// Copies the values at a front's pivots from a vector in the order of the matrix.
    pub fn gather(&self, front: &Front, from: &[f64], pivots: &mut [f64]) {
        for (own, old) in (pivots.chunks_exact_mut(self.block)).zip(self.vertices(front)) {
            own.copy_from_slice(&from[old..][..self.block]);
        }
    }

    /// Copies the values at a front's pivots back to a vector in the order of the matrix.
    pub fn scatter_back(&self, front: &Front, pivots: &[f64], to: &mut [f64]) {
        for (own, old) in pivots.chunks_exact(self.block).zip(self.vertices(front)) {
            to[old..][..self.block].copy_from_slice(own);
        }
    }
}

/// Changes the order to a postorder of its elimination tree, with equal cost and fill; returns it with that tree.
fn in_postorder(graph: &Graph, order: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let parent = symbolic::elimination_tree(&graph.reordered(order));
    let postorder = symbolic::postorder(&parent);
    (
        composed(order, &postorder),
        symbolic::reordered(&parent, &postorder),
    )
}

/// Composes two renumberings, `first` before `second`.
fn composed(first: &[u32], second: &[u32]) -> Vec<u32> {
    second.iter().map(|&v| first[v as usize]).collect()
}

/// Assigns each front its place in memory. The last branch is the trunk, on which the others grow.
fn layout(fronts: &Fronts) -> (Vec<EntryPlace>, Vec<BranchExtent>) {
    let branch_of = branches(fronts);
    let n_branches = branch_of.iter().max().map_or(1, |&b| b as usize + 1);
    let mut extents: Vec<BranchExtent> = (0..n_branches).map(|_| BranchExtent::default()).collect();
    // Present heights of the two stacks of updates of each branch.
    let mut heights = vec![[0_usize; 2]; n_branches];
    let mut places = Vec::with_capacity(fronts.list.len());
    for (k, front) in fronts.list.iter().enumerate() {
        // Lay the panels and vectors of a branch one after another; push each update onto the stack of its parity.
        let branch = branch_of[k] as usize;
        let (extent, height) = (&mut extents[branch], &mut heights[branch]);
        let now = &mut height[front.depth % 2];
        places.push(EntryPlace {
            branch: branch as u32,
            panel: extent.panels,
            update: *now,
            pivots: extent.pivots,
            below: extent.below,
        });
        *now += front.update_len();
        let most = &mut extent.updates[front.depth % 2];
        *most = (*most).max(*now);
        extent.fronts.push(k as u32);
        extent.panels += front.panel_len();
        extent.pivots += front.pivots;
        extent.below += front.below;
        extent.highest = extent.highest.max(front.height());
        // Pop the updates of the children, which the front has received. Those in other branches stay where they are.
        for &child in &fronts.children[front.children.clone()] {
            if branch_of[child as usize] as usize == branch {
                height[(front.depth + 1) % 2] -= fronts.list[child as usize].update_len();
            }
        }
    }
    (places, extents)
}

/// Returns the branch of each front: each of the largest subtrees that are small enough is a branch, the rest is the
/// trunk, the last.
fn branches(fronts: &Fronts) -> Vec<u32> {
    let n = fronts.list.len();
    // Sum the work of each subtree.
    let mut work: Vec<f64> = fronts.list.iter().map(Front::flops).collect();
    for k in 0..n {
        let parent = fronts.list[k].parent;
        if parent != NONE {
            work[parent as usize] += work[k];
        }
    }
    let roots = fronts
        .list
        .iter()
        .zip(&work)
        .filter(|(front, _)| front.parent == NONE);
    let total: f64 = roots.map(|(_, work)| work).sum();
    // Keep a small factorization in the trunk: tasks would cost more than they save.
    let share = if total < PARALLEL_FROM {
        0.0
    } else {
        TASK_SHARE
    };
    // From the roots down, begin a branch at each subtree that is small enough for a task.
    let mut branch_of = vec![NONE; n];
    let mut n_branches = 0;
    for k in (0..n).rev() {
        let parent = fronts.list[k].parent;
        let above = if parent == NONE {
            NONE
        } else {
            branch_of[parent as usize]
        };
        branch_of[k] = above;
        if above == NONE && work[k] <= share * total {
            branch_of[k] = n_branches;
            n_branches += 1;
        }
    }
    // The rest is the trunk.
    for branch in branch_of.iter_mut().filter(|branch| **branch == NONE) {
        *branch = n_branches;
    }
    branch_of
}

// Orders of elimination that reduce fill.

/// Number of vertices in the plane from which nested dissection replaces minimum degree.
///
/// It takes 20 times as long to find. On surfaces it halves a factorization at 180,000 vertices, and pays off after two
/// of them; at a million vertices it is the difference between 55 and 250 billion multiplications.
const DISSECTED_FROM: usize = 100_000;

/// Number of vertices in space, where separators are larger and a bad order costs more: at 94,000 tetrahedra dissection
/// took a factorization from 1.42 s to 0.53 s on one thread (`tests/bench/solids.rs`, `cage-56`).
const SOLIDS_DISSECTED_FROM: usize = 2_000;

/// Returns an order of the vertices, of `block` unknowns each, that keeps the factor sparse: `order[new] = old`.
fn fill_reducing_order(graph: &Graph, block: usize) -> Vec<u32> {
    let dissected_from = if block == 3 {
        SOLIDS_DISSECTED_FROM
    } else {
        DISSECTED_FROM
    };
    if graph.n() < dissected_from {
        return minimum_degree(graph);
    }
    nested_dissection(graph).unwrap_or_else(|| minimum_degree(graph))
}

/// Computes an approximate minimum degree order (Amestoy, Davis, Duff 1996).
fn minimum_degree(graph: &Graph) -> Vec<u32> {
    let n = graph.n();
    let starts: Vec<usize> = graph.starts().iter().map(|&s| s as usize).collect();
    let neighbors: Vec<usize> = graph.neighbors().iter().map(|&v| v as usize).collect();
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &neighbors);
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, neighbors.len()));
    amd::order(
        &mut order,
        &mut place,
        pattern,
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .expect("indices fit in usize");
    order.into_iter().map(|v| v as u32).collect()
}

/// Computes a multilevel nested dissection order (Karypis and Kumar 1998); `None` if the result is not a permutation.
fn nested_dissection(graph: &Graph) -> Option<Vec<u32>> {
    let n = graph.n();
    let signed = |values: &[u32]| values.iter().map(|&v| v as i32).collect::<Vec<_>>();
    let (starts, neighbors) = (signed(graph.starts()), signed(graph.neighbors()));
    let order = metis_order(&CscPattern::new(n, &starts, &neighbors)?).ok()?;
    let mut is_new = vec![true; n];
    let is_permutation = order.len() == n
        && (order.iter()).all(|&v| {
            let seen = usize::try_from(v).ok().and_then(|v| is_new.get_mut(v));
            seen.is_some_and(std::mem::take)
        });
    is_permutation.then(|| order.into_iter().map(|v| v as u32).collect())
}

// Places of the matrix entries in the fronts.

/// The stored block of two coupled vertices, or of one, and its place in a panel.
#[derive(Clone, Copy, Debug)]
struct PlanBlock {
    /// First entry in the values.
    from: u32,
    /// Distance between the columns of its first vertex there, plus the entries lost at the diagonal.
    stride: u32,
    /// First entry in the panel.
    to: u32,
    kind: FrontKind,
}

#[derive(Clone, Copy, Debug)]
enum FrontKind {
    Diagonal,
    Straight,
    /// Block of two vertices, where the larger one is eliminated first.
    Transposed,
}

/// Blocks of every front's panel; those of the k-th are `blocks[starts[k]..starts[k + 1]]`.
pub(super) struct Scatter {
    starts: Vec<usize>,
    blocks: Vec<PlanBlock>,
    size: usize,
}

impl Scatter {
    /// Creates the places; `graph` and `reordered` are the pattern's graph in its own numbering and in that of the
    /// elimination.
    pub fn new(
        pattern: &SymmetricPattern,
        size: usize,
        graph: &Graph,
        reordered: &Graph,
        order: &[u32],
        fronts: &Fronts,
    ) -> Self {
        let mut scatter = Self {
            starts: vec![0],
            blocks: Vec::with_capacity(graph.n() + graph.neighbors().len() / 2),
            size,
        };
        for front in &fronts.list {
            let first = front.first / size;
            for j in first..first + front.pivots / size {
                let column = (j - first) * size;
                let own = order[j];
                // The block on the diagonal.
                scatter.blocks.push(PlanBlock {
                    from: pattern.col_ptr[size * own as usize] as u32,
                    stride: stride(graph, own, size),
                    to: (column * front.stride() + column) as u32,
                    kind: FrontKind::Diagonal,
                });
                // The blocks of neighbors that are eliminated later.
                for &i in reordered.of(j as u32).iter().filter(|&&i| i as usize > j) {
                    let row = front.row(i, size, &fronts.rows);
                    let to = column * front.stride() + row;
                    scatter.blocks.push(PlanBlock::of_pair(
                        pattern,
                        size,
                        graph,
                        [own, order[i as usize]],
                        to as u32,
                    ));
                }
            }
            scatter.starts.push(scatter.blocks.len());
        }
        scatter
    }

    /// Adds a front's share of the matrix to its panel.
    pub fn add(&self, front: usize, values: &[f64], panel: &mut [f64], panel_stride: usize) {
        let blocks = &self.blocks[self.starts[front]..self.starts[front + 1]];
        match self.size {
            1 => add_blocks::<1>(blocks, values, panel, panel_stride),
            2 => add_blocks::<2>(blocks, values, panel, panel_stride),
            _ => add_blocks::<3>(blocks, values, panel, panel_stride),
        }
    }
}

/// Returns the number of entries of a vertex's first column below its own block.
fn stride(graph: &Graph, vertex: u32, size: usize) -> u32 {
    let list = graph.of(vertex);
    (size * (list.len() - list.partition_point(|&w| w < vertex))) as u32
}

impl PlanBlock {
    /// Creates the block of a vertex that is eliminated and one that is eliminated later.
    fn of_pair(
        pattern: &SymmetricPattern,
        size: usize,
        graph: &Graph,
        [own, other]: [u32; 2],
        to: u32,
    ) -> Self {
        let (small, large) = (own.min(other), own.max(other));
        let list = graph.of(small);
        let rank = list.partition_point(|&w| w < large) - list.partition_point(|&w| w < small);
        Self {
            from: (pattern.col_ptr[size * small as usize] + size + size * rank) as u32,
            stride: stride(graph, small, size),
            to,
            kind: if own < other {
                FrontKind::Straight
            } else {
                FrontKind::Transposed
            },
        }
    }
}

impl Front {
    /// Returns the row of a vertex in the panel.
    fn row(&self, vertex: u32, size: usize, rows: &[u32]) -> usize {
        let unknown = size * vertex as usize;
        if unknown < self.first + self.pivots {
            unknown - self.first
        } else {
            self.padded() + size * rows[self.rows.clone()].partition_point(|&w| w < vertex)
        }
    }
}

fn add_blocks<const D: usize>(
    blocks: &[PlanBlock],
    values: &[f64],
    panel: &mut [f64],
    panel_stride: usize,
) {
    for block in blocks {
        let (mut from, to) = (block.from as usize, block.to as usize);
        for c in 0..D {
            match block.kind {
                FrontKind::Diagonal => {
                    for r in c..D {
                        panel[to + c * panel_stride + r] += values[from + r - c];
                    }
                    from += block.stride as usize + D - c;
                }
                FrontKind::Straight | FrontKind::Transposed => {
                    let straight = matches!(block.kind, FrontKind::Straight);
                    for r in 0..D {
                        let (row, column) = if straight { (r, c) } else { (c, r) };
                        panel[to + column * panel_stride + row] += values[from + r];
                    }
                    from += block.stride as usize + D - 1 - c;
                }
            }
        }
    }
}
