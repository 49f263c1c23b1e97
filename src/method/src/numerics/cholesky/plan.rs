//! The symbolic factorization, which does not depend on the values.

use super::extent::Extent;
use super::fronts::{Front, Fronts};
use super::graph::Graph;
use super::order::fill_reducing_order;
use super::pattern::SymmetricPattern;
use super::scatter::Scatter;
use super::supernodes::supernodes;
use super::tree::{self, NONE};

/// Number of multiplications from which the subtrees of the forest are factored in parallel: a few milliseconds.
const PARALLEL_FROM: f64 = 3e7;

/// Largest share of the work of a subtree that is one task: small enough that tasks balance, large enough that most of
/// the tree is in some task.
const TASK_SHARE: f64 = 1.0 / 24.0;

/// The symbolic factorization.
pub(super) struct Plan {
    /// Old number of each vertex.
    pub order: Vec<u32>,
    /// Unknowns per vertex.
    pub block: usize,
    pub fronts: Fronts,
    pub places: Vec<Place>,
    pub scatter: Scatter,
}

/// Place of a front's numbers in its branch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    pub branch: u32,
    pub panel: usize,
    pub update: usize,
    pub pivots: usize,
    pub below: usize,
}

impl Plan {
    pub fn new(pattern: &SymmetricPattern, block: usize) -> (Self, Vec<Extent>) {
        let graph = Graph::new(pattern, block);
        let order = fill_reducing_order(&graph, block);
        let (order, parent) = in_postorder(&graph, &order);
        let counts = tree::column_counts(&graph.reordered(&order), &parent);
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

impl Plan {
    pub fn front(&self, k: u32) -> (&Front, &Place) {
        (&self.fronts.list[k as usize], &self.places[k as usize])
    }

    /// Returns the children of a front, whose updates it receives.
    pub fn children(&self, front: &Front) -> impl Iterator<Item = (&Front, &Place)> {
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
    let parent = tree::elimination_tree(&graph.reordered(order));
    let postorder = tree::postorder(&parent);
    (
        composed(order, &postorder),
        tree::reordered(&parent, &postorder),
    )
}

/// Composes two renumberings, `first` before `second`.
fn composed(first: &[u32], second: &[u32]) -> Vec<u32> {
    second.iter().map(|&v| first[v as usize]).collect()
}

/// Assigns each front its place in memory. The last branch is the trunk, on which the others grow.
fn layout(fronts: &Fronts) -> (Vec<Place>, Vec<Extent>) {
    let branch_of = branches(fronts);
    let n_branches = branch_of.iter().max().map_or(1, |&b| b as usize + 1);
    let mut extents: Vec<Extent> = (0..n_branches).map(|_| Extent::default()).collect();
    // Of each branch and stack of updates: the present height.
    let mut heights = vec![[0_usize; 2]; n_branches];
    let mut places = Vec::with_capacity(fronts.list.len());
    for (k, front) in fronts.list.iter().enumerate() {
        let branch = branch_of[k] as usize;
        let (extent, height) = (&mut extents[branch], &mut heights[branch]);
        let now = &mut height[front.depth % 2];
        places.push(Place {
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
    let share = if total < PARALLEL_FROM {
        0.0
    } else {
        TASK_SHARE
    };
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
    for branch in branch_of.iter_mut().filter(|branch| **branch == NONE) {
        *branch = n_branches;
    }
    branch_of
}
