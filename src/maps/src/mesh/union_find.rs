//! Disjoint sets.

/// Disjoint sets of `0..n`. The smallest member is always the representative, so the result does not depend on the
/// order of unions.
#[derive(Clone, Debug)]
pub struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    /// Creates `n` sets of one member each.
    pub fn new(n: usize) -> Self {
        Self {
            parent: (0..n as u32).collect(),
        }
    }

    /// Returns the smallest member of the set of `i`.
    pub fn find(&mut self, mut i: u32) -> u32 {
        while self.parent[i as usize] != i {
            let grandparent = self.parent[self.parent[i as usize] as usize];
            self.parent[i as usize] = grandparent;
            i = grandparent;
        }
        i
    }

    /// Unites two sets; returns `false` if they were one already.
    pub fn unite(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// Returns for each member the number of its set, in the order of their smallest members, and the number of sets.
    pub fn labels(&mut self) -> (Vec<u32>, usize) {
        let mut labels = vec![0; self.parent.len()];
        let mut n = 0;
        for i in 0..self.parent.len() {
            let root = self.find(i as u32) as usize;
            labels[i] = if root == i { n } else { labels[root] };
            n += u32::from(root == i);
        }
        (labels, n as usize)
    }
}
