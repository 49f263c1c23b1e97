//! Flips, mirrored charts and faces without UV area.

use super::faces::FaceMeasures;
use crate::certificate::UvTopology;
use crate::mesh::VAxis;
use serde::Serialize;

/// Flips, mirrored charts and faces without UV area.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Validity {
    /// Faces whose orientation, corrected for winding within their chart, is not the one that carries most of its UV area. Exactly zero is
    /// degenerate, never flipped.
    pub flipped: usize,
    /// Their part of the UV area.
    pub flipped_uv_area_frac: f64,
    /// Faces wound against the first face of their chart.
    pub winding_inconsistent_faces: usize,
    /// Charts seen from behind. Reported, not a fault.
    pub mirrored_charts: usize,
    /// Faces with area in 3D whose UV orientation is exactly zero.
    pub uv_degenerate: usize,
    /// Faces with area in 3D whose UV area is not exactly zero, but less than 1e-10 of its share.
    pub uv_collapsed: usize,
    /// Part of the surface area that degenerate and collapsed faces have.
    pub uv_degenerate_area3d_frac: f64,
}

impl Validity {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures, v_axis: VAxis) -> Validity {
        let flipped = flipped(topology);
        let area_of_flipped = flipped.iter().zip(&faces.area_uv).filter(|(f, _)| **f);
        let scale = faces.area_scale();
        let (mut uv_degenerate, mut uv_collapsed, mut area_lost) = (0, 0, 0.0);
        for face in (0..flipped.len()).filter(|&f| !faces.degenerate_3d[f]) {
            let degenerate = topology.orientation[face] == 0;
            let collapsed =
                !degenerate && faces.area_uv[face] * scale < 1e-10 * faces.area_3d[face];
            uv_degenerate += usize::from(degenerate);
            uv_collapsed += usize::from(collapsed);
            if degenerate || collapsed {
                area_lost += faces.area_3d[face];
            }
        }
        Validity {
            flipped: flipped.iter().filter(|&&f| f).count(),
            flipped_uv_area_frac: area_of_flipped.map(|(_, area)| area).sum::<f64>()
                / faces.total_uv.max(1e-300),
            winding_inconsistent_faces: topology.charts.winding.iter().filter(|&&w| w < 0).count(),
            mirrored_charts: topology.mirrored_charts(v_axis).len(),
            uv_degenerate,
            uv_collapsed,
            uv_degenerate_area3d_frac: area_lost / faces.total_3d.max(1e-300),
        }
    }
}

/// Returns for each face whether it is oriented against its chart.
pub(super) fn flipped(topology: &UvTopology) -> Vec<bool> {
    let positive = topology.chart_orientations(|_| true);
    let is_flipped = |face: usize| {
        let sign = topology.orientation_in_chart(face);
        sign != 0 && sign != positive[topology.charts.of_face[face] as usize]
    };
    (0..topology.faces.len()).map(is_flipped).collect()
}
