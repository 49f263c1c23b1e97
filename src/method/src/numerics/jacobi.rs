//! Singular values of 3×3 matrices by one-sided Jacobi rotations (Hestenes), which find small ones as exactly as large
//! ones.
//!
//! Rotations wait for roots and quotients, so several matrices are processed at once, one per lane. Every lane gets
//! exactly the bits that it would get alone.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined is compiled for the vectors of the processor"
)]

use std::array;

use pulp::{Arch, Simd, WithSimd};

use super::lanes::{Lanes, Vector, cross, dot};
use super::svd::{Matrix, Svd};
use super::vec3;

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
