//! Charts turned so that up in space is up in the plane.

use super::MappedChart;
use unwrapd_maps::embed::is_positive;
use unwrapd_method::numerics::vec2::doubled_area;

/// The height whose direction charts agree in: up, and for those that lie flat away from the viewer, as on a map.
const UP: [f64; 3] = [0.0, 1.0, -0.05];
/// A chart on which the mean slope of the height is less has no direction: it goes around the surface.
const LEAST_SLOPE: f64 = 1e-3;

impl MappedChart {
    /// Turns the map so that the height rises upward on average; a chart without such a direction stays, and so does one with
    /// a triangle so thin that rounding the turned map would flip it.
    pub fn turn_up(&mut self) {
        let height = |v: u32| {
            let p = self.chart.positions[v as usize];
            (0..3).map(|k| UP[k] * p[k]).sum::<f64>()
        };
        let (mut slope, mut area) = ([0.0; 2], 0.0);
        for t in &*self.chart.disk.triangles {
            let [a, b, c] = t.map(|v| self.embedding.uv[v as usize]);
            let [h, i, j] = t.map(height);
            // Twice the area times the gradient.
            slope[0] += h * (b[1] - c[1]) + i * (c[1] - a[1]) + j * (a[1] - b[1]);
            slope[1] += h * (c[0] - b[0]) + i * (a[0] - c[0]) + j * (b[0] - a[0]);
            area += doubled_area(a, b, c).abs();
        }
        let length = slope[0].hypot(slope[1]);
        if length.is_normal() && length > LEAST_SLOPE * area {
            let [s, c] = slope.map(|x| x / length);
            let turned = |p: &[f64; 2]| [c * p[0] - s * p[1], s * p[0] + c * p[1]];
            let turned: Vec<[f64; 2]> = self.embedding.uv.iter().map(turned).collect();
            let triangles = &self.chart.disk.triangles;
            if is_positive(triangles, &turned) || !is_positive(triangles, &self.embedding.uv) {
                self.embedding.uv = turned;
            }
        }
    }
}
