//! Densities by formula.
//!
//! A custom energy is typed as text, or is a closure on numbers that carry their derivatives ([`Jet`]). Both are a
//! [`Density`] and share everything else with the built-in energies: a formula adds only ψ, ∂ψ and ∂²ψ in σ. It is
//! checked once, when it is created ([`FormulaError`]).
mod jet;
mod parser;

use super::Density;
use crate::numerics::square::Matrix;
pub use jet::Jet;
pub use parser::FormulaError;
use parser::LONGEST;
use serde::ser::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

/// Distance from the identity at which a formula is tested for smaller values.
const NEAR: f64 = 1e-2;

/// Singular values at which ψ must be symmetric and may be finite.
const FAR: [f64; 3] = [1.7, 0.9, 0.6];

type Function<const D: usize> = dyn Fn(&[Jet<D>; D]) -> Jet<D> + Send + Sync;

/// A custom density.
///
/// ```
/// use unwrapd_method::energy::{Density, Formula};
///
/// let arap = Formula::<2>::parse("((s1 - 1)^2 + (s2 - 1)^2)/2")?;
/// let same = Formula::new(|&[a, b]| ((a - 1.0).powf(2.0) + (b - 1.0).powf(2.0)) * 0.5)?;
/// assert_eq!(arap.value(&[2.0, 1.0]), 0.5);
/// assert_eq!(same.gradient(&[2.0, 1.0]), [1.0, 0.0]);
/// # Ok::<(), unwrapd_method::energy::FormulaError>(())
/// ```
/// ψ is the value of the formula at σ₁, …, σ_D, the last of them signed. Minimum at the identity, in its neighborhood.
/// Domain: where the formula is finite, +∞ outside, and only det J > 0 where it or a derivative is not finite at σ_D =
/// 0 or below. Clones share the function, and only clones are equal. Tests: `formula::*`.
#[derive(Clone)]
pub struct Formula<const D: usize> {
    function: Arc<Function<D>>,
    floor: f64,
}

impl<const D: usize> PartialEq for Formula<D> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function)
    }
}

impl<const D: usize> Formula<D> {
    /// Parses an energy: numbers, `s1` to `sD`, `+ - * / ^ **`, brackets, `sqrt`, `exp`, `log` (natural) and `cosh`.
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        let expression = parser::parsed::<D>(text)?;
        Self::new(move |sigma| expression.at(sigma))
    }

    /// Creates the energy that a closure computes.
    pub fn new(
        function: impl Fn(&[Jet<D>; D]) -> Jet<D> + Send + Sync + 'static,
    ) -> Result<Self, FormulaError> {
        let mut formula = Self {
            function: Arc::new(function),
            floor: f64::NEG_INFINITY,
        };
        formula.check()?;
        if !formula.is_finite_inverted() {
            formula.floor = 0.0;
        }
        Ok(formula)
    }

    fn at(&self, sigma: &[f64; D]) -> Jet<D> {
        (self.function)(&Jet::variables(sigma))
    }

    /// Checks that ψ is a deformation energy, as far as sample points show.
    fn check(&self) -> Result<(), FormulaError> {
        let rest = self.at(&[1.0; D]);
        if !rest.value.is_finite() {
            return Err(FormulaError::NotFinite { value: rest.value });
        }
        if !rest.is_smooth() {
            return Err(FormulaError::NotSmooth);
        }
        if !self.is_symmetric() {
            return Err(FormulaError::NotSymmetric);
        }
        // A symmetric quadratic form has the eigenvectors (1, …, 1) and all that are normal to it: its sign is known from
        // singular values that are all moved alike or one against the others.
        let size = rest.value.abs() + 1.0;
        for ways in 0..3_usize.pow(D as u32) {
            let step = |i: usize| [0.0, NEAR, -NEAR][ways / 3_usize.pow(i as u32) % 3];
            let sigma: [f64; D] = std::array::from_fn(|i| 1.0 + step(i));
            let slope: f64 = (0..D).map(|i| rest.gradient[i] * step(i)).sum();
            let tolerance = 1e-12 * size;
            if self.value(&sigma) < rest.value - tolerance || slope < -tolerance {
                let at = sigma.to_vec();
                return Err(FormulaError::NotMinimal { at });
            }
        }
        Ok(())
    }

    /// Returns whether ψ is the same for every order of unequal singular values. Exchanges with the first generate all
    /// orders.
    fn is_symmetric(&self) -> bool {
        let sigma: [f64; D] = std::array::from_fn(|i| FAR[i]);
        let value = self.value(&sigma);
        let exchanged = |mut sigma: [f64; D], i: usize| {
            sigma.swap(0, i);
            self.value(&sigma)
        };
        (1..D).all(|i| {
            let other = exchanged(sigma, i);
            other == value || (other - value).abs() <= 1e-12 * value.abs().max(1.0)
        })
    }

    /// Returns whether ψ and its derivatives are finite for flat and inverted elements.
    fn is_finite_inverted(&self) -> bool {
        [0.0, -0.3, -0.6].iter().all(|&last| {
            let mut sigma: [f64; D] = std::array::from_fn(|i| FAR[i]);
            sigma[D - 1] = last;
            self.at(&sigma).is_finite()
        })
    }
}

