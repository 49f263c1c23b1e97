//! What a certificate is asked to speak of.

use crate::mesh::{Resolution, VAxis};
use serde::{Deserialize, Serialize};

/// Whether faces are tested against each other.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub enum Overlap {
    /// Only the orientation of each face is judged.
    Skip,
    /// Pairs of faces whose interiors intersect are counted too, and charts and edges tested against each other as far as asked.
    #[default]
    Test,
}

/// A distance that charts shall keep: so many texels of a texture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Padding {
    /// The distance, in texels.
    pub texels: u32,
    /// The texture, which covers the unit square; one with [`Resolution::is_regular`].
    pub resolution: Resolution,
}

/// What is judged beside the orientation of every face.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Claims {
    /// Whether faces are tested against each other. What follows is only judged if they are.
    pub overlap: Overlap,
    /// The distance of charts to judge.
    pub padding: Option<Padding>,
    /// The texture of a unit square at the borders of whose texels charts shall end.
    pub aligned: Option<Resolution>,
    /// The pages side by side of which each chart shall lie on one.
    pub pages: Option<u32>,
    /// The bits that the map shall hold at.
    pub bits: Option<u32>,
    /// Where v points, which tells mirrored charts.
    pub v_axis: VAxis,
}

impl From<Overlap> for Claims {
    fn from(overlap: Overlap) -> Self {
        Self {
            overlap,
            ..Self::default()
        }
    }
}
