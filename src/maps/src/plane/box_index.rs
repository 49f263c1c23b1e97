//! An index of boxes for finding those that meet.

use std::ops::Range;

use static_aabb2d_index::{AABB, StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use unwrapd_method::numerics::bounds::Bounds;

/// Completeness of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Visit {
    /// All matches have been visited.
    Complete,
    /// The budget was used up first.
    Truncated,
}

/// Returns the budget of box comparisons for a search over `n` boxes: about a second's worth, which only heaps of boxes
/// come near.
pub fn search_budget(n: usize) -> u64 {
    50_000_000 + 200 * n as u64
}

/// Boxes per node: more are compared in vain, fewer make the tree higher.
const NODE: usize = 8;

/// A packed Hilbert R-tree over boxes, which are identified by their indices in the given list. All boxes are closed:
/// those that touch meet.
///
/// The order of visits depends only on the boxes.
pub struct BoxIndex {
    tree: StaticAABB2DIndex,
}

/// Two nodes of one level of the tree, by their positions in it.
#[derive(Clone, Copy)]
struct NodePair {
    nodes: [usize; 2],
    /// Level of their children; that of the items is 0.
    below: usize,
}

impl BoxIndex {
    /// Creates an index of boxes; an empty box meets nothing. O(n log n).
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut builder = StaticAABB2DIndexBuilder::new_with_node_size(boxes.len(), NODE);
        for [low, high] in boxes {
            let is_box = low[0] <= high[0] && low[1] <= high[1];
            // Out of reach of all others.
            let [low, high] = if is_box {
                [*low, *high]
            } else {
                [[f64::INFINITY; 2]; 2]
            };
            builder.add(low[0], low[1], high[0], high[1]);
        }
        let tree = builder.build().expect("as many boxes as announced");
        Self { tree }
    }

    /// Visits every box that has a point in common with this one.
    pub fn meeting(&self, [low, high]: &Bounds, mut visit: impl FnMut(u32)) {
        self.tree
            .visit_query(low[0], low[1], high[0], high[1], &mut |item: usize| {
                visit(item as u32);
            });
    }

    /// Visits every pair of boxes that have a point in common once, within a budget of comparisons.
    pub fn pairs(&self, budget: u64, mut visit: impl FnMut(u32, u32)) -> Visit {
        let (boxes, items) = (self.tree.all_boxes(), self.tree.all_box_indices());
        let mut left = budget;
        let mut open = Vec::from_iter(self.root());
        while let Some(pair @ NodePair { nodes, below }) = open.pop() {
            // Charge the budget for all comparisons of this pair of nodes at once.
            let [of_a, of_b] = self.children(pair);
            let Some(rest) = left.checked_sub((of_a.len() * of_b.len()) as u64) else {
                return Visit::Truncated;
            };
            left = rest;
            for a in of_a {
                // A node paired with itself has each pair of children once. Nodes are paired with themselves, boxes are
                // not.
                let first = if nodes[0] == nodes[1] {
                    a + usize::from(below == 0)
                } else {
                    of_b.start
                };
                for b in (first..of_b.end).filter(|&b| boxes[a].overlaps_aabb(&boxes[b])) {
                    if below == 0 {
                        visit(items[a] as u32, items[b] as u32);
                    } else {
                        open.push(NodePair {
                            nodes: [a, b],
                            below: below - 1,
                        });
                    }
                }
            }
        }
        Visit::Complete
    }

    /// Returns the smallest distance of two items of different groups, infinite if there is only one group.
    ///
    /// `distance` of two items is never less than that of their boxes. Makes at most `budget` comparisons of boxes.
    pub fn closest(
        &self,
        groups: &[u32],
        budget: u64,
        mut distance: impl FnMut(u32, u32) -> f64,
    ) -> (f64, Visit) {
        let (boxes, items) = (self.tree.all_boxes(), self.tree.all_box_indices());
        let group_of = self.groups(groups);
        let are_apart = |a: usize, b: usize| group_of[a].is_none() || group_of[a] != group_of[b];
        let (mut best, mut left) = (f64::INFINITY, budget);
        // Nearly best first: the nearest children of each pair of nodes are visited first.
        let mut open: Vec<(f64, NodePair)> =
            self.root().map(|root| (0.0, root)).into_iter().collect();
        while let Some((bound, pair @ NodePair { nodes, below })) = open.pop() {
            if bound >= best {
                continue;
            }
            let [of_a, of_b] = self.children(pair);
            let Some(rest) = left.checked_sub((of_a.len() * of_b.len()) as u64) else {
                return (best, Visit::Truncated);
            };
            left = rest;
            let n_before = open.len();
            for a in of_a {
                let first = if nodes[0] == nodes[1] { a } else { of_b.start };
                for b in (first..of_b.end).filter(|&b| are_apart(a, b)) {
                    let bound = box_distance(&boxes[a], &boxes[b]);
                    if bound >= best {
                        continue;
                    }
                    // Items on the lowest level, nodes above it.
                    if below == 0 {
                        best = best.min(distance(items[a] as u32, items[b] as u32));
                    } else {
                        let (nodes, below) = ([a, b], below - 1);
                        open.push((bound, NodePair { nodes, below }));
                    }
                }
            }
            open[n_before..].sort_by(|x, y| y.0.total_cmp(&x.0)); // the nearest is taken first
        }
        (best, Visit::Complete)
    }

    /// Returns the root paired with itself; `None` without boxes.
    fn root(&self) -> Option<NodePair> {
        let root = self.tree.all_boxes().len().checked_sub(1)?;
        Some(NodePair {
            nodes: [root; 2],
            below: self.tree.level_bounds().len() - 2,
        })
    }

    /// Returns the positions of the children of both nodes.
    fn children(&self, NodePair { nodes, below }: NodePair) -> [Range<usize>; 2] {
        nodes.map(|node| self.children_of(node, self.tree.level_bounds()[below]))
    }

    /// Returns the positions of a node's children on a level that ends at `end`.
    fn children_of(&self, node: usize, end: usize) -> Range<usize> {
        let first = self.tree.all_box_indices()[node];
        first..(first + NODE).min(end)
    }

    /// Returns for each position in the tree the group of all items below it, if it is only one.
    fn groups(&self, groups: &[u32]) -> Vec<Option<u32>> {
        let (items, ends) = (self.tree.all_box_indices(), self.tree.level_bounds());
        let mut of: Vec<Option<u32>> = (items[..groups.len()].iter())
            .map(|&item| Some(groups[item]))
            .collect();
        for level in ends.windows(2) {
            for node in level[0]..level[1] {
                let children = &of[self.children_of(node, level[0])];
                let is_one = children.iter().all(|group| *group == children[0]);
                of.push(children[0].filter(|_| is_one));
            }
        }
        of
    }
}

/// Returns the distance of two boxes.
fn box_distance(a: &AABB, b: &AABB) -> f64 {
    let gap = |low: f64, high: f64| low.max(high).max(0.0);
    let along_x = gap(b.min_x - a.max_x, a.min_x - b.max_x);
    let along_y = gap(b.min_y - a.max_y, a.min_y - b.max_y);
    along_x.hypot(along_y)
}
