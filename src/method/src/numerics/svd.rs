//! Signed singular value decompositions, of 2×2 matrices in closed form and of 3×3 by Jacobi rotations.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined is compiled for the vectors of the processor"
)]

use super::vec3;
use pulp::{Arch, Simd, WithSimd};
use std::array;
use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::{Add, Div, Mul, Neg, Sub};

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

// Singular values of 3×3 matrices by one-sided Jacobi rotations (Hestenes), which find small ones as exactly as large
// ones.

/// Most sweeps of rotations; four are usual.
const MAX_SWEEPS: usize = 30;

/// Three columns in each lane.
type Columns<const N: usize> = [Vector<N>; 3];

/// Decomposes a matrix with this determinant.
pub fn svd3(f: &Matrix<3>, det: f64) -> Svd<3> {
    let [svd] = svds3(&[*f], &[det]);
    svd
}

/// Decomposes matrices with these determinants.
pub fn svds3<const N: usize>(f: &[Matrix<3>; N], det: &[f64; N]) -> [Svd<3>; N] {
    Arch::new().dispatch(Decompose { f, det })
}

/// Returns the signed singular values of matrices with these determinants.
pub fn singular_values3<const N: usize>(f: &[Matrix<3>; N], det: &[f64; N]) -> [[f64; 3]; N] {
    Arch::new().dispatch(Measure { f, det })
}

/// Computes the whole decompositions.
struct Decompose<'a, const N: usize> {
    f: &'a [Matrix<3>; N],
    det: &'a [f64; N],
}

impl<const N: usize> WithSimd for Decompose<'_, N> {
    type Output = [Svd<3>; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let mut turned = [columns_of(self.f), identity()];
        diagonalize(&mut turned);
        let [a, v] = turned;
        let (u, sigma) = (axes(&a), signed(&a, self.det));
        array::from_fn(|l| Svd {
            u: matrix(&u, l),
            sigma: sigma.map(|s| s.0[l]),
            v: matrix(&v, l),
        })
    }
}

/// Computes only the singular values.
struct Measure<'a, const N: usize> {
    f: &'a [Matrix<3>; N],
    det: &'a [f64; N],
}

impl<const N: usize> WithSimd for Measure<'_, N> {
    type Output = [[f64; 3]; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let mut turned = [columns_of(self.f)];
        diagonalize(&mut turned);
        let sigma = signed(&turned[0], self.det);
        array::from_fn(|l| sigma.map(|s| s.0[l]))
    }
}

#[inline(always)]
fn columns_of<const N: usize>(f: &[Matrix<3>; N]) -> Columns<N> {
    array::from_fn(|c| array::from_fn(|r| Lanes(array::from_fn(|l| f[l][r][c]))))
}

#[inline(always)]
fn identity<const N: usize>() -> Columns<N> {
    array::from_fn(|c| array::from_fn(|r| Lanes::all(f64::from(u8::from(r == c)))))
}

/// Returns the matrix of a lane, rows first.
#[inline(always)]
fn matrix<const N: usize>(columns: &Columns<N>, lane: usize) -> Matrix<3> {
    array::from_fn(|r| array::from_fn(|c| columns[c][r].0[lane]))
}

/// Rotates the columns of the first matrix until they are orthogonal, sorts them by decreasing length, and applies the
/// same to the others.
#[inline(always)]
fn diagonalize<const N: usize, const M: usize>(turned: &mut [Columns<N>; M]) {
    const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];
    for _ in 0..MAX_SWEEPS {
        let mut is_done = true;
        for (i, j) in PAIRS {
            is_done &= !orthogonalize(turned, i, j);
        }
        if is_done {
            break;
        }
    }
    for (i, j) in PAIRS {
        let [p, q] = [turned[0][i], turned[0][j]];
        let swaps = dot(p, p).less(dot(q, q));
        for columns in &mut *turned {
            let (p, q) = (columns[i], columns[j]);
            for k in 0..3 {
                columns[i][k] = Lanes::select(swaps, q[k], p[k]);
                columns[j][k] = Lanes::select(swaps, -p[k], q[k]);
            }
        }
    }
}

