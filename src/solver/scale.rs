//! The best size of a map.

/// Golden section: each evaluation leaves this share of the bracket.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The factor by which `x` should be scaled about the origin for the lowest energy `value`; 1 if none of 2⁻³⁰ to 2³⁰ gives a
/// finite one.
///
/// A parameterization on a circle knows nothing of size, and a start far too small costs Newton many steps. Doubles or
/// halves while that helps, then narrows by golden section to half a percent: the energy has one minimum in scale for
/// every density here. Some 20 evaluations.
pub fn best_scale(value: &dyn Fn(&[f64]) -> f64, x: &[f64]) -> f64 {
    let mut scaled = vec![0.0; x.len()];
    let mut energy = |exponent: f64| {
        let factor = exponent.exp2();
        for (scaled, x) in scaled.iter_mut().zip(x) {
            *scaled = factor * x;
        }
        value(&scaled)
    };
    let mut best = (energy(0.0), 0.0_f64);
    for direction in [1.0, -1.0] {
        while best.1.abs() < 30.0 {
            let exponent = best.1 + direction;
            let next = energy(exponent);
            if next < best.0 || next == f64::INFINITY && direction > 0.0 {
                best = (next, exponent);
            } else {
                break;
            }
        }
    }
    if !best.0.is_finite() {
        return 1.0;
    }
    let (mut low, mut high) = (best.1 - 1.0, best.1 + 1.0);
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut values = inner.map(&mut energy);
    while high - low > 0.01 {
        if values[0] < values[1] {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            values = [energy(inner[0]), values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            values = [values[1], energy(inner[1])];
        }
    }
    let narrowed = (values[1], inner[1]);
    let (_, exponent) = if narrowed.0 < best.0 { narrowed } else { best };
    exponent.exp2()
}
