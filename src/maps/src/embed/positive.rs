//! Exact tests for flips.

use unwrapd_method::numerics::predicates::orient2d_sign;

/// Returns whether every triangle is counter-clockwise and not empty, decided exactly.
pub fn is_positive(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> bool {
    first_bad_triangle(triangles, uv).is_none()
}

/// Returns the first triangle that is not exactly positive.
pub(super) fn first_bad_triangle(triangles: &[[u32; 3]], uv: &[[f64; 2]]) -> Option<usize> {
    triangles.iter().position(|t| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        orient2d_sign(a, b, c) <= 0
    })
}
