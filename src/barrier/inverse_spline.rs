//! The paper's barrier.

use crate::energy::Guard;

/// The reciprocal of a cubic spline of the element's size, zero for elements larger than s times their rest size.
///
/// ```text
/// φ = β (1/g(y) − 1)   for y < 1, 0 above     y = (λ − ε)/(s λ⁰)     g(y) = y³ − 3y² + 3y
/// ```
/// λ is the element's area, λ⁰ its rest area. Minimum 0, for λ ≥ sλ⁰ + ε; twice continuously differentiable there.
/// Not weighted by area; β and ε are absolute, so rest shapes are scaled to a mean area of 1. Domain λ > ε, +∞ outside.
/// From: Schüller et al. 2013, equations 2 to 6. Tests: `barrier::taylor_*`, `barrier::spline_is_infinite_at_epsilon`.
#[derive(Clone, Copy, Debug)]
pub struct InverseSpline {
    /// β, the strength.
    pub beta: f64,
    /// s, the support as a share of the rest area.
    pub s: f64,
    /// ε, the smallest area.
    pub epsilon: f64,
}

impl InverseSpline {
    fn y(&self, det: f64, rest_area: f64) -> f64 {
        (det - self.floor(rest_area)) / self.s
    }
}

/// g, g′ and g″. Not as 1 − (1 − y)³, which cancels where it matters, near 0.
fn spline(y: f64) -> [f64; 3] {
    let left = 1.0 - y;
    [y * (3.0 - 3.0 * y + y * y), 3.0 * left * left, -6.0 * left]
}

impl Guard for InverseSpline {
    fn floor(&self, rest_area: f64) -> f64 {
        self.epsilon / rest_area
    }

    fn value(&self, det: f64, rest_area: f64) -> f64 {
        let y = self.y(det, rest_area);
        if y >= 1.0 {
            0.0
        } else if y > 0.0 {
            self.beta * (1.0 / spline(y)[0] - 1.0)
        } else {
            f64::INFINITY
        }
    }

    fn derivatives(&self, det: f64, rest_area: f64) -> [f64; 2] {
        let y = self.y(det, rest_area);
        if y >= 1.0 {
            return [0.0; 2];
        }
        let [g, first, second] = spline(y);
        let inverse = 1.0 / g;
        let slope = first * inverse;
        [
            -self.beta / self.s * slope * inverse,
            self.beta / (self.s * self.s) * (2.0 * slope * slope - second * inverse) * inverse,
        ]
    }
}
