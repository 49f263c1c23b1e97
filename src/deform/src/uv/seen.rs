//! What someone sees of UVs in the hand: vertices, faces, and what the map is worth.

use super::session::{LiveChart, UvSession};

impl UvSession {
    /// The vertices of the UV map that each face has: corners that lie on each other in space, in UV space and in their chart.
    pub fn faces(&self) -> &[[u32; 3]] {
        self.vertices.of_corner.as_chunks().0
    }

    /// Where the vertices of the UV map are. Of faces without finite UVs they are at the origin.
    pub fn vertex_uvs(&self) -> Vec<[f64; 2]> {
        let n_vertices = self.vertices.first_corner.len() as u32;
        let start = (0..n_vertices).map(|vertex| self.vertices.uv(&self.map, vertex));
        let mut uvs: Vec<[f64; 2]> = start.collect();
        for (vertex, uv) in self.moved() {
            uvs[vertex as usize] = uv;
        }
        uvs
    }

    /// Of each face the sign that its area keeps, whatever is pulled; 0 in charts that no anchor has had hold of.
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

    /// The energy of the charts that anchors hold or held, barriers and the pull of points included; not a number where no
    /// iteration has looked at a map yet.
    pub fn energy(&self) -> f64 {
        let charts = self.charts.values();
        charts.map(|chart| chart.live.summary().energy_last).sum()
    }

    /// The smallest area of a triangle of those charts over its area at rest.
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
