//! Most isometric parameterizations.

use super::Density;
use crate::numerics::square::Matrix;

/// Conformal distortion that is infinite at an inversion.
///
/// ```text
/// ψ = Σᵢ σᵢ² / (D Δ^{2/D})     Δ = Πσ = det J     (in the plane ½(σ₁/σ₂ + σ₂/σ₁))
/// ```
/// Minimum 1, at similarities: it is independent of scale. Dimensionless; the sum over a mesh is weighted by rest size.
/// Domain det J > 0, +∞ outside. From: Hormann and Greiner 2000, MIPS. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mips;

/// Conformal and size distortion in one exponential, which emphasizes the worst elements.
///
/// ```text
/// ψ = exp(½ s (m + ½(Δ + Δ⁻¹)))     m the density of [`Mips`], Δ = det J
/// ```
/// Minimum eˢ, at rotations. Dimensionless; the sum over a mesh is weighted by rest size. Domain det J > 0, +∞ outside.
/// From: Fu, Liu, Guo 2015, Computing Locally Injective Mappings by Advanced MIPS, with α = ½. Tests:
/// `energy::taylor_*`.
#[derive(Clone, Copy, Debug)]
pub struct Amips {
    /// Exponent s: the larger, the more the worst elements weigh.
    pub s: f64,
}

impl<const D: usize> Density<D> for Mips {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if sigma[D - 1] <= 0.0 {
            return f64::INFINITY;
        }
        sigma.iter().map(|s| s * s).sum::<f64>() * scale(sigma)
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let (n, q) = (norm_squared(sigma), scale(sigma));
        sigma.map(|s| 2.0 * q * (s - n / (D as f64 * s)))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let (n, q) = (norm_squared(sigma), scale(sigma));
        let d = D as f64;
        let mut hessian = [[0.0; D]; D];
        for (i, s) in sigma.iter().enumerate() {
            for (j, t) in sigma.iter().enumerate() {
                hessian[i][j] = 4.0 * q / d * (n / (d * s * t) - s / t - t / s);
            }
            hessian[i][i] += 2.0 * q * (1.0 + n / (d * s * s));
        }
        hessian
    }
}

fn norm_squared<const D: usize>(sigma: &[f64; D]) -> f64 {
    sigma.iter().map(|s| s * s).sum()
}

/// Returns Δ^{−2/D}/D.
fn scale<const D: usize>(sigma: &[f64; D]) -> f64 {
    sigma.iter().product::<f64>().powf(-2.0 / D as f64) / D as f64
}

impl Amips {
    /// Returns the exponent, its gradient and its Hessian.
    fn exponent<const D: usize>(self, sigma: &[f64; D]) -> (f64, [f64; D], Matrix<D>) {
        let det: f64 = sigma.iter().product();
        let (first, second) = (0.5 * (1.0 - 1.0 / (det * det)), 1.0 / (det * det * det));
        let half = 0.5 * self.s;
        let value = half * (Mips.value(sigma) + 0.5 * (det + 1.0 / det));
        let mut gradient = Mips.gradient(sigma);
        let mut hessian = Mips.hessian(sigma);
        for i in 0..D {
            gradient[i] = half * (gradient[i] + first * det / sigma[i]);
            for j in 0..D {
                let product = sigma[i] * sigma[j];
                let mixed = if i == j { 0.0 } else { first * det / product };
                hessian[i][j] = half * (hessian[i][j] + second * det * det / product + mixed);
            }
        }
        (value, gradient, hessian)
    }
}

impl<const D: usize> Density<D> for Amips {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if sigma[D - 1] <= 0.0 {
            return f64::INFINITY;
        }
        self.exponent(sigma).0.exp()
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let (value, gradient, _) = self.exponent(sigma);
        gradient.map(|g| value.exp() * g)
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let (value, gradient, mut hessian) = self.exponent(sigma);
        for i in 0..D {
            for j in 0..D {
                hessian[i][j] = value.exp() * (hessian[i][j] + gradient[i] * gradient[j]);
            }
        }
        hessian
    }
}

// Least-squares conformal.

/// The squared distance of J to the nearest similarity.
///
/// ```text
/// ψ = ½ (σ₁ − σ₂)²
/// ```
/// Minimum 0, at similarities, including the zero map: without a barrier or two fixed vertices a free boundary shrinks
/// to a point. Dimensionless; the sum over a mesh is an area. Domain: every J of the plane; quadratic. From: Lévy et
/// al. 2002, Least Squares Conformal Maps. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lscm;

impl Density<2> for Lscm {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, [a, b]: &[f64; 2]) -> f64 {
        0.5 * (a - b) * (a - b)
    }

    fn gradient(&self, [a, b]: &[f64; 2]) -> [f64; 2] {
        [a - b, b - a]
    }

    fn hessian(&self, _: &[f64; 2]) -> Matrix<2> {
        [[1.0, -1.0], [-1.0, 1.0]]
    }
}

// An energy that is finite where elements are inverted, and drives them out of inversion.

