//! Halfedges and edges.

/// Twin of a halfedge without one.
pub const CUT: u32 = u32::MAX;

/// Returns the next halfedge of the same face.
pub fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// Returns the vertex at which a halfedge starts.
pub fn origin(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[h as usize / 3][h as usize % 3]
}

/// Returns whether two halfedges of one edge run in the same direction, that is, their faces are wound inconsistently.
pub fn same_direction(triangles: &[[u32; 3]], a: u32, b: u32) -> bool {
    origin(triangles, a) == origin(triangles, b)
}

/// Halfedges grouped by the edge they lie on.
pub struct Edges {
    halfedges: Vec<u32>,
    starts: Vec<u32>,
}

impl Edges {
    /// Groups halfedges by buckets of the smaller vertex, each sorted by the larger one: linear except for the
    /// logarithm of the degree.
    pub fn new(n_vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let ends = |h: u32| {
            let (a, b) = (origin(triangles, h), origin(triangles, next(h)));
            (a.min(b), a.max(b))
        };
        let n = 3 * triangles.len() as u32;
        // Count the halfedges of each smaller vertex.
        let mut bucket = vec![0u32; n_vertices + 1];
        for h in 0..n {
            bucket[ends(h).0 as usize + 1] += 1;
        }
        for v in 0..n_vertices {
            bucket[v + 1] += bucket[v];
        }
        // Put each halfedge into the bucket of its smaller vertex, with the larger one as its key.
        let mut cursor = bucket.clone();
        let mut keyed = vec![(0u32, 0u32); n as usize];
        for h in 0..n {
            let (low, high) = ends(h);
            keyed[cursor[low as usize] as usize] = (high, h);
            cursor[low as usize] += 1;
        }
        // Sort each bucket; an edge begins where the larger vertex changes.
        let mut starts = Vec::with_capacity(n as usize / 2 + 1);
        for v in 0..n_vertices {
            let (begin, end) = (bucket[v] as usize, bucket[v + 1] as usize);
            keyed[begin..end].sort_unstable();
            for i in begin..end {
                if i == begin || keyed[i].0 != keyed[i - 1].0 {
                    starts.push(i as u32);
                }
            }
        }
        starts.push(n);
        Self {
            halfedges: keyed.into_iter().map(|(_, h)| h).collect(),
            starts,
        }
    }

    /// Iterates over the halfedges of each edge, in file order.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.starts
            .windows(2)
            .map(|w| &self.halfedges[w[0] as usize..w[1] as usize])
    }
}
