//! First and second derivatives of an isotropic function of J, and their projection.

use super::Jacobian;

/// Derivatives of ψ(p, m) as the numbers that its gradient and Hessian in J consist of.
///
/// ```text
/// ∇ψ  = ψ_p/p · (similar part) + ψ_m/m · (reflected part)
/// ∇²ψ = twist · t tᵀ + flip · r rᵀ + pp · u uᵀ + pm · (u vᵀ + v uᵀ) + mm · v vᵀ
/// ```
/// where u and v are the unit vectors of the similar and of the reflected part, t and r orthogonal to them within their
/// planes. So the eigenvalues are twist, flip and those of [[pp, pm], [pm, mm]].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// ψ_p/p: curvature against a rotation.
    pub twist: f64,
    /// ψ_m/m: curvature against a turn of the directions of stretch.
    pub flip: f64,
    /// ψ_pp.
    pub pp: f64,
    /// ψ_pm.
    pub pm: f64,
    /// ψ_mm.
    pub mm: f64,
}

impl Derivatives {
    /// All of them times an element's weight.
    #[must_use]
    pub fn times(self, weight: f64) -> Self {
        Self {
            twist: weight * self.twist,
            flip: weight * self.flip,
            pp: weight * self.pp,
            pm: weight * self.pm,
            mm: weight * self.mm,
        }
    }

    /// These and the derivatives of a function φ(det J), given φ′ and φ″. From det J = (p² − m²)/2:
    ///
    /// ```text
    /// φ_p/p = φ′    φ_m/m = −φ′    φ_pp = φ″p² + φ′    φ_pm = −φ″pm    φ_mm = φ″m² − φ′
    /// ```
    #[must_use]
    pub fn plus_guard(self, [first, second]: [f64; 2], j: &Jacobian) -> Self {
        let (p, m) = (j.p(), j.m());
        Self {
            twist: self.twist + first,
            flip: self.flip - first,
            pp: self.pp + second * p * p + first,
            pm: self.pm - second * p * m,
            mm: self.mm + second * m * m - first,
        }
    }

    /// The Hessian with its negative eigenvalues λ replaced by τλ: the nearest positive semidefinite one for τ = 0, the
    /// true one for τ = 1. The gradient needs the unprojected `twist` and `flip`.
    ///
    /// The symmetric 2×2 block H with eigenvalues λ < Λ becomes a·H + b, with a and b such that both eigenvalues come
    /// out right.
    #[must_use]
    pub fn project(self, tau: f64) -> Self {
        let clamp = |lambda: f64| lambda.max(tau * lambda);
        let Self { pp, pm, mm, .. } = self;
        let mean = 0.5 * (pp + mm);
        let radius = (0.25 * (pp - mm) * (pp - mm) + pm * pm).sqrt();
        let (small, large) = (mean - radius, mean + radius);
        let (a, b) = if small >= 0.0 {
            (1.0, 0.0)
        } else if large <= 0.0 {
            (tau, 0.0)
        } else {
            let a = (large - tau * small) / (large - small);
            (a, (tau - a) * small)
        };
        Self {
            twist: clamp(self.twist),
            flip: clamp(self.flip),
            pp: a * pp + b,
            pm: a * pm,
            mm: a * mm + b,
        }
    }
}