/// Distortion with a regularized determinant.
///
/// ```text
/// ψ = N/(D χ^{2/D}) + λ(Δ² + 1)/(2χ)     χ = ½(Δ + √(ε² + Δ²))     N = Σσᵢ², Δ = Πσ = det J
/// ```
/// As ε goes to 0, χ goes to Δ where that is positive, and ψ to the density of [`Mips`] plus λ times the
/// size term ½(Δ + 1/Δ); the minimum is then 1 + λ, at rotations. Dimensionless; the sum over a mesh is weighted by
/// rest size. Domain: everywhere for ε > 0, det J > 0 for ε = 0. From: Garanzha, Kaporin, Kudryavtseva, Protais, Ray,
/// Sokolov 2021, Foldover-free maps in 50 lines of code. Tests: `energy::taylor_foldover_free`.
#[derive(Clone, Copy, Debug)]
pub struct FoldoverFree {
    /// ε: the smaller, the higher the cost of an inverted element.
    pub epsilon: f64,
    /// λ: weight of size relative to shape.
    pub lambda: f64,
}

/// A function of Δ with its first and second derivative.
type DeterminantJet = [f64; 3];

impl FoldoverFree {
    fn is_inside(&self, delta: f64) -> bool {
        self.epsilon > 0.0 || delta > 0.0
    }

    /// Returns χ(Δ).
    pub fn regularized(&self, delta: f64) -> f64 {
        let root = self.epsilon.hypot(delta);
        if delta > 0.0 {
            0.5 * (delta + root)
        } else {
            // The same without cancellation.
            0.5 * self.epsilon * (self.epsilon / (root - delta))
        }
    }

    fn chi(&self, delta: f64) -> DeterminantJet {
        let root = self.epsilon.hypot(delta);
        let chi = self.regularized(delta);
        let ratio = self.epsilon / root;
        [chi, chi / root, 0.5 * ratio * ratio / root]
    }

    /// Returns the factor χ^{−2/D}/D of N.
    fn shape<const D: usize>([chi, first, second]: DeterminantJet) -> DeterminantJet {
        let p = 2.0 / D as f64;
        let value = chi.powf(-p) / D as f64;
        let (first, second) = (first / chi, second / chi);
        [
            value,
            -p * value * first,
            p * value * ((p + 1.0) * first * first - second),
        ]
    }

    /// Returns λ(Δ² + 1)/(2χ).
    fn size(&self, delta: f64, [chi, first, second]: DeterminantJet) -> DeterminantJet {
        let half = 0.5 * self.lambda / chi;
        let value = half * (delta * delta + 1.0);
        let (first, second) = (first / chi, second / chi);
        [
            value,
            2.0 * half * delta - value * first,
            half * (2.0 - 4.0 * delta * first) + value * (2.0 * first * first - second),
        ]
    }

    /// Returns h and h′, and the first and second derivative of N·h + g by Δ at constant N, where ψ = N·h(Δ) + g(Δ).
    fn parts<const D: usize>(&self, sigma: &[f64; D]) -> ([f64; 2], [f64; 2]) {
        let delta = sigma.iter().product();
        let n: f64 = sigma.iter().map(|s| s * s).sum();
        let chi = self.chi(delta);
        let (h, g) = (Self::shape::<D>(chi), self.size(delta, chi));
        ([h[0], h[1]], [n * h[1] + g[1], n * h[2] + g[2]])
    }
}

/// Returns the product of all singular values except the i-th and j-th, which may be the same.
fn without<const D: usize>(sigma: &[f64; D], i: usize, j: usize) -> f64 {
    let others = (0..D).filter(|&k| k != i && k != j);
    others.map(|k| sigma[k]).product()
}

impl<const D: usize> Density<D> for FoldoverFree {
    fn floor(&self) -> f64 {
        if self.epsilon > 0.0 {
            f64::NEG_INFINITY
        } else {
            0.0
        }
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        let delta = sigma.iter().product();
        if !self.is_inside(delta) {
            return f64::INFINITY;
        }
        let n: f64 = sigma.iter().map(|s| s * s).sum();
        let chi = self.chi(delta);
        n * Self::shape::<D>(chi)[0] + self.size(delta, chi)[0]
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        let ([h, _], [first, _]) = self.parts(sigma);
        std::array::from_fn(|i| 2.0 * h * sigma[i] + first * without(sigma, i, i))
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let ([h, h1], [first, second]) = self.parts(sigma);
        let cofactors: [f64; D] = std::array::from_fn(|i| without(sigma, i, i));
        let mut hessian = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                let mixed = sigma[i] * cofactors[j] + sigma[j] * cofactors[i];
                hessian[i][j] = 2.0 * h1 * mixed + second * cofactors[i] * cofactors[j];
                hessian[i][j] += if i == j {
                    2.0 * h
                } else {
                    first * without(sigma, i, j)
                };
            }
        }
        hessian
    }

    fn twist(&self, sigma: &[f64; D], _: &[f64; D], i: usize, j: usize) -> f64 {
        let ([h, _], [first, _]) = self.parts(sigma);
        2.0 * h + first * without(sigma, i, j)
    }
}
