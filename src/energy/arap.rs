//! As-rigid-as-possible.

use std::f64::consts::SQRT_2;

use super::{Density, Derivatives, Jacobian};

/// The squared distance of J to the nearest rotation.
///
/// ```text
/// ψ = ½ Σᵢ (σᵢ − 1)² = ½‖J − R‖² = ½(p² + m²) − √2 p + 1
/// ```
/// Minimum 0, at rotations; σ₂ is signed, so a reflection costs 2. Without unit; the sum over a mesh is an area.
/// Domain: every J; not differentiable where p = 0 (a similarity reflected), where the twist is taken at a p of 1e-8.
/// From: Liu et al. 2008, A Local/Global Approach to Mesh Parameterization. Tests: `energy::taylor_*`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arap;

/// Where 1/p is cut off: rounding of p itself is of this relative size when J has entries of size 1.
const SMALLEST_P: f64 = 1e-8;

impl Density for Arap {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, j: &Jacobian) -> f64 {
        0.5 * j.norm_squared() - SQRT_2 * j.p() + 1.0
    }

    fn derivatives(&self, j: &Jacobian) -> Derivatives {
        Derivatives {
            twist: 1.0 - SQRT_2 / j.p().max(SMALLEST_P),
            flip: 1.0,
            pp: 1.0,
            pm: 0.0,
            mm: 1.0,
        }
    }
}
