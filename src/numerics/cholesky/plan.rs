//! What is known of the factorization before the values are.

use super::SymmetricPattern;
use super::branch::Extent;
use super::fronts::{Front, Fronts};
use super::graph::Graph;
use super::order::fill_reducing_order;
use super::scatter::Scatter;
use super::supernodes::supernodes;
use super::tree::{self, NONE};

/// From this many multiplications on the subtrees of the forest are factored in parallel: a few milliseconds.
const PARALLEL_FROM: f64 = 3e7;

/// A subtree with at most this share of the work is one task: small enough that tasks balance, large enough that most of the
/// tree is in one.
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

/// Where a front's panel and update are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    pub branch: u32,
    pub panel: usize,
    pub update: usize,
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
    /// The unknowns of a front that are not its pivots, in the new numbering.
    pub fn below(&self, front: &Front) -> impl Iterator<Item = usize> {
        let rows = &self.fronts.rows[front.rows.clone()];
        let block = self.block;
        rows.iter()
            .flat_map(move |&v| block * v as usize..block * (v as usize + 1))
    }
}

/// The order changed to a postorder of its elimination tree, which costs and fills the same, and that tree.
fn in_postorder(graph: &Graph, order: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let parent = tree::elimination_tree(&graph.reordered(order));
    let postorder = tree::postorder(&parent);
    (
        composed(order, &postorder),
        tree::reordered(&parent, &postorder),
    )
}

/// The first renumbering, then the second.
fn composed(first: &[u32], second: &[u32]) -> Vec<u32> {
    second.iter().map(|&v| first[v as usize]).collect()
}

/// Gives each front its place in memory. The last branch is the trunk, on which the others grow.
fn layout(fronts: &Fronts) -> (Vec<Place>, Vec<Extent>) {
    let branch_of = branches(fronts);
    let n_branches = branch_of.iter().max().map_or(1, |&b| b as usize + 1);
    let mut members = vec![Vec::new(); n_branches];
    let mut panel_lens = vec![0; n_branches];
    // Of each branch and stack: the present and the greatest height.
    let mut heights = vec![[[0_usize; 2]; 2]; n_branches];
    let mut places = Vec::with_capacity(fronts.list.len());
    for (k, front) in fronts.list.iter().enumerate() {
        let branch = branch_of[k] as usize;
        let [now, most] = &mut heights[branch][front.depth % 2];
        places.push(Place {
            branch: branch as u32,
            panel: panel_lens[branch],
            update: *now,
        });
        members[branch].push(k as u32);
        panel_lens[branch] += front.panel_len();
        *now += front.update_len();
        *most = (*most).max(*now);
        for &child in &fronts.children[front.children.clone()] {
            if branch_of[child as usize] as usize == branch {
                heights[branch][(front.depth + 1) % 2][0] -=
                    fronts.list[child as usize].update_len();
            }
        }
    }
    let extents = (members.into_iter().zip(panel_lens).zip(heights))
        .map(|((fronts, panels), [even, odd])| Extent {
            fronts,
            panels,
            updates: [even[1], odd[1]],
        })
        .collect();
    (places, extents)
}

/// The branch of each front: the largest subtrees that are small enough are one each, the rest is the trunk, the last.
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
