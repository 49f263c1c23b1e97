//! Checks of custom densities.

use super::parser::FormulaError;
use crate::energy::Density;

/// Distance from the identity at which a density is tested for smaller values.
const NEAR: f64 = 1e-2;

/// Singular values at which ψ must be symmetric and may be finite.
const FAR: [f64; 3] = [1.7, 0.9, 0.6];

/// Checks that ψ is a deformation energy, as far as sample points show.
pub fn check<const D: usize>(density: &dyn Density<D>) -> Result<(), FormulaError> {
    let rest = density.value(&[1.0; D]);
    if !rest.is_finite() {
        return Err(FormulaError::NotFinite { value: rest });
    }
    if !is_smooth(density, &[1.0; D]) {
        return Err(FormulaError::NotSmooth);
    }
    if !is_symmetric(density) {
        return Err(FormulaError::NotSymmetric);
    }
    // A symmetric quadratic form has the eigenvectors (1, …, 1) and all that are normal to it: its sign is known from
    // singular values that are all moved alike or one against the others.
    let (gradient, tolerance) = (density.gradient(&[1.0; D]), 1e-12 * (rest.abs() + 1.0));
    for ways in 0..3_usize.pow(D as u32) {
        let step = |i: usize| [0.0, NEAR, -NEAR][ways / 3_usize.pow(i as u32) % 3];
        let sigma: [f64; D] = std::array::from_fn(|i| 1.0 + step(i));
        let slope: f64 = (0..D).map(|i| gradient[i] * step(i)).sum();
        if density.value(&sigma) < rest - tolerance || slope < -tolerance {
            let at = sigma.to_vec();
            return Err(FormulaError::NotMinimal { at });
        }
    }
    Ok(())
}

/// Returns whether the derivatives are finite.
fn is_smooth<const D: usize>(density: &dyn Density<D>, sigma: &[f64; D]) -> bool {
    let (gradient, hessian) = density.derivatives(sigma);
    let mut derivatives = gradient.iter().chain(hessian.as_flattened());
    derivatives.all(|d| d.is_finite())
}

/// Returns whether ψ is the same for every order of unequal singular values. Exchanges with the first generate all
/// orders.
fn is_symmetric<const D: usize>(density: &dyn Density<D>) -> bool {
    let sigma: [f64; D] = std::array::from_fn(|i| FAR[i]);
    let value = density.value(&sigma);
    let exchanged = |mut sigma: [f64; D], i: usize| {
        sigma.swap(0, i);
        density.value(&sigma)
    };
    (1..D).all(|i| {
        let other = exchanged(sigma, i);
        other == value || (other - value).abs() <= 1e-12 * value.abs().max(1.0)
    })
}

/// Returns whether ψ and its derivatives are finite for flat and inverted elements.
pub fn is_finite_inverted<const D: usize>(density: &dyn Density<D>) -> bool {
    [0.0, -0.3, -0.6].iter().all(|&last| {
        let mut sigma: [f64; D] = std::array::from_fn(|i| FAR[i]);
        sigma[D - 1] = last;
        density.value(&sigma).is_finite() && is_smooth(density, &sigma)
    })
}
