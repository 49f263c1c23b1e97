//! Search for boundary vertices near boundary edges.

use unwrapd_maps::plane::BoxIndex;
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, widened};

/// A vertex of a boundary and an edge of it that does not end there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub vertex: u32,
    pub edge: [u32; 2],
}

impl Pair {
    /// Returns the vertex and the ends of the edge.
    pub fn vertices(&self) -> [u32; 3] {
        [self.vertex, self.edge[0], self.edge[1]]
    }

    /// Returns the positions of these.
    pub fn places(&self, x: &[f64]) -> [[f64; 2]; 3] {
        self.vertices().map(|v| place(x, v))
    }
}

pub(super) fn place(x: &[f64], vertex: u32) -> [f64; 2] {
    let first = 2 * vertex as usize;
    [x[first], x[first + 1]]
}

/// Visits every pair whose distance may fall below `radius` while the vertices move from `x` to `to`, in a fixed order.
///
/// Boundaries are closed, so that each vertex is the first of an edge; one at which several meet is visited for each.
pub(super) fn near_pairs(
    edges: &[[u32; 2]],
    x: &[f64],
    to: &[f64],
    radius: f64,
    mut visit: impl FnMut(Pair),
) {
    let swept = |edge: &[u32; 2]| {
        let [a, b] = *edge;
        let ends = [place(x, a), place(x, b), place(to, a), place(to, b)];
        widened(bounds_of(&ends), 0.5 * radius)
    };
    let boxes: Vec<Bounds> = edges.iter().map(swept).collect();
    // Without a budget: an edge that was left out could be crossed.
    BoxIndex::new(&boxes).pairs(u64::MAX, |i, j| {
        for (i, j) in [(i, j), (j, i)] {
            let (vertex, edge) = (edges[i as usize][0], edges[j as usize]);
            if !edge.contains(&vertex) {
                visit(Pair { vertex, edge });
            }
        }
    });
}
