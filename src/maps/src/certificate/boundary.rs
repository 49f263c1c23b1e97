//! Boundaries of charts.

use super::box_tree::{Bounds, BoxTree, BoxVisit, search_budget};
use super::topology::{Start, UvTopology};
use unwrapd_method::numerics::predicates::orient2d_sign;

pub(crate) type BoundarySegment = [[f64; 2]; 2];

/// An edge with a face of its chart on one side only.
#[derive(Clone, Copy)]
pub(crate) struct BoundaryEdge {
    pub face: u32,
    pub chart: u32,
    /// Welded vertices of its ends.
    pub vertices: [u32; 2],
    /// UVs of its ends.
    pub uvs: BoundarySegment,
}

/// Boundary edges of all charts.
pub(crate) struct ChartBoundary {
    pub edges: Vec<BoundaryEdge>,
}

impl ChartBoundary {
    /// Collects the boundary edges of the faces that count: edges at which more or less than two faces meet with equal
    /// UVs. Two faces whose UVs agree only within the tolerance of charts get an edge each.
    pub fn new(topology: &UvTopology, counts: impl Fn(u32) -> bool) -> ChartBoundary {
        let mut edges = Vec::new();
        let mut first = 0;
        let order = &topology.edges.order;
        while first < order.len() {
            let others = &topology.edges.start[first + 1..];
            let n_same = others.iter().take_while(|s| **s == Start::Same).count();
            let group = order[first..=first + n_same].iter();
            let halfedges = group
                .map(|&corner| topology.halfedge(corner))
                .filter(|h| counts(h.face));
            let mut next = halfedges.clone();
            let is_inner = match [next.next(), next.next(), next.next()] {
                [Some(a), Some(b), None] => a.uvs == b.uvs,
                _ => false,
            };
            if !is_inner {
                edges.extend(halfedges.map(|h| BoundaryEdge {
                    face: h.face,
                    chart: topology.charts.of_face[h.face as usize],
                    vertices: h.vertices,
                    uvs: h.uvs,
                }));
            }
            first += 1 + n_same;
        }
        ChartBoundary { edges }
    }

    /// Scales the UVs along the axes.
    pub fn scaled(&self, by: [f64; 2]) -> ChartBoundary {
        ChartBoundary {
            edges: self
                .edges
                .iter()
                .map(|edge: &BoundaryEdge| BoundaryEdge {
                    uvs: edge.uvs.map(|[u, v]| [u * by[0], v * by[1]]),
                    ..*edge
                })
                .collect(),
        }
    }

    /// Visits every pair of edges whose boxes, enlarged by `margin`, meet.
    pub fn near_pairs(
        &self,
        margin: f64,
        mut visit: impl FnMut(&BoundaryEdge, &BoundaryEdge),
    ) -> BoxVisit {
        self.tree(margin)
            .pairs(search_budget(self.edges.len()), |i, j| {
                visit(&self.edges[i as usize], &self.edges[j as usize]);
            })
    }

    /// Returns the smallest distance between edges of two charts, infinite if there is only one chart.
    pub fn closest(&self) -> (f64, BoxVisit) {
        let charts: Vec<u32> = self.edges.iter().map(|edge| edge.chart).collect();
        self.tree(0.0)
            .closest(&charts, search_budget(self.edges.len()), |i, j| {
                segment_distance(self.edges[i as usize].uvs, self.edges[j as usize].uvs)
            })
    }

    fn tree(&self, margin: f64) -> BoxTree {
        let boxes: Vec<Bounds> = (self.edges.iter())
            .map(|edge| bounds(&edge.uvs, margin))
            .collect();
        BoxTree::new(&boxes)
    }
}

fn bounds([a, b]: &BoundarySegment, margin: f64) -> Bounds {
    [
        [a[0].min(b[0]) - margin, a[1].min(b[1]) - margin],
        [a[0].max(b[0]) + margin, a[1].max(b[1]) + margin],
    ]
}

/// Returns the distance of two segments, rounded; 0 if they cross.
pub(crate) fn segment_distance([a, b]: BoundarySegment, [c, d]: BoundarySegment) -> f64 {
    let crosses = |a, b, c, d| orient2d_sign(a, b, c) * orient2d_sign(a, b, d) < 0;
    if crosses(a, b, c, d) && crosses(c, d, a, b) {
        return 0.0;
    }
    point_distance(a, [c, d])
        .min(point_distance(b, [c, d]))
        .min(point_distance(c, [a, b]))
        .min(point_distance(d, [a, b]))
}

fn point_distance(p: [f64; 2], [a, b]: BoundarySegment) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let to = [p[0] - a[0], p[1] - a[1]];
    let length_squared = along[0] * along[0] + along[1] * along[1];
    let t = ((to[0] * along[0] + to[1] * along[1]) / length_squared.max(1e-300)).clamp(0.0, 1.0);
    (to[0] - t * along[0]).hypot(to[1] - t * along[1])
}
