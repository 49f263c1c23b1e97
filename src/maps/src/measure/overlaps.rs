//! Overlapping faces.

use crate::certificate::{OrientedFaces, Overlap, UvTopology, Visit};
use crate::mesh::CornerUvs;
use serde::Serialize;

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
            overlap_search_truncated: Some(visit == Visit::Truncated),
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
                let height = |r: &[f64; 2]| (d[0] * (r[1] - p[1]) - d[1] * (r[0] - p[0])) / length;
                b.iter().map(height).fold(f64::NEG_INFINITY, f64::max)
            })
            .fold(f64::INFINITY, f64::min)
    };
    above(a, b).min(above(b, a))
}
