//! Which handle pulls what.

/// What one handle takes hold of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Aim {
    /// Vertices.
    pub vertices: Vec<u32>,
    /// Points, by their places in [`Handles::points`](unwrapd_method::solver::Handles::points).
    pub points: Vec<usize>,
}

impl Aim {
    /// At one vertex.
    pub(super) fn at_vertex(vertex: u32) -> Self {
        Self {
            vertices: vec![vertex],
            points: Vec::new(),
        }
    }

    /// At one point.
    pub(super) fn at_point(point: usize) -> Self {
        Self {
            vertices: Vec::new(),
            points: vec![point],
        }
    }
}
