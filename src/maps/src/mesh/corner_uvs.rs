//! UVs as files have them.

use serde::{Deserialize, Serialize};

/// The UVs of a face's three corners.
pub type CornerUvs = [[f64; 2]; 3];

/// Which way v points in the numbers given.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VAxis {
    /// OBJ and most tools: (0, 0) is the lower left corner of the texture.
    #[default]
    Up,
    /// glTF: (0, 0) is the upper left corner of the texture.
    Down,
}