/// Rotates columns i and j of the first so that they are orthogonal; returns `false` if they already were in every
/// lane.
#[inline(always)]
fn orthogonalize<const N: usize, const M: usize>(
    turned: &mut [Columns<N>; M],
    i: usize,
    j: usize,
) -> bool {
    let (p, q) = (turned[0][i], turned[0][j]);
    let (x, y, z) = (dot(p, p), dot(q, q), dot(p, q));
    let turns = (Lanes::all(1e-32) * x * y).less(z * z);
    if turns == [false; N] {
        return false;
    }
    let one = Lanes::all(1.0);
    let zeta = (y - x) / (Lanes::all(2.0) * z);
    let t = zeta.signum() / (zeta.abs() + (one + zeta * zeta).sqrt());
    let cos = one / (one + t * t).sqrt();
    let sin = Lanes::select(turns, cos * t, Lanes::all(0.0));
    let cos = Lanes::select(turns, cos, one);
    for columns in turned {
        let (p, q) = (columns[i], columns[j]);
        for k in 0..3 {
            columns[i][k] = cos * p[k] - sin * q[k];
            columns[j][k] = sin * p[k] + cos * q[k];
        }
    }
    true
}

/// Returns the directions of orthogonal columns, completed to a rotation where columns are zero.
#[inline(always)]
fn axes<const N: usize>(a: &Columns<N>) -> Columns<N> {
    let first = direction(a[0], |_| [1.0, 0.0, 0.0]);
    let along = -dot(a[1], first);
    let rest = array::from_fn(|k| a[1][k] + along * first[k]);
    let second = direction(rest, |l| vec3::perpendicular(first.map(|x| x.0[l])));
    [first, second, cross(first, second)]
}

/// Returns the lengths of orthogonal columns; the last is computed from the determinant.
#[inline(always)]
fn signed<const N: usize>(a: &Columns<N>, det: &[f64; N]) -> [Lanes<N>; 3] {
    let [first, second] = [a[0], a[1]].map(|column| dot(column, column).sqrt());
    let product = first * second;
    let is_positive = Lanes::all(0.0).less(product);
    let third = Lanes::select(is_positive, Lanes(*det) / product, Lanes::all(0.0));
    [first, second, third]
}

/// Returns unit vectors along `a`; in a lane where it is zero, `otherwise`.
#[inline(always)]
fn direction<const N: usize>(a: Vector<N>, otherwise: impl Fn(usize) -> [f64; 3]) -> Vector<N> {
    let length = dot(a, a).sqrt();
    let mut unit = a.map(|x| x / length);
    let has_direction = Lanes::all(0.0).less(length);
    if has_direction != [true; N] {
        for lane in (0..N).filter(|&l| !has_direction[l]) {
            for (component, x) in unit.iter_mut().zip(otherwise(lane)) {
                component.0[lane] = x;
            }
        }
    }
    unit
}

// Numbers of several matrices, one per lane, processed at once.

/// `N` numbers. Each lane computes bit for bit what `f64` computes, on every processor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const N: usize>(pub [f64; N]);

/// A vector of space in each lane.
pub type Vector<const N: usize> = [Lanes<N>; 3];

impl<const N: usize> Lanes<N> {
    /// Sets all lanes to `x`.
    #[inline(always)]
    pub fn all(x: f64) -> Self {
        Self([x; N])
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(array::from_fn(|l| f(self.0[l])))
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(array::from_fn(|l| f(self.0[l], other.0[l])))
    }

    /// Returns √x.
    #[must_use]
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// Returns |x|.
    #[must_use]
    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// Returns 1 with the sign of x.
    #[must_use]
    #[inline(always)]
    pub fn signum(self) -> Self {
        self.map(|x| 1.0_f64.copysign(x))
    }

    /// Returns the lanes in which x < y.
    #[inline(always)]
    pub fn less(self, y: Self) -> [bool; N] {
        array::from_fn(|l| self.0[l] < y.0[l])
    }

    /// Returns `chosen` in lanes where `mask` is set, `otherwise` in the others.
    #[inline(always)]
    pub fn select(mask: [bool; N], chosen: Self, otherwise: Self) -> Self {
        Self(array::from_fn(|l| {
            if mask[l] { chosen.0[l] } else { otherwise.0[l] }
        }))
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |x, y| x + y)
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |x, y| x - y)
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |x, y| x * y)
    }
}

impl<const N: usize> Div for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |x, y| x / y)
    }
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

/// Returns a·b.
#[inline(always)]
pub fn dot<const N: usize>(a: Vector<N>, b: Vector<N>) -> Lanes<N> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns a × b.
#[inline(always)]
pub fn cross<const N: usize>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
