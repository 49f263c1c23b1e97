//! UVs in the form in which files store them.

use serde::{Deserialize, Serialize};

/// UVs of a face's three corners.
pub type CornerUvs = [[f64; 2]; 3];

/// Direction in which v points in the given numbers.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VAxis {
    /// OBJ and most tools: (0, 0) is the lower left corner of the texture.
    #[default]
    Up,
    /// glTF: (0, 0) is the upper left corner of the texture.
    Down,
}
