//! Faces around each vertex.

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
