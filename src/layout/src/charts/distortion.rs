//! What a map costs of the distortion budget.

use crate::charts::MappedChart;
use unwrapd_maps::embed::RestShapes;
use unwrapd_method::energy::{Density, RestShape, SymmetricDirichlet};
use unwrapd_method::numerics::square::{Square, times};
use unwrapd_method::numerics::vec2::{doubled_area, sub};

/// Beyond this a face cannot be called more distorted. One that is squeezed to nothing in floating point would outweigh all the
/// others, which a seam elsewhere does not change.
const LARGEST: f64 = 1e6;

/// Returns by how much the symmetric Dirichlet energy of a map exceeds its minimum of 4, times a factor of each face, summed over the
/// area; and that area.
pub fn weighted_excess(mapped: &MappedChart, rest: &RestShapes, factors: &[f64]) -> [f64; 2] {
    summed(mapped, rest, |face, sigma| factors[face] * excess(sigma))
}

/// Returns by how much the symmetric Dirichlet energy exceeds its minimum at these singular values.
fn excess(sigma: [f64; 2]) -> f64 {
    (SymmetricDirichlet.value(&sigma) - 4.0).clamp(0.0, LARGEST)
}

/// The area of the faces whose stretch, max(σ₁, 1/σ₂), is more than this.
pub fn stretched_area(mapped: &MappedChart, rest: &RestShapes, most: f64) -> f64 {
    summed(mapped, rest, |_, [first, second]| {
        let is_stretched = first > most || second * most < 1.0;
        f64::from(u8::from(is_stretched))
    })[0]
}

/// The sum over the area of a function of each face and its singular values σ₁ ≥ σ₂, and that area.
fn summed(
    mapped: &MappedChart,
    rest: &RestShapes,
    of: impl Fn(usize, [f64; 2]) -> f64,
) -> [f64; 2] {
    let triangles = &mapped.chart.disk.triangles;
    let (mut sum, mut weight) = (0.0, 0.0);
    for (face, (triangle, shape)) in triangles.iter().zip(&rest.shapes).enumerate() {
        let corners = triangle.map(|v| mapped.embedding.uv[v as usize].map(|x| x / rest.scale));
        sum += shape.weight * of(face, singular_values(corners, shape));
        weight += shape.weight;
    }
    let per_area = sum / weight.max(f64::MIN_POSITIVE);
    [per_area * rest.true_area, rest.true_area]
}

fn singular_values([a, b, c]: [[f64; 2]; 3], rest: &RestShape) -> [f64; 2] {
    let (first, second) = (sub(b, a), sub(c, a));
    let edges = [[first[0], second[0]], [first[1], second[1]]];
    let jacobian = times(&edges, &rest.inverse);
    let det = doubled_area(a, b, c) / (2.0 * rest.size);
    jacobian.singular_values(det)
}
