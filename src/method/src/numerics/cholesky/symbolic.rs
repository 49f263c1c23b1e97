//! The pattern of a sparse symmetric matrix, and the failure of its factorization.

/// Nonzero pattern of a symmetric matrix: its lower triangle in compressed columns.
///
/// Column `j` holds the rows `row_idx[col_ptr[j]..col_ptr[j + 1]]`, sorted, the first of them `j` itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SymmetricPattern {
    /// Number of rows and columns.
    pub n: usize,
    /// Start of each column in `row_idx`; `n + 1` entries.
    pub col_ptr: Vec<usize>,
    /// Row of each stored entry.
    pub row_idx: Vec<usize>,
}

impl SymmetricPattern {
    /// Builds the pattern of entries `(column, row, value)` of the lower triangle, and the value of each stored entry:
    /// the sum of those at its place. Every diagonal entry must be among them.
    pub fn from_entries(n: usize, mut entries: Vec<(u32, u32, f64)>) -> (Self, Vec<f64>) {
        entries.sort_by_key(|&(column, row, _)| (column, row));
        let mut pattern = Self {
            n,
            col_ptr: vec![0; n + 1],
            row_idx: Vec::with_capacity(entries.len()),
        };
        let mut values = Vec::with_capacity(entries.len());
        for same in entries.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (column, row, _) = same[0];
            pattern.row_idx.push(row as usize);
            pattern.col_ptr[column as usize + 1] += 1;
            values.push(same.iter().map(|entry| entry.2).sum());
        }
        for column in 0..n {
            pattern.col_ptr[column + 1] += pattern.col_ptr[column];
        }
        (pattern, values)
    }

    /// Multiplies a vector by the matrix whose stored entries are `values`.
    pub fn multiply(&self, values: &[f64], vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for j in 0..self.n {
            let column = self.col_ptr[j]..self.col_ptr[j + 1];
            let mut sum = values[column.start] * vector[j];
            for slot in column.start + 1..column.end {
                let row = self.row_idx[slot];
                sum += values[slot] * vector[row];
                product[row] += values[slot] * vector[j];
            }
            product[j] += sum;
        }
    }
}

/// The matrix has a pivot that is not positive (or NaN): a normal outcome for an indefinite Hessian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite")]
pub struct NotPositiveDefinite;

// The graph of couplings between vertices.

/// Graph of a symmetric matrix of square blocks: for each vertex its neighbors, sorted.
pub(super) struct Graph {
    starts: Vec<u32>,
    neighbors: Vec<u32>,
}

impl Graph {
    /// Creates the graph of a pattern in which `block` consecutive unknowns belong to a vertex.
    ///
    /// The first column of a vertex is sufficient: the rows of its own block come first, then those of its larger
    /// neighbors.
    pub fn new(pattern: &SymmetricPattern, block: usize) -> Self {
        let n = pattern.n / block;
        let larger = |v: usize| {
            let column =
                &pattern.row_idx[pattern.col_ptr[block * v]..pattern.col_ptr[block * v + 1]];
            assert_eq!(column[0], block * v, "a column starts on the diagonal");
            column[block..].iter().step_by(block).map(|row| row / block)
        };
        // Count the neighbors of each vertex.
        let mut starts = vec![0; n + 1];
        for v in 0..n {
            for w in larger(v) {
                starts[v + 1] += 1;
                starts[w + 1] += 1;
            }
        }
        for v in 0..n {
            starts[v + 1] += starts[v];
        }
        // Fill the lists. Vertices come in order, so each list is increasing.
        let mut neighbors = vec![0; starts[n] as usize];
        let mut next = starts.clone();
        for v in 0..n {
            for w in larger(v) {
                for (from, to) in [(v, w), (w, v)] {
                    neighbors[next[from] as usize] = to as u32;
                    next[from] += 1;
                }
            }
        }
        Self { starts, neighbors }
    }

