//! Views of a UV session: vertices, faces and measures of the map.

use super::session::{LiveChart, UvSession};

impl UvSession {
    /// Returns the vertices of the UV map for each face: classes of corners that coincide in space, in UV space and in
    /// their chart.
    pub fn faces(&self) -> &[[u32; 3]] {
        self.vertices.of_corner.as_chunks().0
    }

    /// Returns the UVs of the vertices. Those of faces without finite UVs are at the origin.
    pub fn vertex_uvs(&self) -> Vec<[f64; 2]> {
        let n_vertices = self.vertices.first_corner.len() as u32;
        let start = (0..n_vertices).map(|vertex| self.vertices.uv(&self.map, vertex));
        let mut uvs: Vec<[f64; 2]> = start.collect();
        for (vertex, uv) in self.moved() {
            uvs[vertex as usize] = uv;
        }
        uvs
    }

    /// Returns for each face the sign that its area keeps, whatever is pulled; 0 in charts that no anchor has held.
    pub fn kept_signs(&self) -> Vec<i8> {
        let mut signs = vec![0; self.map.faces.len()];
        for (&number, chart) in &self.charts {
            for [corner, ..] in chart.chart.faces.corners() {
                let face = corner as usize / 3;
                signs[face] = self.positive[number as usize] * self.map.winding[face];
            }
        }
        signs
    }

    /// Returns the energy of the charts that anchors hold or held, including barriers and the pull of points; NaN
    /// before the first iteration of a map.
    pub fn energy(&self) -> f64 {
        let charts = self.charts.values();
        charts.map(|chart| chart.live.summary().energy_last).sum()
    }

    /// Returns the smallest ratio of a triangle's area to its rest area in those charts.
    pub fn smallest(&self) -> f64 {
        let of_chart = |chart: &LiveChart| {
            let body = &chart.live.problem().body;
            let (now, rest) = (body.determinants_at(chart.live.x()), body.determinants());
            let ratios = now.iter().zip(rest).map(|(now, rest)| now / rest);
            ratios.fold(f64::INFINITY, f64::min)
        };
        self.charts
            .values()
            .map(of_chart)
            .fold(f64::INFINITY, f64::min)
    }
}
