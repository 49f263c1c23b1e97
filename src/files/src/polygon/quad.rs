//! Quads by the better of their two diagonals.

use super::plane::scaled;
use unwrapd_method::numerics::vec3::{cross, dot, norm, sub};

/// Of the quad's area, what each of two triangles has to have for the fold alone to decide: thinner ones are made where
/// three corners are nearly on a line.
const THIN: f64 = 1e-6;
/// By how much the cosine of the fold has to be better than that of the first diagonal: a tenth of a degree, above what rounding
/// makes of a flat quad.
const FLATTER: f64 = 1e-6;

/// What is on both sides of a diagonal.
struct Halves {
    /// The smaller triangle's share of the quad's area, seen along the quad's normal; negative where the diagonal is outside.
    least_share: f64,
    /// The cosine of the angle between the triangles' normals.
    flatness: f64,
}

/// Two triangles: by the diagonal of the first corner, unless the other lies inside where it does not, or folds less. `None`
/// where neither lies inside.
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

/// Twice the area of a triangle, as a vector along its normal.
fn area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    cross(sub(b, a), sub(c, a))
}
