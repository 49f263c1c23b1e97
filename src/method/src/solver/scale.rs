//! The best uniform scale of a map.

/// Half the width of the bracket, in octaves, for the last parabola: the minimum is then known to a fraction of a
/// percent.
const NARROW: f64 = 0.25;

/// Returns the factor by which `x` should be scaled about the origin for the lowest energy `value`; 1 if no factor from
/// 2⁻³⁰ to 2³⁰ gives a finite energy.
///
/// A parameterization on a circle has an arbitrary size, and a start far too small costs Newton many steps. Doubles or
/// halves while that helps, then goes to the lowest point of a parabola through three sizes, first an octave apart and
/// then a quarter: the energy has one minimum in scale for every density here. Takes about seven evaluations.
pub fn best_scale(value: &dyn Fn(&[f64]) -> f64, x: &[f64]) -> f64 {
    let mut scaled = vec![0.0; x.len()];
    let mut energy = |exponent: f64| {
        let factor = exponent.exp2();
        for (scaled, x) in scaled.iter_mut().zip(x) {
            *scaled = factor * x;
        }
        value(&scaled)
    };
    // Double, then halve, as long as that helps, or until a size is in the domain.
    let mut best = (energy(0.0), 0.0_f64);
    for direction in [1.0, -1.0] {
        let mut exponent = best.1;
        while exponent.abs() < 30.0 {
            exponent += direction;
            let next = energy(exponent);
            if next < best.0 {
                best = (next, exponent);
            } else if best.0.is_finite() {
                break;
            }
        }
    }
    if !best.0.is_finite() {
        return 1.0;
    }
    // Refine by the lowest points of two parabolas.
    let mut exponent = best.1;
    for width in [1.0, NARROW] {
        let around = [-width, 0.0, width].map(|offset| energy(exponent + offset));
        exponent += width * lowest_of_parabola(around);
    }
    exponent.exp2()
}

/// Returns the lowest point in [−1, 1] of the parabola through the values at −1, 0 and 1; 0 if it has no minimum.
fn lowest_of_parabola([left, middle, right]: [f64; 3]) -> f64 {
    let curvature = left - 2.0 * middle + right;
    let lowest = 0.5 * (left - right) / curvature;
    if curvature > 0.0 && lowest.is_finite() {
        lowest.clamp(-1.0, 1.0)
    } else {
        0.0
    }
}
