//! The paper's barrier.

use crate::energy::Guard;

/// The reciprocal of a cubic spline of the element's size, zero for elements of ordinary size.
///
/// ```text
/// φ = β (1/g(y) − 1)   for y < 1, 0 above     y = (λ − ε)/(s (λ⁰ − ε))     g(y) = y³ − 3y² + 3y
/// ```
/// λ is the element's size, area or volume, λ⁰ at rest. Minimum 0, at y ≥ 1: with s = 1 from the rest size on; twice
/// continuously differentiable there. The paper has sλ⁰, its authors' code s(λ⁰ − ε), which is zero at rest. Not weighted; β and ε are absolute, so scale a mesh to a mean size of 1 first. Domain λ > ε, +∞ outside.
/// From: Schüller et al. 2013, equations 2 to 6. Tests: `barrier::taylor_*`, `barrier::spline_is_infinite_at_epsilon`.
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
    /// s(1 − ε/λ⁰): the det J above the floor at which the support ends.
    fn support(&self, rest_size: f64) -> f64 {
        self.s * (1.0 - self.floor(rest_size))
    }

    fn y(&self, det: f64, rest_size: f64) -> f64 {
        (det - self.floor(rest_size)) / self.support(rest_size)
    }
}

/// g, g′ and g″. Not as 1 − (1 − y)³, which cancels where it matters, near 0.
fn spline(y: f64) -> [f64; 3] {
    let left = 1.0 - y;
    [y * (3.0 - 3.0 * y + y * y), 3.0 * left * left, -6.0 * left]
}

impl Guard for InverseSpline {
    fn floor(&self, rest_size: f64) -> f64 {
        self.epsilon / rest_size
    }

    fn value(&self, det: f64, rest_size: f64) -> f64 {
        let y = self.y(det, rest_size);
        if y >= 1.0 {
            0.0
        } else if y > 0.0 {
            self.beta * (1.0 / spline(y)[0] - 1.0)
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_size: f64) -> [f64; 2] {
        let y = self.y(det, rest_size);
        if y >= 1.0 {
            return [0.0; 2];
        }
        let support = self.support(rest_size);
        let [g, first, second] = spline(y);
        let inverse = 1.0 / g;
        let slope = first * inverse;
        [
            -self.beta / support * slope * inverse,
            self.beta / (support * support) * (2.0 * slope * slope - second * inverse) * inverse,
        ]
    }
}
