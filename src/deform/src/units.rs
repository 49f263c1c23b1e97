//! Units of a problem's numbers.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Unit of a problem's numbers: β, ε, tolerances and energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Units {
    /// The length in which the mean element has area or volume 1.
    #[default]
    Normalized,
    /// The unit of the body's positions.
    Given,
}

impl fmt::Display for Units {
    /// Writes the phrase that follows an energy.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Normalized => "for a mean element of size 1",
            Self::Given => "in the unit of the mesh",
        })
    }
}
