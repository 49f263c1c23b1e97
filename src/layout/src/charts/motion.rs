//! Rigid motions of the plane.

use unwrapd_method::numerics::vec2::{cross, dot, sub};

/// A turn and a shift.
pub struct Motion {
    from: [f64; 2],
    to: [f64; 2],
    cos_sin: [f64; 2],
}

impl Motion {
    /// The motion that brings the first of each pair as near as can be to the second, in the least
    /// squares of their distances.
    pub fn fitting(pairs: &[[[f64; 2]; 2]]) -> Self {
        let mean = |k: usize| {
            let sum = pairs
                .iter()
                .fold([0.0; 2], |[x, y], pair| [x + pair[k][0], y + pair[k][1]]);
            sum.map(|x| x / pairs.len() as f64)
        };
        let (from, to) = (mean(0), mean(1));
        let mut turn = [0.0; 2];
        for &[p, q] in pairs {
            let (p, q) = (sub(p, from), sub(q, to));
            turn = [turn[0] + dot(p, q), turn[1] + cross(p, q)];
        }
        let length = turn[0].hypot(turn[1]).max(f64::MIN_POSITIVE);
        Self {
            from,
            to,
            cos_sin: turn.map(|x| x / length),
        }
    }

    /// Where a point comes to lie.
    pub fn moved(&self, p: [f64; 2]) -> [f64; 2] {
        let ([x, y], [cos, sin]) = (sub(p, self.from), self.cos_sin);
        [
            self.to[0] + cos * x - sin * y,
            self.to[1] + sin * x + cos * y,
        ]
    }
}
