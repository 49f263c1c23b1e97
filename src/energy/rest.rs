//! What a triangle is without distortion.

use crate::numerics::vec2::cross;
use crate::numerics::vec3;

/// The rest shape of a triangle v₀v₁v₂, as the map needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestShape {
    /// The inverse of the matrix with columns v₁ − v₀ and v₂ − v₀ in the rest plane. Its rows are the gradients of the
    /// barycentric coordinates of v₁ and v₂.
    pub inverse: [[f64; 2]; 2],
    /// The rest area.
    pub area: f64,
    /// The density's factor: the rest area, unless the caller has a reason.
    pub weight: f64,
}

impl RestShape {
    /// The triangle with edges `first` = v₁ − v₀ and `second` = v₂ − v₀ in its own plane.
    ///
    /// The area must be positive; what to do with a triangle of no area is the caller's to decide.
    pub fn from_edges(first: [f64; 2], second: [f64; 2]) -> Self {
        let det = cross(first, second);
        Self {
            inverse: [
                [second[1] / det, -second[0] / det],
                [-first[1] / det, first[0] / det],
            ],
            area: 0.5 * det,
            weight: 0.5 * det,
        }
    }

    /// A triangle of space laid into the plane: v₀ at the origin, v₁ on the positive first axis, v₂ above it.
    pub fn from_corners([a, b, c]: [[f64; 3]; 3]) -> Self {
        let (first, second) = (vec3::sub(b, a), vec3::sub(c, a));
        let length = vec3::norm(first);
        let along = vec3::dot(first, second) / length;
        let height = vec3::norm(vec3::cross(first, second)) / length;
        Self::from_edges([length, 0.0], [along, height])
    }
}
