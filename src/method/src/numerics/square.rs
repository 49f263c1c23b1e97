//! Square matrices of plane and space: the differences between 2×2 and 3×3.
//!
//! Everything else about elements is written once for both dimensions.

pub use super::svd::Matrix;
use super::svd::{Svd, singular_values2, singular_values3, svd2, svds3};
use super::vec3;
use std::array;

/// Operations on matrices that energies need, in either dimension.
pub trait Square<const D: usize>: Copy {
    /// Returns the determinant.
    fn det(&self) -> f64;

    /// Returns the coefficients of det(self + t·`direction`) in powers of t.
    fn det_along(&self, direction: &Self) -> [f64; 4];

    /// Returns the inverse, given the determinant.
    fn inverse(&self, det: f64) -> Matrix<D>;

    /// Returns the signed singular value decompositions of matrices, given their determinants.
    fn svds<const N: usize>(matrices: &[Self; N], dets: &[f64; N]) -> [Svd<D>; N];

    /// Returns only the signed singular values of matrices, given their determinants; see [`Svd`].
    fn all_singular_values<const N: usize>(matrices: &[Self; N], dets: &[f64; N]) -> [[f64; D]; N];

    /// Returns the signed singular value decomposition, given the determinant.
    fn svd(&self, det: f64) -> Svd<D> {
        let [svd] = Self::svds(&[*self], &[det]);
        svd
    }

    /// Returns only the signed singular values, given the determinant; see [`Svd`].
    fn singular_values(&self, det: f64) -> [f64; D] {
        let [values] = Self::all_singular_values(&[*self], &[det]);
        values
    }
}

impl Square<2> for Matrix<2> {
    fn det(&self) -> f64 {
        let [[a, b], [c, d]] = self;
        a * d - b * c
    }

    fn det_along(&self, direction: &Self) -> [f64; 4] {
        let ([[a, b], [c, d]], [[p, q], [r, s]]) = (self, direction);
        [
            self.det(),
            a * s - b * r + p * d - q * c,
            direction.det(),
            0.0,
        ]
    }

    fn inverse(&self, det: f64) -> Self {
        let [[a, b], [c, d]] = self;
        [[d / det, -b / det], [-c / det, a / det]]
    }

    fn svds<const N: usize>(matrices: &[Self; N], dets: &[f64; N]) -> [Svd<2>; N] {
        array::from_fn(|l| svd2(&matrices[l], dets[l]))
    }

    fn all_singular_values<const N: usize>(matrices: &[Self; N], dets: &[f64; N]) -> [[f64; 2]; N] {
        array::from_fn(|l| singular_values2(&matrices[l], dets[l]))
    }
}

impl Square<3> for Matrix<3> {
    fn det(&self) -> f64 {
        let [a, b, c] = *self;
        vec3::dot(a, vec3::cross(b, c))
    }

    fn det_along(&self, direction: &Self) -> [f64; 4] {
        let ([a, b, c], [p, q, r]) = (*self, *direction);
        let det = |a, b, c| vec3::dot(a, vec3::cross(b, c));
        [
            det(a, b, c),
            det(p, b, c) + det(a, q, c) + det(a, b, r),
            det(a, q, r) + det(p, b, r) + det(p, q, c),
            det(p, q, r),
        ]
    }

    fn inverse(&self, det: f64) -> Self {
        let [a, b, c] = *self;
        let columns = [vec3::cross(b, c), vec3::cross(c, a), vec3::cross(a, b)];
        [0, 1, 2].map(|r| [0, 1, 2].map(|k| columns[k][r] / det))
    }

    fn svds<const N: usize>(matrices: &[Self; N], dets: &[f64; N]) -> [Svd<3>; N] {
        svds3(matrices, dets)
    }

    fn all_singular_values<const N: usize>(matrices: &[Self; N], dets: &[f64; N]) -> [[f64; 3]; N] {
        singular_values3(matrices, dets)
    }
}

/// Returns `value` times the identity.
pub fn identity<const D: usize>(value: f64) -> Matrix<D> {
    array::from_fn(|r| array::from_fn(|c| if r == c { value } else { 0.0 }))
}

/// Returns a · b.
pub fn times<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    let mut product = [[0.0; D]; D];
    for (row, a) in product.iter_mut().zip(a) {
        for (k, b) in b.iter().enumerate() {
            for c in 0..D {
                row[c] += a[k] * b[c];
            }
        }
    }
    product
}

/// Returns aᵀ.
pub fn transposed<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    array::from_fn(|r| array::from_fn(|c| a[c][r]))
}

/// Returns a · x.
pub fn apply<const D: usize>(a: &Matrix<D>, x: &[f64; D]) -> [f64; D] {
    a.map(|row| (0..D).map(|c| row[c] * x[c]).sum())
}

/// Returns aᵀ · x.
pub fn apply_transposed<const D: usize>(a: &Matrix<D>, x: &[f64; D]) -> [f64; D] {
    let mut image = [0.0; D];
    for (row, x) in a.iter().zip(x) {
        for c in 0..D {
            image[c] += row[c] * x;
        }
    }
    image
}
