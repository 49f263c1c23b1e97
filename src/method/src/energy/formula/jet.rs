//! Second-order forward automatic differentiation.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::numerics::square::Matrix;

/// Largest integer exponent that is computed by multiplication.
const WHOLE: f64 = 1024.0;

/// A number that depends on D variables, with its gradient and its Hessian.
///
/// Sums, products and functions of jets carry both along by the chain rule, exact to rounding. Outside the domain of a
/// function they are not finite, like [`f64`] there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<const D: usize> {
    /// Value.
    pub value: f64,
    /// First derivatives.
    pub gradient: [f64; D],
    /// Second derivatives.
    pub hessian: Matrix<D>,
}

impl<const D: usize> Jet<D> {
    /// Creates a constant, whose derivatives are zero.
    pub fn constant(value: f64) -> Self {
        Self {
            value,
            gradient: [0.0; D],
            hessian: [[0.0; D]; D],
        }
    }

    /// Creates the variables themselves.
    pub fn variables(values: &[f64; D]) -> [Self; D] {
        std::array::from_fn(|i| {
            let mut variable = Self::constant(values[i]);
            variable.gradient[i] = 1.0;
            variable
        })
    }

    /// Returns √x.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root, -0.25 / (root * self.value))
    }

    /// Returns eˣ.
    #[must_use]
    pub fn exp(self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp, exp)
    }

    /// Returns the natural logarithm.
    #[must_use]
    pub fn ln(self) -> Self {
        let inverse = 1.0 / self.value;
        self.chain(self.value.ln(), inverse, -inverse * inverse)
    }

    /// Returns the hyperbolic cosine.
    #[must_use]
    pub fn cosh(self) -> Self {
        let (sinh, cosh) = (self.value.sinh(), self.value.cosh());
        self.chain(cosh, sinh, cosh)
    }

    /// Returns xᵖ; for negative x only finite if p is an integer.
    #[must_use]
    pub fn powf(self, p: f64) -> Self {
        let power = |factor: f64, p: f64| {
            if factor == 0.0 {
                0.0
            } else if p.fract() == 0.0 && p.abs() <= WHOLE {
                factor * self.value.powi(p as i32)
            } else {
                factor * self.value.powf(p)
            }
        };
        let second = p * (p - 1.0);
        self.chain(power(1.0, p), power(p, p - 1.0), power(second, p - 2.0))
    }

    /// Returns xʸ = exp(y ln x).
    #[must_use]
    pub fn pow(self, y: Self) -> Self {
        (self.ln() * y).exp()
    }

    /// Returns f(x), given f, f′ and f″ at x.
    fn chain(self, f: f64, first: f64, second: f64) -> Self {
        let g = self.gradient;
        Self {
            value: f,
            gradient: g.map(|g| first * g),
            hessian: matrix(|i, j| first * self.hessian[i][j] + second * g[i] * g[j]),
        }
    }
}

fn matrix<const D: usize>(entry: impl Fn(usize, usize) -> f64) -> Matrix<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

impl<const D: usize> Add for Jet<D> {
    type Output = Self;

    fn add(self, y: Self) -> Self {
        Self {
            value: self.value + y.value,
            gradient: std::array::from_fn(|i| self.gradient[i] + y.gradient[i]),
            hessian: matrix(|i, j| self.hessian[i][j] + y.hessian[i][j]),
        }
    }
}

impl<const D: usize> Neg for Jet<D> {
    type Output = Self;

    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const D: usize> Sub for Jet<D> {
    type Output = Self;

    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

#[expect(
    clippy::suspicious_arithmetic_impl,
    reason = "the product rule has sums"
)]
impl<const D: usize> Mul for Jet<D> {
    type Output = Self;

    fn mul(self, y: Self) -> Self {
        let (g, h) = (self.gradient, y.gradient);
        Self {
            value: self.value * y.value,
            gradient: std::array::from_fn(|i| self.value * h[i] + y.value * g[i]),
            hessian: matrix(|i, j| {
                let curved = self.value * y.hessian[i][j] + y.value * self.hessian[i][j];
                curved + g[i] * h[j] + g[j] * h[i]
            }),
        }
    }
}

impl<const D: usize> Div for Jet<D> {
    type Output = Self;

    fn div(self, y: Self) -> Self {
        self * y.powf(-1.0)
    }
}

impl<const D: usize> Add<f64> for Jet<D> {
    type Output = Self;

    fn add(self, y: f64) -> Self {
        Self {
            value: self.value + y,
            ..self
        }
    }
}

impl<const D: usize> Sub<f64> for Jet<D> {
    type Output = Self;

    fn sub(self, y: f64) -> Self {
        self + -y
    }
}

impl<const D: usize> Mul<f64> for Jet<D> {
    type Output = Self;

    fn mul(self, y: f64) -> Self {
        Self {
            value: self.value * y,
            gradient: self.gradient.map(|g| y * g),
            hessian: matrix(|i, j| y * self.hessian[i][j]),
        }
    }
}
