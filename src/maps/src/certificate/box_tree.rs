//! A tree of bounding boxes in Morton order for finding boxes that meet, in plane and space.

/// Smallest and greatest coordinates of a box.
pub(crate) type Bounds<const D: usize = 2> = [[f64; D]; 2];

/// Completeness of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BoxVisit {
    Complete,
    /// The budget was used up before all pairs had been visited.
    Truncated,
}

/// Returns the budget of box comparisons for a search over `n` boxes: a few seconds' worth if every pair must be
/// compared. Boxes that hardly overlap, however unequal, need about 20 each; only heaps of faces come near the budget.
pub(crate) fn search_budget(n: usize) -> u64 {
    50_000_000 + 100 * n as u64
}

/// Boxes per leaf: testing a handful outright is cheaper than descending further.
const LEAF: usize = 4;

/// Returns the box of some points; without points, a box that encloses and meets nothing.
pub(crate) fn bounds_of<const D: usize>(points: &[[f64; D]]) -> Bounds<D> {
    let nothing = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    points.iter().fold(nothing, |b, &p| union(b, &[p, p]))
}

/// Enlarges a box by the least amount on every side: boxes that touched it now meet it.
pub(crate) fn enlarged<const D: usize>([low, high]: Bounds<D>) -> Bounds<D> {
    [low.map(f64::next_down), high.map(f64::next_up)]
}

/// A complete binary tree over boxes in Morton order of their centers; the children of node `i` are `2i` and `2i + 1`,
/// the root is 1.
pub(crate) struct BoxTree<const D: usize = 2> {
    items: Vec<u32>,
    boxes: Vec<Bounds<D>>,
    nodes: Vec<Bounds<D>>,
}

impl<const D: usize> BoxTree<D> {
    pub fn new(boxes: &[Bounds<D>]) -> Self {
        let nothing = bounds_of(&[]);
        let whole = boxes.iter().fold(nothing, union);
        let mut sorted: Vec<(u64, u32)> =
            boxes.iter().map(|b| morton(b, &whole)).zip(0..).collect();
        sorted.sort_unstable();
        let items: Vec<u32> = sorted.into_iter().map(|(_, item)| item).collect();
        let boxes: Vec<Bounds<D>> = items.iter().map(|&i| boxes[i as usize]).collect();
        let leaves = boxes.len().div_ceil(LEAF).next_power_of_two();
        let mut nodes = vec![nothing; 2 * leaves];
        for (leaf, chunk) in boxes.chunks(LEAF).enumerate() {
            nodes[leaves + leaf] = chunk.iter().fold(nothing, union);
        }
        for node in (1..leaves).rev() {
            nodes[node] = union(nodes[2 * node], &nodes[2 * node + 1]);
        }
        Self {
            items,
            boxes,
            nodes,
        }
    }

    /// Visits every pair of boxes whose interiors meet once, in a fixed order, within a budget of comparisons.
    pub fn pairs(&self, budget: u64, mut visit: impl FnMut(u32, u32)) -> BoxVisit {
        let leaves = self.nodes.len() / 2;
        let mut left = budget;
        let mut stack = vec![(1, 1)];
        while let Some((a, b)) = stack.pop() {
            if left < (LEAF * LEAF) as u64 {
                return BoxVisit::Truncated;
            }
            if a != b && !meet(&self.nodes[a], &self.nodes[b]) {
                left -= 1;
            } else if a < leaves {
                left -= 1;
                stack.extend(children(a, b));
            } else {
                left -= (LEAF * LEAF) as u64;
                self.leaf_pairs(a - leaves, b - leaves, &mut visit);
            }
        }
        BoxVisit::Complete
    }

    /// Visits every box whose interior meets that of `bounds`, in a fixed order.
    pub fn meeting(&self, bounds: &Bounds<D>, mut visit: impl FnMut(u32)) {
        let leaves = self.nodes.len() / 2;
        let mut stack = vec![1];
        while let Some(node) = stack.pop() {
            if !meet(&self.nodes[node], bounds) {
                continue;
            }
            if node < leaves {
                stack.extend([2 * node, 2 * node + 1]);
            } else {
                let inside = self.leaf(node - leaves);
                let met = inside.filter(|&i| meet(&self.boxes[i], bounds));
                met.for_each(|i| visit(self.items[i]));
            }
        }
    }

    fn leaf_pairs(&self, a: usize, b: usize, visit: &mut impl FnMut(u32, u32)) {
        for i in self.leaf(a) {
            for j in self.leaf(b) {
                if (a != b || i < j) && meet(&self.boxes[i], &self.boxes[j]) {
                    visit(self.items[i], self.items[j]);
                }
            }
        }
    }

    fn leaf(&self, leaf: usize) -> std::ops::Range<usize> {
        let end = self.boxes.len();
        (leaf * LEAF).min(end)..((leaf + 1) * LEAF).min(end)
    }

