//! The units in which a problem is meant.

use serde::Deserialize;

/// What the numbers of a problem are measured in: β, ε, tolerances and energies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Units {
    /// The length in which the mean element has area or volume 1.
    #[default]
    Normalized,
    /// The unit of the body's positions.
    Given,
}