impl<const D: usize> Density<D> for Formula<D> {
    fn floor(&self) -> f64 {
        self.floor
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        if self.floor == 0.0 && sigma[D - 1] <= 0.0 {
            return f64::INFINITY;
        }
        let value = self.at(sigma).value;
        if value.is_nan() { f64::INFINITY } else { value }
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        self.at(sigma).gradient
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        self.at(sigma).hessian
    }

    fn derivatives(&self, sigma: &[f64; D]) -> ([f64; D], Matrix<D>) {
        let psi = self.at(sigma);
        (psi.gradient, psi.hessian)
    }
}

impl<const D: usize> std::fmt::Debug for Formula<D> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Formula")
            .field("floor", &self.floor)
            .finish_non_exhaustive()
    }
}

// A formula before the dimension of the deformed elements is known.

/// A custom energy for triangles, tetrahedra or both: a text, or a [`Formula`] of one dimension.
///
/// Any text can be one, so that reading it cannot fail. [`check`](Self::check) tests whether it is an energy at all;
/// [`planar`](Self::planar) and [`spatial`](Self::spatial), whether it is one of triangles or of tetrahedra.
#[derive(Clone, Debug)]
pub struct OwnEnergy {
    /// The text; `None` for closures.
    text: Option<Arc<str>>,
    planar: Result<Formula<2>, FormulaError>,
    spatial: Result<Formula<3>, FormulaError>,
}

impl OwnEnergy {
    /// Longest accepted text, in bytes.
    pub const LONGEST: usize = LONGEST;

    /// Returns the energy of triangles.
    pub fn planar(&self) -> Result<Formula<2>, FormulaError> {
        self.planar.clone()
    }

    /// Returns the energy of tetrahedra.
    pub fn spatial(&self) -> Result<Formula<3>, FormulaError> {
        self.spatial.clone()
    }

    /// Checks that it is an energy of triangles or of tetrahedra.
    ///
    /// # Errors
    /// The error for triangles, or that for tetrahedra if the formula uses a third singular value.
    pub fn check(&self) -> Result<(), FormulaError> {
        match (&self.planar, &self.spatial) {
            (Ok(_), _) | (_, Ok(_)) => Ok(()),
            (Err(FormulaError::UnknownName { name, .. }), Err(error)) if name == "s3" => {
                Err(error.clone())
            }
            (Err(error), Err(_)) => Err(error.clone()),
        }
    }
}

impl From<&str> for OwnEnergy {
    fn from(text: &str) -> Self {
        Self {
            text: Some(text.into()),
            planar: Formula::parse(text),
            spatial: Formula::parse(text),
        }
    }
}

impl From<Formula<2>> for OwnEnergy {
    fn from(planar: Formula<2>) -> Self {
        Self {
            text: None,
            planar: Ok(planar),
            spatial: Err(FormulaError::OtherDimension { dim: 3 }),
        }
    }
}

impl From<Formula<3>> for OwnEnergy {
    fn from(spatial: Formula<3>) -> Self {
        Self {
            text: None,
            planar: Err(FormulaError::OtherDimension { dim: 2 }),
            spatial: Ok(spatial),
        }
    }
}

impl PartialEq for OwnEnergy {
    fn eq(&self, other: &Self) -> bool {
        match (&self.text, &other.text) {
            (Some(text), Some(other)) => text == other,
            (None, None) => self.planar == other.planar && self.spatial == other.spatial,
            _ => false,
        }
    }
}

/// Serializes the text; a closure cannot be serialized.
impl Serialize for OwnEnergy {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.text {
            Some(text) => serializer.serialize_str(text),
            None => Err(S::Error::custom("a closure cannot be written")),
        }
    }
}

impl<'de> Deserialize<'de> for OwnEnergy {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(|text| Self::from(&*text))
    }
}
