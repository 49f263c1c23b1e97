//! Measures of each face and chart that all figures need.

use crate::certificate::{Start, UvTopology};
use crate::mesh::NEEDLE;
use serde::Serialize;

/// Share of the surface area from which needles count for distortion like all faces.
const MOST_NEEDLES: f64 = 1e-3;

/// Areas of faces and charts.
pub(super) struct FaceMeasures<'a> {
    pub area_3d: Vec<f64>,
    pub area_uv: Vec<f64>,
    /// For each face whether it has no area in 3D, by the tests of the [module](super).
    pub degenerate_3d: Vec<bool>,
    /// For each face whether it is a needle: its height is below [`NEEDLE`] times its longest side, although it may
    /// have area.
    pub needle: Vec<bool>,
    pub total_3d: f64,
    pub total_uv: f64,
    /// Diagonal of the bounding box of all positions.
    pub diagonal: f64,
    pub charts: Vec<ChartMeasures>,
    /// Intended area of the faces that count for distortion, and their area in UV.
    counted_intended: f64,
    counted_uv: f64,
    needles_count: bool,
    weights: Option<&'a [f64]>,
}

#[derive(Clone, Copy, Default)]
pub(super) struct ChartMeasures {
    pub faces: usize,
    pub area_3d: f64,
    pub area_uv: f64,
    /// Intended area.
    pub area_intended: f64,
}

impl ChartMeasures {
    /// Returns whether the chart counts as one: it has UV area.
    pub fn is_real(&self) -> bool {
        self.area_uv > 0.0
    }
}

impl<'a> FaceMeasures<'a> {
    pub fn new(topology: &UvTopology, weights: Option<&'a [f64]>) -> Self {
        let diagonal = diagonal(&topology.points);
        let n_faces = topology.faces.len();
        let mut area_3d = Vec::with_capacity(n_faces);
        let mut degenerate_3d = Vec::with_capacity(n_faces);
        let mut needle = Vec::with_capacity(n_faces);
        // Areas in 3D, degenerate faces and needles.
        for face in 0..n_faces {
            let [a, b, c] = face_points(topology, face);
            let (e1, e2, e3) = (sub(b, a), sub(c, a), sub(c, b));
            let normal = cross(e1, e2);
            let area = 0.5 * dot(normal, normal).sqrt();
            let longest = dot(e1, e1).max(dot(e2, e2)).max(dot(e3, e3));
            let sliver = 2.0 * area < 1e-9 * longest || area < 1e-14 * diagonal * diagonal;
            area_3d.push(area);
            degenerate_3d.push(area <= 0.0 || sliver);
            needle.push(2.0 * area < NEEDLE * longest);
        }
        let area_uv: Vec<f64> = (0..n_faces).map(|f| topology.area(f)).collect();
        // Sums over charts.
        let mut charts = vec![ChartMeasures::default(); topology.charts.nonorientable.len()];
        for (face, &chart) in topology.charts.of_face.iter().enumerate() {
            let chart = &mut charts[chart as usize];
            chart.faces += 1;
            chart.area_3d += area_3d[face];
            chart.area_uv += area_uv[face];
            chart.area_intended += area_3d[face] * weight(weights, face).powi(2);
        }
        let mut faces = Self {
            total_3d: area_3d.iter().sum(),
            counted_intended: 0.0,
            counted_uv: 0.0,
            needles_count: false,
            weights,
            total_uv: area_uv.iter().sum(),
            area_3d,
            area_uv,
            degenerate_3d,
            needle,
            diagonal,
            charts,
        };
        // Totals of the faces that count for distortion.
        faces.needles_count = faces.needle_share() > MOST_NEEDLES;
        let counted = (0..n_faces).filter(|&face| faces.counts(face));
        let areas = counted.map(|face| {
            let intended = faces.area_3d[face] * weight(weights, face).powi(2);
            [intended, faces.area_uv[face]]
        });
        let totals = areas.fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y]);
        [faces.counted_intended, faces.counted_uv] = totals;
        faces
    }

    /// Returns the needles' share of the surface area.
    pub fn needle_share(&self) -> f64 {
        let needles = self.area_3d.iter().zip(&self.needle);
        let area: f64 = needles.filter(|(_, needle)| **needle).map(|(a, _)| a).sum();
        area / self.total_3d.max(f64::MIN_POSITIVE)
    }

    /// Returns whether a face counts for distortion: needles do only if they are a visible part of the surface.
    pub fn counts(&self, face: usize) -> bool {
        !self.needle[face] || self.needles_count
    }

    /// Returns A₃d / A_uv of the faces that count: squared lengths in UV times this compare with those on the surface,
    /// enlarged by the weights.
    pub fn area_scale(&self) -> f64 {
        self.counted_intended / self.counted_uv.max(1e-300)
    }

    /// Returns the intended density of a face.
    pub fn weight(&self, face: usize) -> f64 {
        weight(self.weights, face)
    }
}

fn weight(weights: Option<&[f64]>, face: usize) -> f64 {
    weights.map_or(1.0, |weights| weights[face])
}

pub(super) fn face_points(topology: &UvTopology, face: usize) -> [[f64; 3]; 3] {
    topology.faces[face].map(|v| topology.points[v as usize])
}

pub(super) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn diagonal(points: &[[f64; 3]]) -> f64 {
    let first = points.first().copied().unwrap_or_default();
    let (mut low, mut high) = (first, first);
    for point in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let size = sub(high, low);
    dot(size, size).sqrt()
}

// Boundary, seams and charts.

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
