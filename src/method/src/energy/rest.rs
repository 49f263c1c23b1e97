//! What an element is without distortion.

use crate::numerics::square::{Matrix, Square};
use crate::numerics::vec3;

/// The rest shape of a triangle (D = 2) or tetrahedron (D = 3) v₀…v_D, as the map needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestShape<const D: usize = 2> {
    /// The inverse of the matrix with columns v₁ − v₀, …, v_D − v₀. Its rows are the gradients of the barycentric
    /// coordinates of v₁, …, v_D.
    pub inverse: Matrix<D>,
    /// The rest size: area or volume.
    pub size: f64,
    /// The density's factor: the rest size, unless the caller has a reason.
    pub weight: f64,
}

impl RestShape<2> {
    /// The triangle with edges v₁ − v₀ and v₂ − v₀ in its own plane.
    ///
    /// The area must be positive; what to do with a triangle of no area is the caller's to decide.
    pub fn from_edges(first: [f64; 2], second: [f64; 2]) -> Self {
        Self::of([first, second], 0.5)
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

impl RestShape<3> {
    /// The tetrahedron with these corners; its volume must be positive.
    pub fn from_tetrahedron([a, b, c, d]: [[f64; 3]; 4]) -> Self {
        Self::of([b, c, d].map(|corner| vec3::sub(corner, a)), 1.0 / 6.0)
    }
}

impl<const D: usize> RestShape<D> {
    /// The same shape where lengths are measured in this unit.
    #[must_use]
    pub fn in_unit(&self, unit: f64) -> Self {
        let size = unit.powi(D as i32);
        Self {
            inverse: self.inverse.map(|row| row.map(|x| x * unit)),
            size: self.size / size,
            weight: self.weight / size,
        }
    }

    /// The element with these edges from v₀, whose size is `share` of their determinant.
    fn of(edges: Matrix<D>, share: f64) -> Self
    where
        Matrix<D>: Square<D>,
    {
        let det = edges.det();
        let inverse = crate::numerics::square::transposed(&edges.inverse(det));
        Self {
            inverse,
            size: share * det,
            weight: share * det,
        }
    }
}
