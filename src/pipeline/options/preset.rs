//! What UVs are for.

use serde::{Deserialize, Serialize};

/// What UVs are for, and what follows from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Preset {
    /// Textures of materials.
    #[default]
    Material,
    /// Light of the whole scene in one texture: one atlas of all meshes in set 1, others stay as they are. Every node that shows
    /// a mesh gets a mesh and a part of the atlas of its own, with as many texels as its size in the scene needs. Padding holds
    /// for two mip levels at least, and charts end where texels end.
    Lightmap,
}
