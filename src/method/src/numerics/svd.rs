//! Signed singular value decompositions, and that of 2×2 matrices; for 3×3 see [`jacobi`](super::jacobi).

use std::f64::consts::FRAC_1_SQRT_2;

/// A D×D matrix, rows first.
pub type Matrix<const D: usize> = [[f64; D]; D];

/// F = U diag(σ) Vᵀ with rotations U and V.
///
/// σ₁ ≥ σ₂ ≥ … in absolute value; all are nonnegative except the last, which has the sign of det F. The last is
/// computed from the determinant, so that it is exact to rounding however small it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Svd<const D: usize> {
    /// U, a rotation.
    pub u: Matrix<D>,
    /// The signed singular values.
    pub sigma: [f64; D],
    /// V, a rotation.
    pub v: Matrix<D>,
}

/// Returns the norms p = (σ₁ + σ₂)/√2 and m = (σ₁ − σ₂)/√2 of the rotating and the reflecting part of a 2×2 matrix, and
/// the parts.
#[inline]
fn parts([[a, b], [c, d]]: &Matrix<2>) -> ([f64; 2], [[f64; 2]; 2]) {
    let similar = [a + d, c - b].map(|f| FRAC_1_SQRT_2 * f);
    let reflected = [a - d, c + b].map(|f| FRAC_1_SQRT_2 * f);
    // Not `hypot`: maps have coordinates of ordinary size, and this is the innermost loop.
    let norm = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
    ([norm(similar), norm(reflected)], [similar, reflected])
}

#[inline]
fn from_parts([p, m]: [f64; 2], det: f64) -> [f64; 2] {
    let first = FRAC_1_SQRT_2 * (p + m);
    [first, if first > 0.0 { det / first } else { 0.0 }]
}

/// Returns the signed singular values of a matrix with this determinant.
#[inline]
pub fn singular_values2(f: &Matrix<2>, det: f64) -> [f64; 2] {
    from_parts(parts(f).0, det)
}

/// Decomposes a matrix with this determinant without computing angles: the rotating and reflecting parts turn by φ_u −
/// φ_v and φ_u + φ_v.
#[inline]
pub fn svd2(f: &Matrix<2>, det: f64) -> Svd<2> {
    let (norms, [similar, reflected]) = parts(f);
    let unit = |[x, y]: [f64; 2], norm: f64| {
        if norm > 0.0 {
            [x / norm, y / norm]
        } else {
            [1.0, 0.0]
        }
    };
    let (s, r) = (unit(similar, norms[0]), unit(reflected, norms[1]));
    let [cos, sin] = half_angle([s[0] * r[0] - s[1] * r[1], s[0] * r[1] + s[1] * r[0]]);
    let v = [cos * s[0] + sin * s[1], sin * s[0] - cos * s[1]];
    Svd {
        u: [[cos, -sin], [sin, cos]],
        sigma: from_parts(norms, det),
        v: [[v[0], -v[1]], [v[1], v[0]]],
    }
}

/// Returns cosine and sine of half the angle with this cosine and sine.
#[inline]
fn half_angle([cos, sin]: [f64; 2]) -> [f64; 2] {
    if cos >= 0.0 {
        let half = (0.5 * (1.0 + cos)).sqrt();
        [half, 0.5 * sin / half]
    } else {
        let half = (0.5 * (1.0 - cos)).sqrt();
        [0.5 * sin / half, half]
    }
}
