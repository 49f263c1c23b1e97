//! One check of derivatives for every density, barrier and objective.

/// Asserts by the fall of the Taylor remainders that `gradient` and `hessian` (the function v ↦ Hv) belong to `f` at `x`.
///
/// With steps h and h/2 along `d`, the remainder after the linear part falls with order 2, after the quadratic part with
/// order 3. Remainders at rounding prove nothing, so the larger step must leave one well above it, unless the function
/// is linear or quadratic and the remainder vanishes.
pub fn assert_taylor(
    f: impl Fn(&[f64]) -> f64,
    gradient: &[f64],
    hessian: impl Fn(&[f64]) -> Vec<f64>,
    x: &[f64],
    d: &[f64],
) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let slope = dot(gradient, d);
    let curvature = dot(d, &hessian(d));
    assert!(slope != 0.0, "a vanishing derivative proves nothing");
    let rounding = 1e-13 * f(x).abs().max(1e-3);
    let remainders = |h: f64| {
        let moved: Vec<f64> = x.iter().zip(d).map(|(x, d)| x + h * d).collect();
        let first = f(&moved) - f(x) - h * slope;
        [first.abs(), (first - 0.5 * h * h * curvature).abs()]
    };
    for (part, order) in [1.9, 2.8].into_iter().enumerate() {
        let best = (4..14)
            .map(|k| 0.5_f64.powi(k))
            .map(|h| (remainders(h)[part], remainders(0.5 * h)[part]))
            .filter(|&(_, small)| small > 10.0 * rounding)
            .map(|(large, small)| (large / small).log2())
            .fold(None, |best: Option<f64>, o| {
                Some(best.map_or(o, |b| b.max(o)))
            });
        match best {
            Some(found) => assert!(found > order, "order {found} of remainder {part}"),
            None => assert!(
                remainders(1e-3)[part] <= 100.0 * rounding,
                "remainder {part}: {:e}, value {:e}, slope {slope:e}, curvature {curvature:e}",
                remainders(1e-3)[part],
                f(x)
            ),
        }
    }
}
