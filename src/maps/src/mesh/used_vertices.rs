//! The vertices of a part of a mesh, numbered without gaps.

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