    /// Returns the number of vertices.
    pub fn n(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns the neighbors of a vertex.
    pub fn of(&self, vertex: u32) -> &[u32] {
        let v = vertex as usize;
        &self.neighbors[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// Returns the start of each vertex's neighbors in [`neighbors`](Self::neighbors).
    pub fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// Returns all lists, one after another.
    pub fn neighbors(&self) -> &[u32] {
        &self.neighbors
    }

    /// Renumbers the vertices by `order[new] = old`.
    pub fn reordered(&self, order: &[u32]) -> Self {
        let place = inverse(order);
        let mut starts = Vec::with_capacity(self.starts.len());
        let mut neighbors = Vec::with_capacity(self.neighbors.len());
        starts.push(0);
        for &old in order {
            let from = neighbors.len();
            neighbors.extend(self.of(old).iter().map(|&w| place[w as usize]));
            neighbors[from..].sort_unstable();
            starts.push(neighbors.len() as u32);
        }
        Self { starts, neighbors }
    }
}

/// Returns the inverse of a permutation.
pub(super) fn inverse(order: &[u32]) -> Vec<u32> {
    let mut place = vec![0; order.len()];
    for (new, &old) in order.iter().enumerate() {
        place[old as usize] = new as u32;
    }
    place
}

// The elimination tree: which columns of the factor depend on which others.

/// Parent of a root.
pub(super) const NONE: u32 = u32::MAX;

/// Computes the parent of each column: the row of the first entry below its diagonal in the factor.
///
/// From: Liu 1986, A Compact Row Storage Scheme for Cholesky Factors Using Elimination Trees.
pub(super) fn elimination_tree(graph: &Graph) -> Vec<u32> {
    let n = graph.n() as u32;
    let mut parent = vec![NONE; n as usize];
    let mut ancestor = parent.clone();
    for j in 0..n {
        for &i in graph.of(j).iter().take_while(|&&i| i < j) {
            // The path from i to its root, which now is j; compressed on the way.
            let mut at = i;
            while at != j {
                let up = std::mem::replace(&mut ancestor[at as usize], j);
                if up == NONE {
                    parent[at as usize] = j;
                    break;
                }
                at = up;
            }
        }
    }
    parent
}

/// Numbers every tree of a forest from its leaves up, subtree by subtree: `order[new] = old`.
pub(super) fn postorder(parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    // List the children of each vertex. Later ones are put in front of the list first, so each list is increasing.
    let (mut first_child, mut sibling) = (vec![NONE; n], vec![NONE; n]);
    let mut roots = Vec::new();
    for v in (0..n as u32).rev() {
        match parent[v as usize] {
            NONE => roots.push(v),
            p => {
                sibling[v as usize] = first_child[p as usize];
                first_child[p as usize] = v;
            }
        }
    }
    // Walk each tree depth first; an explicit stack, because trees can be as deep as they have vertices.
    let mut order = Vec::with_capacity(n);
    let mut stack = Vec::new();
    while let Some(root) = roots.pop() {
        stack.push(root);
        while let Some(&v) = stack.last() {
            let child = first_child[v as usize];
            if child == NONE {
                order.push(v);
                stack.pop();
            } else {
                first_child[v as usize] = sibling[child as usize];
                stack.push(child);
            }
        }
    }
    order
}

/// Returns the parents after a renumbering `order[new] = old`.
pub(super) fn reordered(parent: &[u32], order: &[u32]) -> Vec<u32> {
    let place = inverse(order);
    let new = |p: u32| if p == NONE { NONE } else { place[p as usize] };
    order.iter().map(|&old| new(parent[old as usize])).collect()
}

/// Counts the entries of each column of the factor, including the diagonal, for a graph numbered in postorder.
///
/// Takes nearly linear time: a column's count is the number of row subtrees that contain it, and those are found from
/// their leaves. From: Gilbert, Ng, Peyton 1994, An Efficient Algorithm to Compute Row and Column Counts.
pub(super) fn column_counts(graph: &Graph, parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    // Find the first descendant of each column.
    let mut first_descendant: Vec<u32> = (0..n as u32).collect();
    for j in 0..n {
        if parent[j] != NONE {
            let p = parent[j] as usize;
            first_descendant[p] = first_descendant[p].min(first_descendant[j]);
        }
    }
    // Count each leaf of a row subtree, and take one off where the paths of two successive leaves meet.
    let mut ancestor: Vec<u32> = (0..n as u32).collect();
    let mut last_leaf = vec![NONE; n];
    let mut counts: Vec<i32> = (0..n as u32)
        .map(|j| i32::from(first_descendant[j as usize] == j))
        .collect();
    for j in 0..n as u32 {
        if parent[j as usize] != NONE {
            counts[parent[j as usize] as usize] -= 1;
        }
        for &i in graph.of(j).iter().rev().take_while(|&&i| i > j) {
            let previous = last_leaf[i as usize];
            if previous != NONE && first_descendant[j as usize] <= previous {
                continue;
            }
            last_leaf[i as usize] = j;
            counts[j as usize] += 1;
            if previous != NONE {
                counts[find(&mut ancestor, previous) as usize] -= 1;
            }
        }
        if parent[j as usize] != NONE {
            ancestor[j as usize] = parent[j as usize];
        }
    }
    // Sum the counts from the leaves up.
    for j in 0..n {
        if parent[j] != NONE {
            counts[parent[j] as usize] += counts[j];
        }
    }
    counts.into_iter().map(|count| count as u32).collect()
}

fn find(ancestor: &mut [u32], v: u32) -> u32 {
    let mut root = v;
    while ancestor[root as usize] != root {
        root = ancestor[root as usize];
    }
    let mut at = v;
    while at != root {
        at = std::mem::replace(&mut ancestor[at as usize], root);
    }
    root
}

// Supernodes: columns of the factor that are worked on together.

/// Groups of columns as a forest; the columns of the k-th are `starts[k]..starts[k + 1]`, in `order[new] = old`.
pub(super) struct Supernodes {
    pub order: Vec<u32>,
    pub starts: Vec<u32>,
    pub parent: Vec<u32>,
}

/// Size of a group while others join it: its columns, and the rows that they reach together, its own included.
#[derive(Clone, Copy)]
struct SupernodeSize {
    pivots: u32,
    rows: u32,
}

/// Finds the supernodes of columns numbered in postorder, then joins those that are faster together.
pub(super) fn supernodes(parent: &[u32], counts: &[u32], block: usize) -> Supernodes {
    let n = parent.len();
    let starts = fundamental(parent, counts);
    let mut group_of = vec![0; n];
    for (k, window) in starts.windows(2).enumerate() {
        group_of[window[0] as usize..window[1] as usize].fill(k as u32);
    }
    let mut sizes: Vec<SupernodeSize> = (starts.windows(2))
        .map(|w| SupernodeSize {
            pivots: w[1] - w[0],
            rows: counts[w[0] as usize],
        })
        .collect();
    let group_parent: Vec<u32> = (starts.windows(2))
        .map(|w| match parent[w[1] as usize - 1] {
            NONE => NONE,
            p => group_of[p as usize],
        })
        .collect();
    let joined = amalgamate(&group_parent, &mut sizes, block);
    renumber(&starts, &group_parent, &joined)
}

/// Returns the starts of the groups: a column joins the one before if that is its only child and their rows are the
/// same.
fn fundamental(parent: &[u32], counts: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let mut n_children = vec![0_u32; n];
    for &p in parent.iter().filter(|&&p| p != NONE) {
        n_children[p as usize] += 1;
    }
    let joins = |j: usize| {
        parent[j - 1] == j as u32 && n_children[j] == 1 && counts[j - 1] == counts[j] + 1
    };
    let mut starts: Vec<u32> = (0..n)
        .filter(|&j| j == 0 || !joins(j))
        .map(|j| j as u32)
        .collect();
    starts.push(n as u32);
    starts
}

/// Estimates the time of a front in nanoseconds, from its size in unknowns: a constant, flops, adding its update to its
/// parent, reading and writing its panel. Fitted on one core at about 25 Gflop/s; only the ratios matter.
fn nanoseconds(size: SupernodeSize, block: usize) -> f64 {
    let k = (block * size.pivots as usize) as f64;
    let m = (block * size.rows as usize) as f64;
    let flops = k * m * m - m * k * (k - 1.0) + (k - 1.0) * k * (2.0 * k - 1.0) / 6.0;
    400.0 + flops / 25.0 + 0.3 * (m - k) * (m - k) + 0.3 * m * k
}

/// Returns for each group the group that it has joined, or itself: from the leaves up, children join their parent as
/// long as that saves time.
fn amalgamate(parent: &[u32], sizes: &mut [SupernodeSize], block: usize) -> Vec<u32> {
    let n = parent.len();
    let mut joined: Vec<u32> = (0..n as u32).collect();
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); n];
    let saving = |sizes: &[SupernodeSize], child: u32, p: usize| {
        let (c, p) = (sizes[child as usize], sizes[p]);
        let both = SupernodeSize {
            pivots: p.pivots + c.pivots,
            rows: p.rows + c.pivots,
        };
        (
            nanoseconds(c, block) + nanoseconds(p, block) - nanoseconds(both, block),
            both,
        )
    };
    // From the leaves up: try the children of each group, those that save most time first.
    for p in 0..n {
        let mut candidates = std::mem::take(&mut children[p]);
        let mut savings: Vec<(f64, u32)> = candidates
            .iter()
            .map(|&c| (saving(sizes, c, p).0, c))
            .collect();
        savings.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        candidates.clear();
        candidates.extend(savings.iter().map(|s| s.1));
        let mut next = 0;
        while let Some(&child) = candidates.get(next) {
            next += 1;
            let (saved, both) = saving(sizes, child, p);
            if saved > 0.0 {
                sizes[p] = both;
                joined[child as usize] = p as u32;
                // The children of a child that has joined become candidates.
                candidates.append(&mut children[child as usize]);
            } else {
                children[p].push(child);
            }
        }
        if parent[p] != NONE {
            children[parent[p] as usize].push(p as u32);
        }
    }
    // Follow chains of joins to their last group.
    for k in (0..n).rev() {
        joined[k] = joined[joined[k] as usize];
    }
    joined
}

/// Numbers joined groups and their columns in postorder. Columns of a group that joined another come before the
/// latter's own.
fn renumber(starts: &[u32], parent: &[u32], joined: &[u32]) -> Supernodes {
    let n = parent.len();
    // Collect the members of each group that remains.
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); n];
    for (k, &into) in joined.iter().enumerate() {
        members[into as usize].push(k as u32);
    }
    // Number the groups that remain, and find their parents among them.
    let kept: Vec<u32> = (0..n as u32).filter(|&k| joined[k as usize] == k).collect();
    let mut rank = vec![NONE; n];
    for (i, &k) in kept.iter().enumerate() {
        rank[k as usize] = i as u32;
    }
    let kept_parent: Vec<u32> = (kept.iter())
        .map(|&k| match parent[k as usize] {
            NONE => NONE,
            p => rank[joined[p as usize] as usize],
        })
        .collect();
    // Put groups and columns in postorder.
    let postorder = postorder(&kept_parent);
    let mut found = Supernodes {
        order: Vec::with_capacity(starts[n] as usize),
        starts: vec![0],
        parent: reordered(&kept_parent, &postorder),
    };
    for &i in &postorder {
        for &k in &members[kept[i as usize] as usize] {
            found
                .order
                .extend(starts[k as usize]..starts[k as usize + 1]);
        }
        found.starts.push(found.order.len() as u32);
    }
    found
}
