//! An energy that is finite where elements are inverted, and drives them out of inversion.

use super::Density;
use crate::numerics::square::Matrix;

/// Distortion with a regularized determinant.
///
/// ```text
/// ψ = N/(D χ^{2/D}) + λ(Δ² + 1)/(2χ)     χ = ½(Δ + √(ε² + Δ²))     N = Σσᵢ², Δ = Πσ = det J
/// ```
/// As ε goes to 0, χ goes to Δ where that is positive, and ψ to the density of [`Mips`](super::Mips) plus λ times the
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
