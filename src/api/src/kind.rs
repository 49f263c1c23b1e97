//! Kinds of jobs.

use serde::{Deserialize, Serialize};

use crate::Content;

/// Kind of job: the work that it does with its file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Makes a UV map and writes the file with it.
    #[default]
    Unwrap,
    /// Measures the UV map that the file already has.
    Measure,
    /// Proves what holds of the UV map that the file already has.
    Verify,
    /// Solves a problem file: handles pulled to targets, no element inverted.
    Solve,
    /// Pulls a mesh, a picture's outline, a drawing or surfaces in a cage by handles, no element inverted.
    Deform,
    /// Warps a picture by handles without folding it.
    Warp,
    /// Moves anchors of a file's UVs, no face flipped.
    EditUv,
    /// Aligns points of a surface with points of a texture, no face flipped.
    TextureMap,
    /// Packs the UV islands that the file has into one atlas, each as it is.
    Repack,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 9] = [
        Self::Unwrap,
        Self::Measure,
        Self::Verify,
        Self::Solve,
        Self::Deform,
        Self::Warp,
        Self::EditUv,
        Self::TextureMap,
        Self::Repack,
    ];

    /// Returns the content that jobs of this kind read.
    pub fn reads(self) -> Content {
        match self {
            Self::Unwrap
            | Self::Measure
            | Self::Verify
            | Self::EditUv
            | Self::TextureMap
            | Self::Repack => Content::Surface,
            Self::Solve => Content::Problem,
            Self::Deform => Content::Body,
            Self::Warp => Content::Picture,
        }
    }

    /// Returns whether jobs of this kind report what is proven of their result.
    pub fn proves(self) -> bool {
        !matches!(self, Self::Measure | Self::Solve | Self::Deform)
    }

    /// Returns whether jobs of this kind measure atlases.
    pub fn measures(self) -> bool {
        matches!(self, Self::Unwrap | Self::Repack | Self::Measure)
    }

    /// Returns the name used in JSON and in the store.
    pub fn word(self) -> &'static str {
        match self {
            Self::Unwrap => "unwrap",
            Self::Measure => "measure",
            Self::Verify => "verify",
            Self::Solve => "solve",
            Self::Deform => "deform",
            Self::Warp => "warp",
            Self::EditUv => "edit_uv",
            Self::TextureMap => "texture_map",
            Self::Repack => "repack",
        }
    }
}
