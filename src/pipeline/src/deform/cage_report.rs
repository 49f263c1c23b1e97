//! Report of deforming in a cage.

use serde::Serialize;
use unwrapd_files::document::Warning;
use unwrapd_maps::certificate::Crossings;

/// A cage, and the effect of deforming it on the surfaces in it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct CageReport {
    /// Cubes the cage consists of.
    pub voxels: usize,
    /// Tetrahedra, six for each.
    pub tets: usize,
    /// Connected parts of the cage that have no handle and stay at rest.
    pub idle_parts: usize,
    /// Vertices of all surfaces, those of cuts included.
    pub surface_vertices: usize,
    /// Triangles of all surfaces, pieces counted.
    pub surface_triangles: usize,
    /// Where the surfaces pass through themselves and each other at rest.
    pub crossings_before: Crossings,
    /// Where they do in the file written.
    pub crossings_after: Crossings,
    /// Warnings about the files; reports list them among their own.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}
