//! Flips, mirrored charts and faces without UV area.

use super::faces::FaceMeasures;
use crate::certificate::{BoxVisit, OrientedFaces, Overlap, UvTopology};
use crate::mesh::{CornerUvs, VAxis};
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
    (0..topology.faces.len())
        .map(|face: usize| {
            let sign = topology.orientation_in_chart(face);
            sign != 0 && sign != positive[topology.charts.of_face[face] as usize]
        })
        .collect()
}

// Overlapping faces.

/// Largest depth of overlaps that are attributed to rounding, as a share of the UV extent (0.0004 texel at 4096).
const TOLERANCE: f64 = 1e-7;

/// Pairs of faces whose interiors intersect in UV; null when not searched.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Overlaps {
    /// All pairs, decided exactly.
    pub overlap_pairs_exact: Option<u64>,
    /// Pairs that overlap by more than 1e-7 of the UV extent.
    pub overlap_pairs: Option<u64>,
    /// Those of them that lie in one chart.
    pub overlap_pairs_same_chart: Option<u64>,
    /// Those of them that lie in two charts.
    pub overlap_pairs_between_charts: Option<u64>,
    /// Faces in such pairs.
    pub overlap_faces: Option<u64>,
    /// `true` if the search stopped at its limit, so that there may be more.
    pub overlap_search_truncated: Option<bool>,
}

impl Overlaps {
    pub(super) fn new(topology: &UvTopology, overlap: Overlap) -> Overlaps {
        if overlap == Overlap::Skip {
            return Overlaps::default();
        }
        let tolerance = TOLERANCE * topology.extent();
        let mut overlapping = vec![false; topology.faces.len()];
        let (mut exact, mut same, mut between) = (0, 0, 0);
        let visit = OrientedFaces::new(topology).overlaps(|pair| {
            exact += 1;
            if depth(&pair.corners) > tolerance {
                let [a, b] = pair.faces.map(|f| f as usize);
                (overlapping[a], overlapping[b]) = (true, true);
                let one_chart = topology.charts.of_face[a] == topology.charts.of_face[b];
                *if one_chart { &mut same } else { &mut between } += 1;
            }
        });
        Overlaps {
            overlap_pairs_exact: Some(exact),
            overlap_pairs: Some(same + between),
            overlap_pairs_same_chart: Some(same),
            overlap_pairs_between_charts: Some(between),
            overlap_faces: Some(overlapping.iter().filter(|&&o| o).count() as u64),
            overlap_search_truncated: Some(visit == BoxVisit::Truncated),
        }
    }
}

/// Returns the distance by which two counter-clockwise triangles would have to move apart: over all edges of both the
/// least height of the other triangle's highest corner above the edge's line.
fn depth([a, b]: &[CornerUvs; 2]) -> f64 {
    let above = |a: &CornerUvs, b: &CornerUvs| {
        (0..3)
            .map(|e| {
                let (p, q) = (a[e], a[(e + 1) % 3]);
                let d = [q[0] - p[0], q[1] - p[1]];
                let length = d[0].hypot(d[1]).max(1e-300);
                b.iter()
                    .map(|r: &[f64; 2]| (d[0] * (r[1] - p[1]) - d[1] * (r[0] - p[0])) / length)
                    .fold(f64::NEG_INFINITY, f64::max)
            })
            .fold(f64::INFINITY, f64::min)
    };
    above(a, b).min(above(b, a))
}
