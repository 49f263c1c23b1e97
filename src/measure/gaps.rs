//! Distances between charts.

use super::faces::FaceMeasures;
use super::size::in_unit_square;
use crate::certificate::{Bounds, BoxTree, Start, UvTopology, Visit, search_budget};
use crate::numerics::predicates::orient2d_sign;
use serde::Serialize;

/// Distances between the boundaries of different charts, in parts of the unit square's side (of the UV extent where
/// UVs leave it); 0 means that charts touch or cross. Null when there is one chart.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct Gaps {
    /// The smallest distance between two charts.
    pub gap_uv: Option<f64>,
    /// The same in texels of a 1024² texture.
    pub gap_texels_1024: Option<f64>,
    /// The same in texels of a 4096² texture.
    pub gap_texels_4096: Option<f64>,
    /// Charts less than a texel of a 1024² texture away from another.
    pub charts_gap_lt_1texel_1024: Option<usize>,
    /// Charts less than a texel of a 4096² texture away from another.
    pub charts_gap_lt_1texel_4096: Option<usize>,
    /// Whether the search stopped at its limit.
    pub gap_truncated: bool,
}

impl Gaps {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures) -> Gaps {
        let real = faces.charts.iter().filter(|chart| chart.is_real()).count();
        let boundary = Boundary::new(topology, faces);
        if real < 2 || boundary.segments.is_empty() {
            return Gaps::default();
        }
        let side = if in_unit_square(topology) {
            1.0
        } else {
            topology.extent()
        };
        let (nearest, visit) = boundary.nearest_charts(faces.charts.len(), side / 1024.0);
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

type Segment = [[f64; 2]; 2];

/// The edges of charts in UV: those without a second face of the same UVs.
struct Boundary {
    segments: Vec<Segment>,
    /// The chart of each segment.
    charts: Vec<u32>,
}

impl Boundary {
    fn new(topology: &UvTopology, faces: &FaceMeasures) -> Boundary {
        let start = &topology.edges.start;
        let mut boundary = Boundary {
            segments: Vec::new(),
            charts: Vec::new(),
        };
        for (k, &corner) in topology.edges.order.iter().enumerate() {
            let alone = start[k] != Start::Same && start.get(k + 1) != Some(&Start::Same);
            let chart = topology.charts.of_face[(corner / 3) as usize];
            if alone && faces.charts[chart as usize].is_real() {
                boundary.segments.push(topology.halfedge(corner).uvs);
                boundary.charts.push(chart);
            }
        }
        boundary
    }

    /// For each chart the distance to the nearest other, infinite when that is more than `reach`.
    fn nearest_charts(&self, n_charts: usize, reach: f64) -> (Vec<f64>, Visit) {
        let margin = 0.5 * reach * (1.0 + 1e-9); // a pair at just this distance is found
        let boxes: Vec<Bounds> = self.segments.iter().map(|s| bounds(s, margin)).collect();
        let mut nearest = vec![f64::INFINITY; n_charts];
        let visit = BoxTree::new(&boxes).pairs(search_budget(boxes.len()), |i, j| {
            let [a, b] = [i, j].map(|k| self.charts[k as usize] as usize);
            if a != b && nearest[a].max(nearest[b]) > 0.0 {
                let distance = self.distance(i, j);
                if distance <= reach {
                    nearest[a] = nearest[a].min(distance);
                    nearest[b] = nearest[b].min(distance);
                }
            }
        });
        (nearest, visit)
    }

    /// The smallest distance between segments of two charts.
    fn closest(&self) -> (f64, Visit) {
        let boxes: Vec<Bounds> = self.segments.iter().map(|s| bounds(s, 0.0)).collect();
        BoxTree::new(&boxes).closest(&self.charts, search_budget(boxes.len()), |i, j| {
            self.distance(i, j)
        })
    }

    fn distance(&self, i: u32, j: u32) -> f64 {
        segment_distance(self.segments[i as usize], self.segments[j as usize])
    }
}

fn bounds([a, b]: &Segment, margin: f64) -> Bounds {
    [
        [a[0].min(b[0]) - margin, a[1].min(b[1]) - margin],
        [a[0].max(b[0]) + margin, a[1].max(b[1]) + margin],
    ]
}

fn segment_distance([a, b]: Segment, [c, d]: Segment) -> f64 {
    let crosses = |a, b, c, d| orient2d_sign(a, b, c) * orient2d_sign(a, b, d) < 0;
    if crosses(a, b, c, d) && crosses(c, d, a, b) {
        return 0.0;
    }
    point_distance(a, [c, d])
        .min(point_distance(b, [c, d]))
        .min(point_distance(c, [a, b]))
        .min(point_distance(d, [a, b]))
}

fn point_distance(p: [f64; 2], [a, b]: Segment) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let to = [p[0] - a[0], p[1] - a[1]];
    let length_squared = along[0] * along[0] + along[1] * along[1];
    let t = ((to[0] * along[0] + to[1] * along[1]) / length_squared.max(1e-300)).clamp(0.0, 1.0);
    (to[0] - t * along[0]).hypot(to[1] - t * along[1])
}
