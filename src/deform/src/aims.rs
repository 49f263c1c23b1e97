//! The vertices and points that each handle pulls.

/// The vertices and points that one handle pulls.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Aim {
    /// Indices of the vertices.
    pub vertices: Vec<u32>,
    /// Points, as indices into [`Handles::points`](unwrapd_method::solver::Handles::points).
    pub points: Vec<usize>,
}

impl Aim {
    /// Pulls one vertex.
    pub(super) fn at_vertex(vertex: u32) -> Self {
        Self {
            vertices: vec![vertex],
            points: Vec::new(),
        }
    }

    /// Pulls one point.
    pub(super) fn at_point(point: usize) -> Self {
        Self {
            vertices: Vec::new(),
            points: vec![point],
        }
    }
}
