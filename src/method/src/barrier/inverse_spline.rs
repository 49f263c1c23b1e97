//! The paper's barrier.

use crate::energy::Guard;

/// The reciprocal of a cubic spline of the element's size, zero for elements of ordinary size.
///
/// ```text
/// φ = β (1/g(y) − 1)   for y < 1, 0 above     y = (λ − ε)/(s (λ⁰ − ε))     g(y) = y³ − 3y² + 3y
/// ```
/// λ is the element's size, area or volume, λ⁰ at rest. Minimum 0, at y ≥ 1: with s = 1 from the rest size on; twice
/// continuously differentiable there. The paper has sλ⁰, its authors' code s(λ⁰ − ε), which is zero at rest. Not
/// weighted; β and ε are absolute, so scale a mesh to a mean size of 1 first. Domain λ > ε, +∞ outside. From: Schüller
/// et al. 2013, equations 2 to 6. Tests: `barrier::taylor_*`, `barrier::spline_is_infinite_at_epsilon`.
#[derive(Clone, Copy, Debug)]
pub struct InverseSpline {
    /// β, the strength.
    pub beta: f64,
    /// s, the support as a share of the rest size.
    pub s: f64,
    /// ε, the smallest size.
    pub epsilon: f64,
}

impl InverseSpline {
    /// Returns s(1 − ε/λ⁰): the det J above the floor at which the support ends.
    fn support(&self, rest_size: f64) -> f64 {
        self.s * (1.0 - self.floor(rest_size))
    }

    fn y(&self, det: f64, rest_size: f64) -> f64 {
        (det - self.floor(rest_size)) / self.support(rest_size)
    }
}

/// Returns 1/g(y) − 1 and its first two derivatives, 0 for y ≥ 1; y > 0.
///
/// g is y³ − 3y² + 3y, not written as 1 − (1 − y)³, which would cancel near 0, where accuracy matters.
pub(super) fn reciprocal(y: f64) -> [f64; 3] {
    if y >= 1.0 {
        return [0.0; 3];
    }
    let left = 1.0 - y;
    let inverse = 1.0 / (y * (3.0 - 3.0 * y + y * y));
    let slope = 3.0 * left * left * inverse;
    [
        inverse - 1.0,
        -slope * inverse,
        (2.0 * slope * slope + 6.0 * left * inverse) * inverse,
    ]
}

impl Guard for InverseSpline {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let y = self.y(det, rest_size);
        if y > 0.0 {
            self.beta * reciprocal(y)[0]
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let support = self.support(rest_size);
        let [_, first, second] = reciprocal(self.y(det, rest_size));
        [
            self.beta / support * first,
            self.beta / (support * support) * second,
        ]
    }
}
