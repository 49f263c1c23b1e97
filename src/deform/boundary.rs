//! Whether the boundary of a map of the plane stays.

use serde::{Deserialize, Serialize};

use crate::mesh::PlanarMesh;

/// What becomes of the boundary of a map of the plane that is pulled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// It follows what is pulled.
    #[default]
    Free,
    /// It stays; a map that does not overlap itself will not afterwards.
    Fixed,
}

impl Boundary {
    /// The vertices of `mesh` that stay, ascending.
    pub(super) fn held(self, mesh: &PlanarMesh) -> Vec<u32> {
        if self == Self::Free {
            return Vec::new();
        }
        let mut boundary: Vec<u32> = mesh.boundary().iter().map(|edge| edge[0]).collect();
        boundary.sort_unstable();
        boundary.dedup();
        boundary
    }
}
