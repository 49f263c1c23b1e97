//! Custom densities.
//!
//! A custom energy is typed as text, is a closure on numbers that carry their derivatives ([`Jet`]), or consists of
//! functions on arrays ([`Batched`]). All are a [`Density`] and share everything else with the built-in energies: they
//! add only ψ, ∂ψ and ∂²ψ in σ. They are checked once, when they are created ([`FormulaError`]).
mod batch;
mod check;
mod jet;
mod parser;

use super::Density;
use crate::numerics::square::Matrix;
pub use batch::Batched;
use check::{check, is_finite_inverted};
pub use jet::Jet;
pub use parser::FormulaError;
use parser::LONGEST;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

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
        check(&formula)?;
        if !is_finite_inverted(&formula) {
            formula.floor = 0.0;
        }
        Ok(formula)
    }

    fn at(&self, sigma: &[f64; D]) -> Jet<D> {
        (self.function)(&Jet::variables(sigma))
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

/// A custom energy for triangles, tetrahedra or both: a text, or a density of one dimension.
///
/// Any text can be one, so that reading it cannot fail. [`check`](Self::check) tests whether it is an energy at all;
/// [`planar`](Self::planar) and [`spatial`](Self::spatial), whether it is one of triangles or of tetrahedra.
#[derive(Clone, Debug)]
pub struct OwnEnergy {
    /// The text; `None` for densities.
    text: Option<Arc<str>>,
    planar: Result<Arc<dyn Density<2>>, FormulaError>,
    spatial: Result<Arc<dyn Density<3>>, FormulaError>,
}

impl OwnEnergy {
    /// Longest accepted text, in bytes.
    pub const LONGEST: usize = LONGEST;

    /// Returns the energy of triangles.
    pub fn planar(&self) -> Result<Arc<dyn Density<2>>, FormulaError> {
        self.planar.clone()
    }

    /// Returns the energy of tetrahedra.
    pub fn spatial(&self) -> Result<Arc<dyn Density<3>>, FormulaError> {
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
            planar: Formula::parse(text).map(|formula| Arc::new(formula) as _),
            spatial: Formula::parse(text).map(|formula| Arc::new(formula) as _),
        }
    }
}

impl From<Arc<dyn Density<2>>> for OwnEnergy {
    fn from(planar: Arc<dyn Density<2>>) -> Self {
        Self {
            text: None,
            planar: Ok(planar),
            spatial: Err(FormulaError::OtherDimension { dim: 3 }),
        }
    }
}

impl From<Arc<dyn Density<3>>> for OwnEnergy {
    fn from(spatial: Arc<dyn Density<3>>) -> Self {
        Self {
            text: None,
            planar: Err(FormulaError::OtherDimension { dim: 2 }),
            spatial: Ok(spatial),
        }
    }
}

impl From<Formula<2>> for OwnEnergy {
    fn from(planar: Formula<2>) -> Self {
        Self::from(Arc::new(planar) as Arc<dyn Density<2>>)
    }
}

impl From<Formula<3>> for OwnEnergy {
    fn from(spatial: Formula<3>) -> Self {
        Self::from(Arc::new(spatial) as Arc<dyn Density<3>>)
    }
}

impl From<Batched<2>> for OwnEnergy {
    fn from(planar: Batched<2>) -> Self {
        Self::from(Arc::new(planar) as Arc<dyn Density<2>>)
    }
}

impl From<Batched<3>> for OwnEnergy {
    fn from(spatial: Batched<3>) -> Self {
        Self::from(Arc::new(spatial) as Arc<dyn Density<3>>)
    }
}

impl PartialEq for OwnEnergy {
    fn eq(&self, other: &Self) -> bool {
        match (&self.text, &other.text) {
            (Some(text), Some(other)) => text == other,
            (None, None) => {
                same(&self.planar, &other.planar) && same(&self.spatial, &other.spatial)
            }
            _ => false,
        }
    }
}

/// Returns whether two densities are one, or are missing for the same reason.
fn same<T: ?Sized>(a: &Result<Arc<T>, FormulaError>, b: &Result<Arc<T>, FormulaError>) -> bool {
    match (a, b) {
        (Ok(a), Ok(b)) => Arc::ptr_eq(a, b),
        (Err(a), Err(b)) => a == b,
        _ => false,
    }
}

/// Serializes the text. A density has none and is written as `functions`, which cannot be read back.
impl Serialize for OwnEnergy {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.text {
            Some(text) => serializer.serialize_str(text),
            None => serializer.serialize_str("functions"),
        }
    }
}

impl<'de> Deserialize<'de> for OwnEnergy {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(|text| Self::from(&*text))
    }
}
