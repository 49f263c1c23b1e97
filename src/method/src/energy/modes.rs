//! First and second derivatives of an isotropic function of J, in the frame of its singular vectors.

use crate::numerics::square::Matrix;
use crate::numerics::symmetric::relax_negative;

use super::Density;

/// Singular values that differ by less than this share of the largest count as equal before a division by their
/// difference.
const EQUAL: f64 = 1e-6;

/// Gradient and Hessian of ψ(σ(J)) with J = U diag(σ) Vᵀ:
///
/// ```text
/// ∇ψ = U diag(slope) Vᵀ
/// ∇²ψ has the eigenvectors U (eᵢeⱼᵀ − eⱼeᵢᵀ) Vᵀ/√2 with eigenvalues twist = (ψᵢ + ψⱼ)/(σᵢ + σⱼ),
///                          U (eᵢeⱼᵀ + eⱼeᵢᵀ) Vᵀ/√2 with eigenvalues flip = (ψᵢ − ψⱼ)/(σᵢ − σⱼ),
/// and on the span of the U eᵢeᵢᵀ Vᵀ the D×D block scaling = ∂²ψ/∂σ².
/// ```
/// Twist and flip of a pair are stored at `[i][j]` for i < j. From: Smith, de Goes, Kim 2019, Analytic Eigensystems for
/// Isotropic Distortion Energies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modes<const D: usize> {
    /// ∂ψ/∂σᵢ.
    pub slope: [f64; D],
    /// ∂²ψ/∂σᵢ∂σⱼ.
    pub scaling: Matrix<D>,
    /// Curvature against rotations.
    pub twist: Matrix<D>,
    /// Curvature against turns of the directions of stretch.
    pub flip: Matrix<D>,
}

impl<const D: usize> Modes<D> {
    /// Computes the derivatives of `weight`·ψ.
    pub fn new(density: &dyn Density<D>, sigma: &[f64; D], weight: f64) -> Self {
        let (gradient, hessian) = density.derivatives(sigma);
        let (mut twist, mut flip) = ([[0.0; D]; D], [[0.0; D]; D]);
        for i in 0..D {
            for j in i + 1..D {
                twist[i][j] = weight * density.twist(sigma, &gradient, i, j);
                let difference = sigma[i] - sigma[j];
                flip[i][j] = weight
                    * if difference > EQUAL * sigma[0] {
                        (gradient[i] - gradient[j]) / difference
                    } else {
                        hessian[i][i] - hessian[i][j]
                    };
            }
        }
        Self {
            slope: gradient.map(|g| weight * g),
            scaling: hessian.map(|row| row.map(|h| weight * h)),
            twist,
            flip,
        }
    }

    /// Computes only the first derivatives of `weight`·ψ; the second are 0.
    pub fn of_slope(density: &dyn Density<D>, sigma: &[f64; D], weight: f64) -> Self {
        Self {
            slope: density.gradient(sigma).map(|g| weight * g),
            scaling: [[0.0; D]; D],
            twist: [[0.0; D]; D],
            flip: [[0.0; D]; D],
        }
    }

    /// Adds the derivatives of a function φ(det J), given φ′ and φ″. With κᵢ = Π_{j≠i} σⱼ and κᵢⱼ = Π_{k≠i,j} σₖ:
    ///
    /// ```text
    /// slopeᵢ = φ′κᵢ    scalingᵢⱼ = φ″κᵢκⱼ + φ′κᵢⱼ (i ≠ j)    twistᵢⱼ = φ′κᵢⱼ    flipᵢⱼ = −φ′κᵢⱼ
    /// ```
    pub fn add_guard(&mut self, [first, second]: [f64; 2], sigma: &[f64; D]) {
        let without = |i: usize, j: usize| -> f64 {
            (0..D)
                .filter(|&k| k != i && k != j)
                .map(|k| sigma[k])
                .product()
        };
        let cofactors: [f64; D] = std::array::from_fn(|i| without(i, i));
        for i in 0..D {
            self.slope[i] += first * cofactors[i];
            self.scaling[i][i] += second * cofactors[i] * cofactors[i];
            for j in i + 1..D {
                let mixed = first * without(i, j);
                self.twist[i][j] += mixed;
                self.flip[i][j] -= mixed;
                let entry = second * cofactors[i] * cofactors[j] + mixed;
                self.scaling[i][j] += entry;
                self.scaling[j][i] += entry;
            }
        }
    }

    /// Replaces the negative eigenvalues λ of the Hessian by τλ: τ = 0 gives the nearest positive semidefinite Hessian,
    /// τ = 1 the true one. The slope does not change.
    #[must_use]
    pub fn project(mut self, tau: f64) -> Self {
        let relax = |lambda: f64| lambda.max(tau * lambda);
        self.twist = self.twist.map(|row| row.map(relax));
        self.flip = self.flip.map(|row| row.map(relax));
        self.scaling = relax_negative(&self.scaling, tau);
        self
    }

    /// Returns the coefficients of dFᵢⱼ² and dFᵢⱼ·dFⱼᵢ in the frame for a pair i, j: twist and flip as matrix entries.
    fn shear(&self, i: usize, j: usize) -> [f64; 2] {
        let (i, j) = (i.min(j), i.max(j));
        [
            0.5 * (self.flip[i][j] + self.twist[i][j]),
            0.5 * (self.flip[i][j] - self.twist[i][j]),
        ]
    }

    /// Returns the block of two vertices in the frame, given the gradients g and h of their barycentric coordinates
    /// there: entry `[r][s]` is the second derivative in coordinate r of the first vertex and s of the second.
    pub fn block(&self, g: &[f64; D], h: &[f64; D]) -> Matrix<D> {
        let mut block = [[0.0; D]; D];
        for r in 0..D {
            block[r][r] += self.scaling[r][r] * g[r] * h[r];
            for s in (0..D).filter(|&s| s != r) {
                let [straight, crossed] = self.shear(r, s);
                block[r][r] += straight * g[s] * h[s];
                block[r][s] += self.scaling[r][s] * g[r] * h[s] + crossed * g[s] * h[r];
            }
        }
        block
    }
}
