//! Least-squares conformal.

use super::{Density, Derivatives, Jacobian};

/// The squared distance of J to the nearest similarity.
///
/// ```text
/// ψ = ½ (σ₁ − σ₂)² = m²
/// ```
/// Minimum 0, at similarities, the zero map among them: without a barrier or two fixed vertices a free boundary shrinks
/// to a point. Without unit; the sum over a mesh is an area. Domain: every J; quadratic.
/// From: Lévy et al. 2002, Least Squares Conformal Maps. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lscm;

impl Density for Lscm {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, j: &Jacobian) -> f64 {
        let [c, d] = j.reflected;
        c * c + d * d
    }

    fn derivatives(&self, _: &Jacobian) -> Derivatives {
        Derivatives {
            twist: 0.0,
            flip: 2.0,
            pp: 0.0,
            pm: 0.0,
            mm: 2.0,
        }
    }
}
