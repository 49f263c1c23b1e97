//! Distances between charts.

use super::faces::FaceMeasures;
use super::size::in_unit_square;
use crate::certificate::{ChartBoundary, UvTopology, Visit, segment_distance};
use serde::Serialize;

/// Distances between the boundaries of different charts, in parts of the unit square's side (of the UV extent where
/// UVs leave it); 0 means that charts touch or cross. Null when there is one chart.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Gaps {
    /// The smallest distance between two charts.
    pub gap_uv: Option<f64>,
    /// The smallest distance in texels of a 1024² texture.
    pub gap_texels_1024: Option<f64>,
    /// The smallest distance in texels of a 4096² texture.
    pub gap_texels_4096: Option<f64>,
    /// Charts less than a texel of a 1024² texture away from another.
    pub charts_gap_lt_1texel_1024: Option<usize>,
    /// Charts less than a texel of a 4096² texture away from another.
    pub charts_gap_lt_1texel_4096: Option<usize>,
    /// `true` if the search stopped at its limit.
    pub gap_truncated: bool,
}

impl Gaps {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures, aspect: f64) -> Gaps {
        let real = faces.charts.iter().filter(|chart| chart.is_real()).count();
        let chart = |face: u32| topology.charts.of_face[face as usize] as usize;
        let boundary = ChartBoundary::new(topology, |face| faces.charts[chart(face)].is_real());
        if real < 2 || boundary.edges.is_empty() {
            return Gaps::default();
        }
        // Measure relative to the unit square or, if UVs leave it, to their extent.
        let side = if in_unit_square(topology, aspect) {
            1.0
        } else {
            topology.extent()
        };
        // Look for charts within a texel of 1024; if there are none, search for the closest pair anywhere.
        let (nearest, visit) = nearest_charts(&boundary, faces.charts.len(), side / 1024.0);
        let within = nearest.iter().copied().fold(f64::INFINITY, f64::min);
        let (gap, visit) = if within.is_finite() || visit == Visit::Truncated {
            (within, visit)
        } else {
            boundary.closest()
        };
        let gap_uv = gap.is_finite().then_some(gap / side);
        // 0.999: a chart placed just a texel away may come out nearer by rounding.
        let closer_than = |texels: f64| {
            Some(
                nearest
                    .iter()
                    .filter(|&&gap| gap < side / texels * 0.999)
                    .count(),
            )
        };
        Gaps {
            gap_uv,
            gap_texels_1024: gap_uv.map(|gap| gap * 1024.0),
            gap_texels_4096: gap_uv.map(|gap| gap * 4096.0),
            charts_gap_lt_1texel_1024: closer_than(1024.0),
            charts_gap_lt_1texel_4096: closer_than(4096.0),
            gap_truncated: visit == Visit::Truncated,
        }
    }
}

/// Returns for each chart the distance to the nearest other, infinite if that is more than `reach`.
fn nearest_charts(boundary: &ChartBoundary, n_charts: usize, reach: f64) -> (Vec<f64>, Visit) {
    let margin = 0.5 * reach * (1.0 + 1e-9); // a pair at just this distance is found
    let mut nearest = vec![f64::INFINITY; n_charts];
    let visit = boundary.near_pairs(margin, |p, q| {
        let [a, b] = [p, q].map(|edge| edge.chart as usize);
        if a != b && nearest[a].max(nearest[b]) > 0.0 {
            let distance = segment_distance(p.uvs, q.uvs);
            if distance <= reach {
                nearest[a] = nearest[a].min(distance);
                nearest[b] = nearest[b].min(distance);
            }
        }
    });
    (nearest, visit)
}
