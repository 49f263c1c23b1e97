//! A formula before the dimension of the deformed elements is known.

use std::sync::Arc;

use serde::ser::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::parser::LONGEST;
use super::{Formula, FormulaError};

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
