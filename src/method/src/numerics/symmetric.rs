//! Small symmetric matrices.

use super::square::{Matrix, identity};

/// Replaces the negative eigenvalues λ of a symmetric matrix by τλ: τ = 0 gives the nearest positive semidefinite
/// matrix, τ = 1 the matrix itself.
///
/// By cyclic Jacobi rotations; exact after one for 2×2.
pub fn relax_negative<const D: usize>(matrix: &Matrix<D>, tau: f64) -> Matrix<D> {
    if tau >= 1.0 || is_positive_definite(matrix) {
        return *matrix;
    }
    let (eigenvalues, vectors) = eigen(matrix);
    let mut relaxed = [[0.0; D]; D];
    for (lambda, q) in eigenvalues.into_iter().zip(vectors) {
        let lambda = lambda.max(tau * lambda);
        for r in 0..D {
            for c in 0..D {
                relaxed[r][c] += lambda * q[r] * q[c];
            }
        }
    }
    relaxed
}

/// Returns whether all pivots of an elimination are positive.
fn is_positive_definite<const D: usize>(matrix: &Matrix<D>) -> bool {
    let mut a = *matrix;
    for k in 0..D {
        if a[k][k] <= 0.0 || a[k][k].is_nan() {
            return false;
        }
        for i in k + 1..D {
            let factor = a[i][k] / a[k][k];
            for j in k + 1..D {
                a[i][j] -= factor * a[k][j];
            }
        }
    }
    true
}

/// Returns eigenvalues and, as rows, eigenvectors of length 1, unordered. By cyclic Jacobi rotations.
pub fn eigen<const D: usize>(matrix: &Matrix<D>) -> ([f64; D], Matrix<D>) {
    // Only a bound: convergence is quadratic, and sweeps end when no entry is left to annihilate.
    const MAX_SWEEPS: usize = 20;
    let mut a = *matrix;
    let mut vectors: Matrix<D> = identity(1.0);
    for _ in 0..MAX_SWEEPS {
        let mut turned = false;
        for i in 0..D {
            for j in i + 1..D {
                turned |= annihilate(&mut a, &mut vectors, i, j);
            }
        }
        if !turned {
            break;
        }
    }
    (std::array::from_fn(|k| a[k][k]), vectors)
}

/// Makes entry (i, j) zero by a rotation; returns `false` if it was negligible.
fn annihilate<const D: usize>(a: &mut Matrix<D>, q: &mut Matrix<D>, i: usize, j: usize) -> bool {
    let z = a[i][j];
    if z.abs() <= 1e-17 * (a[i][i].abs() + a[j][j].abs()) || !z.is_finite() {
        return false;
    }
    let zeta = (a[j][j] - a[i][i]) / (2.0 * z);
    let t = 1.0_f64.copysign(zeta) / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
    let cos = 1.0 / (1.0 + t * t).sqrt();
    let sin = cos * t;
    for row in a.iter_mut() {
        (row[i], row[j]) = (cos * row[i] - sin * row[j], sin * row[i] + cos * row[j]);
    }
    for m in [a, q] {
        let (p, r) = (m[i], m[j]);
        m[i] = std::array::from_fn(|k| cos * p[k] - sin * r[k]);
        m[j] = std::array::from_fn(|k| sin * p[k] + cos * r[k]);
    }
    true
}
