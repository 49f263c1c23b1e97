//! The volume part of a Neo-Hookean material as a barrier.

use crate::energy::Guard;

/// The squared logarithm of the relative size.
///
/// ```text
/// φ = β log²((λ − ε)/(λ⁰ − 2ε))
/// ```
/// λ is the element's size, λ⁰ at rest. Minimum 0, where λ = λ⁰ − ε (the authors take ε off twice). Grows so slowly toward
/// ε that it often fails to hold. Not weighted; β and ε are absolute. Domain λ > ε, +∞ outside. From: Schüller et al. 2013,
/// equation 8. Tests: `barrier::taylor_guards`.
#[derive(Clone, Copy, Debug)]
pub struct NeoHookean {
    /// β, the strength.
    pub beta: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl Guard for NeoHookean {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let floor = self.floor(rest_size);
        let y = (det - floor) / (1.0 - 2.0 * floor);
        if y > 0.0 {
            self.beta * y.ln().powi(2)
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let floor = self.floor(rest_size);
        let c = det - floor;
        let log = (c / (1.0 - 2.0 * floor)).ln();
        [
            2.0 * self.beta * log / c,
            2.0 * self.beta * (1.0 - log) / (c * c),
        ]
    }
}
