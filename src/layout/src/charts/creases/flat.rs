//! Facets as they lie in their planes.

use crate::charts::chart::Chart;
use crate::charts::unfold::overlaps::overlaps;
use unwrapd_maps::embed;
use unwrapd_method::numerics::vec3::{area_vector, cross, dot, perpendicular, unit};

/// Where the vertices of a facet with this normal lie when it is seen straight on; none if a face is
/// flipped or empty so, or covers another.
///
/// What lies beside the plane by the tolerance of a facet loses nothing that can be seen.
pub fn seen_straight_on(chart: &Chart, normal: [f64; 3]) -> Option<Vec<[f64; 2]>> {
    let mut sum = [0.0; 3];
    for triangle in &chart.disk.triangles {
        let [a, b, c] = triangle.map(|v| chart.positions[v as usize]);
        let area = area_vector(a, b, c);
        sum = [0, 1, 2].map(|k| sum[k] + area[k]);
    }
    let normal = if dot(sum, normal) < 0.0 {
        normal.map(|x| -x)
    } else {
        normal
    };
    let u = unit(perpendicular(normal));
    let v = cross(normal, u);
    let uv: Vec<[f64; 2]> = (chart.positions.iter())
        .map(|&p| [dot(p, u), dot(p, v)])
        .collect();
    let is_valid =
        embed::is_positive(&chart.disk.triangles, &uv) && overlaps(&chart.disk, &uv).is_empty();
    is_valid.then_some(uv)
}
