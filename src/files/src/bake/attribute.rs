//! Textures of attributes of the corners of faces.

use rayon::prelude::*;

use super::coverage::Coverage;
use super::fill::filled;
use super::triangle::Triangle;

/// Bakes a number of the corners of each face, such as an attribute of their vertices, for every texel, row by row:
/// interpolated at the texel's center in its face, at the nearest point if the center lies beside the face, and filled
/// from the neighbors between charts.
pub fn baked_attribute(coverage: &Coverage, corners: &[[f32; 3]]) -> Vec<f32> {
    let side = coverage.side();
    let texel = |x: usize, y: usize| {
        let face = coverage.at(x, y)?;
        let triangle = Triangle::new(*coverage.corners(face))?;
        let (weights, _) = triangle.nearest([x as f64 + 0.5, y as f64 + 0.5]);
        let values = corners[face as usize];
        let value: f64 = (weights.iter().zip(values))
            .map(|(weight, value)| weight * f64::from(value))
            .sum();
        Some(value as f32)
    };
    let mut texels = vec![None; side * side];
    (texels.par_chunks_mut(side).enumerate()).for_each(|(y, row)| {
        for (x, value) in row.iter_mut().enumerate() {
            *value = texel(x, y);
        }
    });
    filled(texels, side, 0.0)
}
