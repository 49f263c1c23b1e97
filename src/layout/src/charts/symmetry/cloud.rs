//! Points spread over a surface.

use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::vec3::{add_scaled, area_vector, norm, sub};

/// Points spread evenly over the area of a surface, at most so many; none where it has no area.
///
/// From: Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences (R₂).
pub fn points_over(surface: &Surface, n_points: usize) -> Vec<[f64; 3]> {
    let mut sum = 0.0;
    let mut until: Vec<f64> = Vec::with_capacity(surface.triangles.len());
    for triangle in 0..surface.triangles.len() {
        let [a, b, c] = surface.corners(triangle);
        sum += norm(area_vector(a, b, c));
        until.push(sum);
    }
    if sum <= 0.0 || !sum.is_finite() {
        return Vec::new();
    }
    let step = sum / n_points as f64;
    let mut triangle = 0;
    (0..n_points)
        .map(|i| {
            let place = (i as f64 + 0.5) * step;
            while until[triangle] < place && triangle + 1 < until.len() {
                triangle += 1;
            }
            let [a, b, c] = surface.corners(triangle);
            let [s, t] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2]
                .map(|irrational| (0.5 + irrational * i as f64).fract());
            let (s, t) = if s + t > 1.0 {
                (1.0 - s, 1.0 - t)
            } else {
                (s, t)
            };
            add_scaled(add_scaled(a, s, sub(b, a)), t, sub(c, a))
        })
        .collect()
}
