//! Boundary, seams and charts.

use super::faces::{FaceMeasures, dot, sub};
use crate::certificate::{Start, UvTopology};
use serde::Serialize;

/// Boundary, seams and charts. An edge with k ≥ 2 faces whose UVs fall into c groups is c − 1 times a seam; an edge with one face
/// is boundary, not seam. Lengths are those of the surface.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Seams {
    /// Edges with more than two faces.
    pub edges_nonmanifold: usize,
    /// Length of the edges with one face.
    pub boundary_length: f64,
    /// Length of all seams.
    pub seam_length: f64,
    /// Seam length over the square root of the surface area.
    pub seam_over_sqrt_area: Option<f64>,
    /// Seam length over the diagonal of the bounding box.
    pub seam_over_bbox: Option<f64>,
    /// Number of seams.
    pub seam_edges: usize,
    /// Charts: UV-connected sets of faces with UV area.
    pub charts: usize,
    /// Charts of one or two faces.
    pub charts_le2_faces: usize,
    /// Smallest number of charts that hold 90 % of the surface area.
    pub charts_for_90pct_area: usize,
    /// Charts whose winding contradicts itself.
    pub nonorientable_charts: usize,
}

impl Seams {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures) -> Seams {
        let mut seams = Seams::default();
        for edge in edges(topology) {
            seams.edges_nonmanifold += usize::from(edge.faces > 2);
            if edge.faces == 1 {
                seams.boundary_length += edge.length;
            }
            seams.seam_edges += edge.groups - 1;
            seams.seam_length += edge.length * (edge.groups - 1) as f64;
        }
        let per = |size: f64| (size > 0.0).then(|| seams.seam_length / size);
        seams.seam_over_sqrt_area = per(faces.total_3d.sqrt());
        seams.seam_over_bbox = per(faces.diagonal);
        let real = || faces.charts.iter().filter(|chart| chart.is_real());
        seams.charts = real().count();
        seams.charts_le2_faces = real().filter(|chart| chart.faces <= 2).count();
        seams.charts_for_90pct_area = charts_for(0.9, real().map(|chart| chart.area_3d).collect());
        seams.nonorientable_charts = topology.charts.nonorientable.iter().filter(|&&n| n).count();
        seams
    }
}

struct SeamEdge {
    faces: usize,
    groups: usize,
    length: f64,
}

fn edges(topology: &UvTopology) -> Vec<SeamEdge> {
    let mut edges: Vec<SeamEdge> = Vec::new();
    for (&corner, start) in topology.edges.order.iter().zip(&topology.edges.start) {
        match (start, edges.last_mut()) {
            (Start::Group, Some(edge)) => {
                edge.faces += 1;
                edge.groups += 1;
            }
            (Start::Same, Some(edge)) => edge.faces += 1,
            _ => {
                let [a, b] = topology
                    .halfedge(corner)
                    .vertices
                    .map(|v| topology.points[v as usize]);
                let along = sub(b, a);
                edges.push(SeamEdge {
                    faces: 1,
                    groups: 1,
                    length: dot(along, along).sqrt(),
                });
            }
        }
    }
    edges
}

/// Returns how many of the largest areas hold the share `part` of their sum.
fn charts_for(part: f64, mut areas: Vec<f64>) -> usize {
    areas.sort_unstable_by(|a, b| b.total_cmp(a));
    let wanted = part * areas.iter().sum::<f64>();
    let mut held = 0.0;
    for (k, area) in areas.iter().enumerate() {
        held += area;
        if held >= wanted {
            return k + 1;
        }
    }
    areas.len()
}
