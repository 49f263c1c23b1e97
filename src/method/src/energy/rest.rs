//! Rest shapes of elements.

use crate::numerics::square::{Matrix, Square};
use crate::numerics::vec3;

/// Rest shape of a triangle (D = 2) or tetrahedron (D = 3) v₀…v_D, in the form that maps need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestShape<const D: usize = 2> {
    /// Inverse of the matrix with columns v₁ − v₀, …, v_D − v₀. Its rows are the gradients of the barycentric
    /// coordinates of v₁, …, v_D.
    pub inverse: Matrix<D>,
    /// Rest size: area or volume.
    pub size: f64,
    /// Factor of the density: the rest size, unless the caller changes it.
    pub weight: f64,
}

impl RestShape<2> {
    /// Creates the triangle with edges v₁ − v₀ and v₂ − v₀ in its own plane.
    ///
    /// The area must be positive; the caller decides how to treat a triangle of zero area.
    pub fn from_edges(first: [f64; 2], second: [f64; 2]) -> Self {
        Self::of([first, second], 0.5)
    }

    /// Lays a triangle of space into the plane: v₀ at the origin, v₁ on the positive first axis, v₂ above it.
    pub fn from_corners([a, b, c]: [[f64; 3]; 3]) -> Self {
        let (first, second) = (vec3::sub(b, a), vec3::sub(c, a));
        let length = vec3::norm(first);
        let along = vec3::dot(first, second) / length;
        let height = vec3::norm(vec3::cross(first, second)) / length;
        Self::from_edges([length, 0.0], [along, height])
    }
}

impl RestShape<3> {
    /// Creates the tetrahedron with these corners; its volume must be positive.
    pub fn from_tetrahedron([a, b, c, d]: [[f64; 3]; 4]) -> Self {
        Self::of([b, c, d].map(|corner| vec3::sub(corner, a)), 1.0 / 6.0)
    }
}

impl<const D: usize> RestShape<D> {
    /// Converts the shape to another unit of length.
    #[must_use]
    pub fn in_unit(&self, unit: f64) -> Self {
        let size = unit.powi(D as i32);
        Self {
            inverse: self.inverse.map(|row| row.map(|x| x * unit)),
            size: self.size / size,
            weight: self.weight / size,
        }
    }

    /// Creates the element with these edges from v₀, whose size is `share` of their determinant.
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
