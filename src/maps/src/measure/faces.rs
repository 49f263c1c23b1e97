//! Measures of each face and chart that all figures need.

use crate::certificate::UvTopology;

/// Largest height of a needle over its longest side: such a face looks like an edge. Rounding moves its vertices by
/// more than its height on a texture of 8192 texels.
const NEEDLE: f64 = 1e-4;

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
