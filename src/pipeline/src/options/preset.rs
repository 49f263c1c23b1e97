//! Purposes of UVs.

use serde::{Deserialize, Serialize};

/// Purpose of the UVs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Preset {
    /// Textures of materials.
    #[default]
    Material,
    /// Lighting of the whole scene: one atlas in UV set 1; other sets stay unchanged. Each node
    /// that shows a mesh gets its own copy and region, sized by its area in the scene. Padding
    /// holds for two more mip levels, and charts end on texel borders.
    Lightmap,
}
