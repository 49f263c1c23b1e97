//! Claims that a certificate is asked to judge.

use crate::mesh::{Resolution, VAxis};
use serde::{Deserialize, Serialize};

/// Tests of faces against each other.
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

/// Treatment of charts that coincide: that cover the same points of the plane, exactly.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Stacks {
    /// They overlap like any others.
    #[default]
    Refused,
    /// They may overlap each other, and keep no distance.
    Accepted,
}

/// A distance to keep between charts, in texels of a texture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Padding {
    /// Distance, in texels.
    pub texels: u32,
    /// The texture, which covers the unit square; one with [`Resolution::is_regular`].
    pub resolution: Resolution,
}

/// Claims to judge in addition to the orientation of every face.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Claims {
    /// Enables tests of faces against each other, which all following claims need.
    pub overlap: Overlap,
    /// Treatment of charts that coincide.
    pub stacks: Stacks,
    /// Distance of charts to judge.
    pub padding: Option<Padding>,
    /// Texture of the unit square on whose texel borders charts are to end.
    pub aligned: Option<Resolution>,
    /// Number of pages side by side; each chart is to lie on one of them.
    pub pages: Option<u32>,
    /// Number of bits at which the map is to hold.
    pub bits: Option<u32>,
    /// Direction of v, which decides which charts are mirrored.
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
