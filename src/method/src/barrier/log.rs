//! Logarithmic barriers.

use crate::energy::Guard;

/// The plain logarithm: nonzero at every size, without a minimum.
///
/// ```text
/// φ = −β log(λ − ε)
/// ```
/// λ is the element's size. Not weighted; β and ε are absolute. Unbounded below as λ grows, which pulls elements open.
/// Domain λ > ε, +∞ outside. From: Schüller et al. 2013, equation 7. Tests: `barrier::taylor_guards`.
#[derive(Clone, Copy, Debug)]
pub struct Log {
    /// β, the strength.
    pub beta: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl Guard for Log {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let c = det * rest_size - self.epsilon;
        if c > 0.0 {
            -self.beta * c.ln()
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let slope = 1.0 / (det - self.floor(rest_size));
        [-self.beta * slope, self.beta * slope * slope]
    }
}

/// The logarithm minus its slope at rest.
///
/// ```text
/// φ = β (−log(λ − ε) + (λ − λ⁰)/r + log r)     r = λ⁰ − ε
/// ```
/// Zero with zero slope at λ = λ⁰, which is its minimum. Not weighted; β and ε are absolute. Domain λ > ε, +∞ outside.
/// From: Schüller et al. 2013, section 3.1. Tests: `barrier::taylor_guards`, `barrier::guards_rest_at_rest`.
#[derive(Clone, Copy, Debug)]
pub struct AugmentedLog {
    /// β, the strength.
    pub beta: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl Guard for AugmentedLog {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let floor = self.floor(rest_size);
        let y = (det - floor) / (1.0 - floor);
        if y > 0.0 {
            self.beta * (y - 1.0 - y.ln())
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let floor = self.floor(rest_size);
        let slope = 1.0 / (det - floor);
        [
            self.beta * (1.0 / (1.0 - floor) - slope),
            self.beta * slope * slope,
        ]
    }
}
