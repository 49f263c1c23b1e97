//! The graph of couplings between vertices.

use super::pattern::SymmetricPattern;

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
