//! Stencils: the vertices of each summand of an energy.

/// Lists of vertices, each in increasing order and without repetition.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stencils {
    starts: Vec<u32>,
    vertices: Vec<u32>,
}

impl Stencils {
    /// Creates stencils of `size` vertices each from their vertices, one after another.
    pub fn uniform(size: usize, vertices: impl Iterator<Item = u32>) -> Self {
        let vertices: Vec<u32> = vertices.collect();
        let starts = (0..=vertices.len()).step_by(size).map(|i| i as u32);
        Self {
            starts: starts.collect(),
            vertices,
        }
    }

    /// Creates stencils of any sizes.
    pub fn of<'a>(stencils: impl Iterator<Item = &'a [u32]>) -> Self {
        let mut found = Self {
            starts: vec![0],
            vertices: Vec::new(),
        };
        for stencil in stencils {
            found.vertices.extend_from_slice(stencil);
            found.starts.push(found.vertices.len() as u32);
        }
        found
    }

    /// Iterates over the vertices of each stencil.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        self.starts
            .windows(2)
            .map(|w| &self.vertices[w[0] as usize..w[1] as usize])
    }

    /// Iterates over the pairs of vertices of each stencil, smaller first, in the order (0, 1), (0, 2), (1, 2), (0, 3),
    /// …
    pub fn pairs(&self) -> impl Iterator<Item = (u32, u32)> + Clone {
        self.iter().flat_map(|stencil| {
            (1..stencil.len()).flat_map(move |j| (0..j).map(move |i| (stencil[i], stencil[j])))
        })
    }
}
