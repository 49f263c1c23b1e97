//! Counts, areas and extents.

use super::faces::FaceMeasures;
use crate::certificate::UvTopology;
use crate::mesh::UsedVertices;
use serde::Serialize;

/// Counts, areas and extents.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Size {
    /// Faces.
    pub faces: usize,
    /// Vertices that faces refer to, as the file has them.
    pub vertices: usize,
    /// Vertices after welding equal positions.
    pub vertices_welded: usize,
    /// Faces with a UV that is not finite (or without UVs or vertices).
    pub uv_nonfinite_faces: usize,
    /// Faces without area in 3D.
    pub faces_degenerate_3d: usize,
    /// Surface area.
    pub area_3d: f64,
    /// Sum of the unsigned UV areas of the faces.
    pub area_uv: f64,
    /// Diagonal of the bounding box of the positions.
    pub bbox_diag: f64,
    /// Smallest u and v.
    pub uv_min: [f64; 2],
    /// Greatest u and v.
    pub uv_max: [f64; 2],
    /// Width and height of the UV bounding box.
    pub uv_bbox: [f64; 2],
    /// `true` if all UVs lie in the unit square, to 1e-6.
    pub uv_in_unit_square: bool,
}

impl Size {
    pub(super) fn new(
        triangles: &[[u32; 3]],
        topology: &UvTopology,
        faces: &FaceMeasures,
        aspect: f64,
    ) -> Size {
        let [low, high] = topology.bounds;
        Size {
            faces: triangles.len(),
            vertices: distinct(triangles),
            vertices_welded: distinct(&topology.faces),
            uv_nonfinite_faces: count(&topology.unusable),
            faces_degenerate_3d: count(&faces.degenerate_3d),
            area_3d: faces.total_3d,
            area_uv: faces.total_uv,
            bbox_diag: faces.diagonal,
            uv_min: low,
            uv_max: high,
            uv_bbox: [0, 1].map(|axis| (high[axis] - low[axis]).max(1e-100)),
            uv_in_unit_square: in_unit_square(topology, aspect),
        }
    }
}

/// Returns whether all UVs lie in the unit square, whose width is `aspect` here, to 1e-6.
pub(super) fn in_unit_square(topology: &UvTopology, aspect: f64) -> bool {
    let [low, high] = topology.bounds;
    low.iter().all(|&x| x >= -1e-6) && high[0] <= aspect + 1e-6 && high[1] <= 1.0 + 1e-6
}

fn count(flags: &[bool]) -> usize {
    flags.iter().filter(|&&flag| flag).count()
}

fn distinct(faces: &[[u32; 3]]) -> usize {
    UsedVertices::new(faces.iter().flatten().copied()).count()
}