    /// Returns the smallest distance between two items of different groups, infinite if there is only one group.
    ///
    /// `distance` of two items is never less than the distance of their boxes. Makes at most `budget` comparisons.
    pub fn closest(
        &self,
        groups: &[u32],
        budget: u64,
        mut distance: impl FnMut(u32, u32) -> f64,
    ) -> (f64, BoxVisit) {
        let leaves = self.nodes.len() / 2;
        let group_of = self.groups_of_nodes(groups);
        let mut best = f64::INFINITY;
        let mut stack = vec![(0.0, 1, 1)];
        for _ in 0..budget {
            let Some((bound, a, b)) = stack.pop() else {
                return (best, BoxVisit::Complete);
            };
            // Skip pairs that are too far apart, and nodes of one group.
            if bound >= best || (group_of[a].is_some() && group_of[a] == group_of[b]) {
                continue;
            }
            // Compare the items of two leaves.
            if a >= leaves {
                best =
                    self.closest_in_leaves([a - leaves, b - leaves], groups, best, &mut distance);
                continue;
            }
            // Go down to the children of both nodes.
            let from = stack.len();
            stack.extend(
                children(a, b).map(|(a, b)| (box_distance(&self.nodes[a], &self.nodes[b]), a, b)),
            );
            stack[from..].sort_by(|x, y| y.0.total_cmp(&x.0)); // the nearest is taken first
        }
        (best, BoxVisit::Truncated)
    }

    /// Returns the smaller of `best` and the smallest distance between items of two leaves that differ in group.
    fn closest_in_leaves(
        &self,
        [a, b]: [usize; 2],
        groups: &[u32],
        mut best: f64,
        distance: &mut impl FnMut(u32, u32) -> f64,
    ) -> f64 {
        for i in self.leaf(a) {
            for j in self.leaf(b) {
                let (p, q) = (self.items[i], self.items[j]);
                let apart = groups[p as usize] != groups[q as usize];
                if apart && box_distance(&self.boxes[i], &self.boxes[j]) < best {
                    best = best.min(distance(p, q));
                }
            }
        }
        best
    }

    /// Returns for each node the group of all items below it, if it is only one.
    fn groups_of_nodes(&self, groups: &[u32]) -> Vec<Option<u32>> {
        let leaves = self.nodes.len() / 2;
        let mut of_node = vec![None; 2 * leaves];
        for leaf in 0..leaves {
            let mut members = self.leaf(leaf).map(|i| groups[self.items[i] as usize]);
            let first = members.next();
            of_node[leaves + leaf] = first.filter(|&g| members.all(|m| m == g));
        }
        for node in (1..leaves).rev() {
            let (l, r) = (of_node[2 * node], of_node[2 * node + 1]);
            of_node[node] = l.filter(|_| l == r);
        }
        of_node
    }
}

/// Iterates over the pairs of children of a pair of nodes, each once, also if the two nodes are one.
fn children(a: usize, b: usize) -> impl Iterator<Item = (usize, usize)> {
    let across = [(2 * a, 2 * b), (2 * a, 2 * b + 1), (2 * a + 1, 2 * b + 1)];
    across
        .into_iter()
        .chain((a != b).then_some((2 * a + 1, 2 * b)))
}

/// Returns the smallest box around two.
pub(crate) fn union<const D: usize>(a: Bounds<D>, b: &Bounds<D>) -> Bounds<D> {
    let axis = std::array::from_fn::<usize, D, _>(|axis| axis);
    [
        axis.map(|k| a[0][k].min(b[0][k])),
        axis.map(|k| a[1][k].max(b[1][k])),
    ]
}

/// Returns whether the interiors of two boxes meet.
pub(crate) fn meet<const D: usize>(a: &Bounds<D>, b: &Bounds<D>) -> bool {
    (0..D).all(|axis| a[0][axis] < b[1][axis] && b[0][axis] < a[1][axis])
}

fn box_distance<const D: usize>(a: &Bounds<D>, b: &Bounds<D>) -> f64 {
    let gap = |axis: usize| {
        (b[0][axis] - a[1][axis])
            .max(a[0][axis] - b[1][axis])
            .max(0.0)
    };
    (0..D).map(gap).fold(0.0, f64::hypot)
}

/// Returns the place of a box's center on the Z-order curve over `whole`, whose sides are cut into 2^(64/D) cells.
fn morton<const D: usize>(b: &Bounds<D>, whole: &Bounds<D>) -> u64 {
    let bits = 64 / D;
    let cell: [u64; D] = std::array::from_fn(|axis| {
        let size = whole[1][axis] - whole[0][axis];
        let part = (0.5 * (b[0][axis] + b[1][axis]) - whole[0][axis]) / size;
        (part * ((1_u64 << bits) - 1) as f64) as u64 // NaN (no extent) becomes 0
    });
    let mut place = 0;
    for bit in (0..bits).rev() {
        for axis in (0..D).rev() {
            place = place << 1 | cell[axis] >> bit & 1;
        }
    }
    place
}
