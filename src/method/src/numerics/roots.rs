//! First positive roots of polynomials of low degree.

/// Returns the smallest positive root of c₀ + c₁t + c₂t² + c₃t³ if it is below `best`, else `best`; c₀ > 0.
///
/// Most elements are done after the first line: on (0, best) the polynomial is above the sum of its negative parts.
pub fn smallest_root_below([c0, c1, c2, c3]: [f64; 4], best: f64) -> f64 {
    if c0 + best * (c1.min(0.0) + best * (c2.min(0.0) + best * c3.min(0.0))) > 0.0 {
        return best;
    }
    if c3 == 0.0 {
        quadratic([c0, c1, c2], best)
    } else {
        cubic([c0, c1, c2, c3], best)
    }
}

/// Returns the smallest positive root of a quadratic if it is below `best`, else `best`. The roots are q/c₂ and c₀/q
/// with q = −½(c₁ ± √disc), the sign that of c₁: this avoids cancellation and a special case for c₂ = 0.
fn quadratic([c0, c1, c2]: [f64; 3], best: f64) -> f64 {
    let discriminant = c1 * c1 - 4.0 * c0 * c2;
    if discriminant < 0.0 {
        return best;
    }
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    [q / c2, c0 / q]
        .into_iter()
        .filter(|&t| t > 0.0)
        .fold(best, f64::min)
}

/// Returns the smallest positive root of a cubic if it is below `best`, else `best`. Between its turning points the
/// polynomial is monotone: the first such piece that ends below zero holds the root, which bisection finds from the
/// positive side.
fn cubic(c: [f64; 4], best: f64) -> f64 {
    let [c0, c1, c2, c3] = c;
    let value = |t: f64| c0 + t * (c1 + t * (c2 + t * c3));
    let cauchy = 1.0
        + [c0, c1, c2]
            .map(|c| (c / c3).abs())
            .into_iter()
            .fold(0.0, f64::max);
    let end = best.min(cauchy);
    let turns = turning_points([c1, c2, c3]);
    let mut from = 0.0;
    for to in turns.into_iter().chain([end]) {
        if to > from && to <= end {
            if value(to) <= 0.0 {
                return bisect(value, from, to);
            }
            from = to;
        }
    }
    best
}

/// Returns the roots of c₁ + 2c₂t + 3c₃t² in increasing order; NaN if there are none.
fn turning_points([c1, c2, c3]: [f64; 3]) -> [f64; 2] {
    let discriminant = c2 * c2 - 3.0 * c1 * c3;
    let q = -(c2 + discriminant.sqrt().copysign(c2));
    let (s, t) = (q / (3.0 * c3), c1 / q);
    [s.min(t), s.max(t)]
}

/// Returns the place of the sign change in (`low`, `high`].
fn bisect(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    // 60 halvings leave nothing of any interval that matters.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
