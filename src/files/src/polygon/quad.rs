//! Quads split by the better of their two diagonals.

use super::plane::scaled;
use unwrapd_method::numerics::vec3::{cross, dot, norm, sub};

/// Least area of each of two triangles, as a share of the quad's area, for the fold alone to decide: thinner ones arise
/// if three corners are nearly collinear.
const THIN: f64 = 1e-6;
/// Least improvement in the cosine of the fold over the first diagonal: a tenth of a degree, above the rounding errors
/// of a flat quad.
const FLATTER: f64 = 1e-6;

/// The triangles on both sides of a diagonal.
struct Halves {
    /// The smaller triangle's share of the quad's area, seen along the quad's normal; negative if the diagonal is
    /// outside.
    least_share: f64,
    /// Cosine of the angle between the triangles' normals.
    flatness: f64,
}

/// Returns two triangles: split by the diagonal of the first corner, unless only the other lies inside, or it folds
/// less. `None` if neither lies inside.
pub(super) fn fill(corners: [[f64; 3]; 4]) -> Option<[[u32; 3]; 2]> {
    let [a, b, c, d] = scaled(&corners)?;
    let first = Halves::new(area(a, b, c), area(a, c, d));
    let second = Halves::new(area(a, b, d), area(b, c, d));
    let is_second = if first.least_share.min(second.least_share) > THIN {
        second.flatness > first.flatness + FLATTER
    } else {
        second.least_share > first.least_share
    };
    let chosen = if is_second { &second } else { &first };
    let triangles = if is_second {
        [[0, 1, 3], [1, 2, 3]]
    } else {
        [[0, 1, 2], [0, 2, 3]]
    };
    (chosen.least_share > 0.0).then_some(triangles)
}

impl Halves {
    fn new(one: [f64; 3], other: [f64; 3]) -> Self {
        let normal = [0, 1, 2].map(|axis| one[axis] + other[axis]);
        Self {
            least_share: dot(one, normal).min(dot(other, normal)) / dot(normal, normal),
            flatness: dot(one, other) / (norm(one) * norm(other)),
        }
    }
}

/// Returns twice the area of a triangle, as a vector along its normal.
fn area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    cross(sub(b, a), sub(c, a))
}
