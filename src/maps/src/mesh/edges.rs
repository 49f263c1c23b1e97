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

// Faces around each vertex.

/// The faces at each vertex, in increasing order.
#[derive(Clone, Debug, Default)]
pub struct VertexFaces {
    /// Start of each vertex in `faces`: those of vertex v are `faces[starts[v]..starts[v + 1]]`.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl VertexFaces {
    /// Buckets the corners by their vertices, which must be below `n_vertices`. O(n).
    pub fn new(n_vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut starts = vec![0; n_vertices + 1];
        for &v in triangles.as_flattened() {
            starts[v as usize + 1] += 1;
        }
        for v in 0..n_vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut faces = vec![0; 3 * triangles.len()];
        for (f, triangle) in (0..).zip(triangles) {
            for &v in triangle {
                faces[next[v as usize] as usize] = f;
                next[v as usize] += 1;
            }
        }
        Self { starts, faces }
    }

    /// Returns the faces at one vertex.
    pub fn of(&self, vertex: u32) -> &[u32] {
        let v = vertex as usize;
        &self.faces[self.starts[v] as usize..self.starts[v + 1] as usize]
    }
}

// Disjoint sets.

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

// The vertices of a part of a mesh, numbered without gaps.

/// Vertices that some elements use, in increasing order; the index of a vertex here is its number in the part.
#[derive(Clone, Debug, Default)]
pub struct UsedVertices {
    vertices: Vec<u32>,
}

impl UsedVertices {
    /// Collects the vertices of these corners. O(n log n).
    pub fn new(corners: impl IntoIterator<Item = u32>) -> Self {
        let mut vertices: Vec<u32> = corners.into_iter().collect();
        vertices.sort_unstable();
        vertices.dedup();
        Self { vertices }
    }

    /// Returns the number of used vertices.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// Returns the vertices by their numbers in the whole mesh.
    pub fn as_slice(&self) -> &[u32] {
        &self.vertices
    }

    /// Converts into the vertices by their numbers in the whole mesh.
    pub fn into_vec(self) -> Vec<u32> {
        self.vertices
    }

    /// Returns the number of a vertex in the part, if it is used. O(log n).
    pub fn number(&self, vertex: u32) -> Option<u32> {
        let place = self.vertices.binary_search(&vertex);
        place.ok().map(|place| place as u32)
    }

    /// Renumbers corners to the numbers of the part. All of them must be used. O(n).
    pub fn renumber(&self, corners: &mut [u32]) {
        let n_vertices = self.vertices.last().map_or(0, |&last| last as usize + 1);
        let mut number = vec![0; n_vertices];
        for (place, &vertex) in (0..).zip(&self.vertices) {
            number[vertex as usize] = place;
        }
        for vertex in corners {
            *vertex = number[*vertex as usize];
        }
    }
}

// Searches over glued faces.

/// Searches breadth first over glued edges from the faces in `faces`, to which it adds those that it enters.
///
/// Calls `enters` at each halfedge of a face that is glued, with the halfedge and its twin. `enters` returns whether to
/// enter the face of the twin, and must return `true` at most once for each face. O(n).
pub fn spread(twin: &[u32], faces: &mut Vec<u32>, mut enters: impl FnMut(u32, u32) -> bool) {
    let mut done = 0;
    while let Some(&face) = faces.get(done) {
        done += 1;
        for h in 3 * face..3 * face + 3 {
            let t = twin[h as usize];
            if t != CUT && enters(h, t) {
                faces.push(t / 3);
            }
        }
    }
}
