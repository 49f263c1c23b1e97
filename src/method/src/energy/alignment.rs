//! Edges that are to run along an axis.

use super::{Assembly, Term};
use crate::numerics::stencils::Stencils;

/// An edge of a map that is to run along an axis of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignedEdge {
    /// Its two vertices, the smaller first.
    pub vertices: [u32; 2],
    /// The coordinate that both are to share: 0 if the edge runs along v, 1 if along u.
    pub coordinate: usize,
    /// Its length when the alignment began.
    pub length: f64,
}

/// ```text
/// α Σₑ (x_b − x_a)² / ℓₑ       x the coordinate that the ends a and b of edge e are to share
/// ```
/// At its first length ℓ, an edge at the angle θ to its axis adds α ℓ sin²θ, however finely the border is divided.
///
/// Minimum 0, where all edges run along their axes. Unit: α times a length. Domain: everywhere; it is a convex quadratic form.
/// From: Liu et al. 2019, Atlas Refinement with Bounded Packing Efficiency, section 4, which turns edges by an energy of their
/// angles. Tests: `energy::taylor_alignment`.
#[derive(Clone, Debug)]
pub struct Alignment {
    /// The edges, each at most once.
    pub edges: Vec<AlignedEdge>,
    /// α, the strength.
    pub alpha: f64,
}

impl Alignment {
    /// Returns the indices of the two unknowns of an edge.
    fn unknowns(edge: &AlignedEdge) -> [usize; 2] {
        edge.vertices.map(|v| 2 * v as usize + edge.coordinate)
    }
}

impl Term for Alignment {
    fn dim(&self) -> usize {
        2
    }

    fn stencils(&self) -> Stencils {
        Stencils::uniform(2, self.edges.iter().flat_map(|edge| edge.vertices))
    }

    fn value(&self, x: &[f64]) -> f64 {
        let terms = self.edges.iter().map(|edge| {
            let [a, b] = Self::unknowns(edge);
            (x[b] - x[a]).powi(2) / edge.length
        });
        self.alpha * terms.sum::<f64>()
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for (index, edge) in self.edges.iter().enumerate() {
            let [a, b] = Self::unknowns(edge);
            let curvature = 2.0 * self.alpha / edge.length;
            let pull = curvature * (x[b] - x[a]);
            assembly.add_to_gradient(b, pull);
            assembly.add_to_gradient(a, -pull);
            let mut block = [[0.0; 2]; 2];
            block[edge.coordinate][edge.coordinate] = curvature;
            for v in edge.vertices {
                assembly.add_diagonal(v, &block);
            }
            block[edge.coordinate][edge.coordinate] = -curvature;
            assembly.add_pair(index, 0, &block);
        }
    }
}
