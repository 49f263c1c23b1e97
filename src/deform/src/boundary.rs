//! Treatment of the boundary of a map of the plane.

use serde::{Deserialize, Serialize};

use unwrapd_maps::mesh::{UsedVertices, boundary_edges};

/// Treatment of the boundary of a map of the plane while handles pull it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// The boundary is free.
    #[default]
    Free,
    /// The boundary stays fixed. A map without overlaps stays without overlaps.
    Fixed,
}

impl Boundary {
    /// Returns the vertices of `triangles` that stay fixed, in increasing order.
    pub(super) fn held(self, n_vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
        if self == Self::Free {
            return Vec::new();
        }
        let edges = boundary_edges(n_vertices, triangles);
        UsedVertices::new(edges.into_iter().flatten()).into_vec()
    }
}
