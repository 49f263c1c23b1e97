//! The Jacobian of a linear map of the plane, split into a similarity and a reflected similarity.

use std::f64::consts::FRAC_1_SQRT_2;

/// J = [[f₀₀, f₀₁], [f₁₀, f₁₁]] in the orthonormal basis in which isotropic energies are simple.
///
/// As a map of complex numbers J z = α z + β z̄; the parts are √2 α and √2 β, so that their norms p and m are
/// Frobenius norms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian {
    /// √½ (f₀₀ + f₁₁, f₁₀ − f₀₁): the part that rotates and scales. Its norm is p.
    pub similar: [f64; 2],
    /// √½ (f₀₀ − f₁₁, f₁₀ + f₀₁): the part that reflects as well. Its norm is m.
    pub reflected: [f64; 2],
    /// det J. Kept beside the parts because from the triangle's edges it has a smaller rounding error than
    /// (p² − m²)/2.
    pub det: f64,
}

impl Jacobian {
    /// The matrix with these rows.
    pub fn from_rows([[f00, f01], [f10, f11]]: [[f64; 2]; 2]) -> Self {
        Self {
            similar: [f00 + f11, f10 - f01].map(|f| FRAC_1_SQRT_2 * f),
            reflected: [f00 - f11, f10 + f01].map(|f| FRAC_1_SQRT_2 * f),
            det: f00 * f11 - f01 * f10,
        }
    }

    /// p = (σ₁ + σ₂)/√2 ≥ 0.
    pub fn p(&self) -> f64 {
        norm(self.similar)
    }

    /// m = (σ₁ − σ₂)/√2 ≥ 0.
    pub fn m(&self) -> f64 {
        norm(self.reflected)
    }

    /// p² + m² = σ₁² + σ₂².
    pub fn norm_squared(&self) -> f64 {
        let ([a, b], [c, d]) = (self.similar, self.reflected);
        a * a + b * b + c * c + d * d
    }

    /// σ₁ ≥ |σ₂|, σ₂ negative where J reverses orientation.
    pub fn singular_values(&self) -> [f64; 2] {
        let (p, m) = (self.p(), self.m());
        [(p + m) * FRAC_1_SQRT_2, (p - m) * FRAC_1_SQRT_2]
    }
}

/// Not `hypot`: maps have coordinates of ordinary size, and this is the innermost loop.
fn norm([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}
