//! Numbers of several matrices, one per lane, processed at once.

#![expect(
    clippy::inline_always,
    reason = "only what is inlined is compiled for the vectors of the processor"
)]

use std::array;
use std::ops::{Add, Div, Mul, Neg, Sub};

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
