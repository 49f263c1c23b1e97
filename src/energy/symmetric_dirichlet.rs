//! Symmetric Dirichlet.

use super::{Density, Derivatives, Jacobian};

/// The Dirichlet energies of the map and of its inverse.
///
/// ```text
/// ψ = ½ Σᵢ (σᵢ² + σᵢ⁻²) = ½ N (1 + D⁻²)     N = p² + m², D = det J
/// ```
/// Minimum 2, at rotations. Without unit; the sum over a mesh is an area. Domain det J > 0, +∞ outside: a barrier of its
/// own. From: Smith and Schaefer 2015, Bijective Parameterization with Free Boundaries. (Reports quote it without the
/// factor ½, with minimum 4.) Tests: `energy::taylor_*`, `energy::symmetric_dirichlet_has_its_minimum_at_rotations`.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymmetricDirichlet;

impl Density for SymmetricDirichlet {
    fn floor(&self) -> f64 {
        0.0
    }

    fn value(&self, j: &Jacobian) -> f64 {
        if j.det > 0.0 {
            0.5 * j.norm_squared() * (1.0 + 1.0 / (j.det * j.det))
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, j: &Jacobian) -> Derivatives {
        let (p, m, n) = (j.p(), j.m(), j.norm_squared());
        let inverse = 1.0 / j.det;
        let square = inverse * inverse;
        let cube = square * inverse;
        let three_n_fourth = 3.0 * n * square * square;
        let twist = 1.0 + square - n * cube;
        let flip = 1.0 + square + n * cube;
        Derivatives {
            twist,
            flip,
            pp: twist + p * p * (three_n_fourth - 4.0 * cube),
            pm: -p * m * three_n_fourth,
            mm: flip + m * m * (three_n_fourth + 4.0 * cube),
        }
    }
}
