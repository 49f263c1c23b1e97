//! Signed singular value decompositions of 2×2 and 3×3 matrices.

use std::f64::consts::FRAC_1_SQRT_2;

use super::vec3;

/// A D×D matrix, rows first.
pub type Matrix<const D: usize> = [[f64; D]; D];

/// F = U diag(σ) Vᵀ with rotations U and V.
///
/// σ₁ ≥ σ₂ ≥ … in absolute value; all are nonnegative but the last, which has the sign of det F. The last is found from
/// the determinant, so that it is exact to rounding however small it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Svd<const D: usize> {
    /// U, a rotation.
    pub u: Matrix<D>,
    /// The signed singular values.
    pub sigma: [f64; D],
    /// V, a rotation.
    pub v: Matrix<D>,
}

/// The norms p = (σ₁ + σ₂)/√2 and m = (σ₁ − σ₂)/√2 of the parts of a 2×2 matrix that rotate and that reflect, and the parts.
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

/// The signed singular values of a matrix with this determinant.
#[inline]
pub fn singular_values2(f: &Matrix<2>, det: f64) -> [f64; 2] {
    from_parts(parts(f).0, det)
}

/// The decomposition of a matrix with this determinant, without an angle: the parts that rotate and reflect turn by φ_u − φ_v
/// and φ_u + φ_v.
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

/// Cosine and sine of half the angle with this cosine and sine.
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

/// Sweeps of rotations at most; four are usual.
const MAX_SWEEPS: usize = 30;

/// The decomposition of a matrix with this determinant by one-sided Jacobi rotations (Hestenes), which find small singular
/// values as exactly as large ones.
pub fn svd3(f: &Matrix<3>, det: f64) -> Svd<3> {
    // Columns of F V and of V.
    let mut a = [0, 1, 2].map(|c| [f[0][c], f[1][c], f[2][c]]);
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..MAX_SWEEPS {
        let mut turned = false;
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            turned |= orthogonalize(&mut a, &mut v, i, j);
        }
        if !turned {
            break;
        }
    }
    sort_columns(&mut a, &mut v);
    let first = vec3::norm(a[0]);
    let u0 = direction(a[0], [1.0, 0.0, 0.0]);
    let u1 = direction(orthogonal_part(a[1], u0), vec3::perpendicular(u0));
    let u2 = vec3::cross(u0, u1);
    let second = vec3::norm(a[1]);
    let product = first * second;
    let third = if product > 0.0 { det / product } else { 0.0 };
    let columns = |m: [[f64; 3]; 3]| [0, 1, 2].map(|r| [m[0][r], m[1][r], m[2][r]]);
    Svd {
        u: columns([u0, u1, u2]),
        sigma: [first, second, third],
        v: columns(v),
    }
}

/// Turns columns i and j so that they are orthogonal; false if they were.
fn orthogonalize(a: &mut [[f64; 3]; 3], v: &mut [[f64; 3]; 3], i: usize, j: usize) -> bool {
    let (x, y) = (vec3::dot(a[i], a[i]), vec3::dot(a[j], a[j]));
    let z = vec3::dot(a[i], a[j]);
    if z * z <= 1e-32 * x * y || z == 0.0 {
        return false;
    }
    let zeta = (y - x) / (2.0 * z);
    let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
    let cos = 1.0 / (1.0 + t * t).sqrt();
    let sin = cos * t;
    for m in [a, v] {
        let (p, q) = (m[i], m[j]);
        m[i] = [0, 1, 2].map(|k| cos * p[k] - sin * q[k]);
        m[j] = [0, 1, 2].map(|k| sin * p[k] + cos * q[k]);
    }
    true
}

/// Longest columns first; V stays a rotation.
fn sort_columns(a: &mut [[f64; 3]; 3], v: &mut [[f64; 3]; 3]) {
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        if vec3::dot(a[i], a[i]) < vec3::dot(a[j], a[j]) {
            for m in [&mut *a, &mut *v] {
                m.swap(i, j);
                m[j] = m[j].map(|x| -x);
            }
        }
    }
}

fn orthogonal_part(a: [f64; 3], unit: [f64; 3]) -> [f64; 3] {
    vec3::add_scaled(a, -vec3::dot(a, unit), unit)
}

fn direction(a: [f64; 3], otherwise: [f64; 3]) -> [f64; 3] {
    let length = vec3::norm(a);
    if length > 0.0 {
        a.map(|x| x / length)
    } else {
        otherwise
    }
}
