//! Textures of materials that can be resampled for new UVs, and what puts them into the document.

use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Tangents of the three corners of a face, with the sign of the bitangent.
pub type CornerTangents = [[f32; 4]; 3];

/// What the texels of a texture are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Encoding {
    /// Colors in sRGB; alpha is data.
    Color,
    /// Numbers.
    Data,
    /// Directions relative to tangents.
    Normal,
}

/// What a texture shows beyond its borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// Itself again.
    Repeat,
    /// Itself, mirrored each other time.
    Mirror,
    /// Its outermost texels.
    Clamp,
}

/// How a surface is covered by an image.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureSource {
    /// Index of the image.
    pub image: usize,
    /// Beyond its left and right, beyond its top and bottom.
    pub wrap: [Wrap; 2],
    /// The UV set that is sampled.
    pub set: u32,
    /// What is done to its UVs: two rows of a linear map and a shift.
    pub transform: [[f64; 3]; 2],
}

impl TextureSource {
    /// The place in the image that UVs mean, in multiples of its size.
    pub fn place(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        self.transform.map(|[a, b, c]| a * u + b * v + c)
    }
}

/// A texture to make: parts of one UV space, each from its own source.
#[derive(Debug, Clone, PartialEq)]
pub struct BakePlane {
    /// What it is for, in words that can be part of a file name.
    pub name: String,
    /// Index of the group whose UV space it covers.
    pub group: usize,
    /// What its texels are.
    pub encoding: Encoding,
    /// The filters of its sampler, `magFilter` and `minFilter` as glTF numbers them.
    pub filters: [Option<usize>; 2],
    /// By primitive, where its texels come from.
    pub sources: BTreeMap<usize, TextureSource>,
}

impl BakePlane {
    /// Whether the nearest texel is shown where texels are large.
    pub fn is_nearest(&self) -> bool {
        const NEAREST: usize = 9728;
        self.filters[0] == Some(NEAREST)
    }
}

/// Textures to make for a document, and those that cannot be made.
#[derive(Debug, Clone, Default)]
pub struct BakePlan {
    /// What is to be made.
    pub planes: Vec<BakePlane>,
    /// What stays as it is, and so the UVs that it samples.
    pub kept: Vec<KeptTexture>,
    pub(super) materials: Vec<MaterialPlanes>,
    /// Where textures are named that will be replaced.
    pub(super) replaced: BTreeSet<String>,
    /// Primitives with directions relative to tangents.
    pub(super) normal_mapped: BTreeSet<usize>,
}

/// A material as the primitives of one group have it.
#[derive(Debug, Clone)]
pub(super) struct MaterialPlanes {
    pub material: usize,
    /// Indices of the primitives.
    pub primitives: BTreeSet<usize>,
    /// Paths within the material and the planes that go there.
    pub slots: Vec<(String, usize)>,
}

impl BakePlan {
    /// Whether a primitive needs tangents for its new UVs.
    pub fn is_normal_mapped(&self, primitive: usize) -> bool {
        self.normal_mapped.contains(&primitive)
    }
}

/// New textures for new UVs.
#[derive(Debug, Clone)]
pub struct BakedTextures {
    /// What was to be made.
    pub plan: BakePlan,
    /// For each plane its side in texels and the file, PNG or JPEG.
    pub files: Vec<(u32, Vec<u8>)>,
    /// For each primitive the tangents of its new UVs, where it has normals and a normal map.
    pub tangents: Vec<Option<Vec<CornerTangents>>>,
    /// Whether the document has colors at its vertices and no texture to resample.
    pub has_colors_only: bool,
}

impl BakedTextures {
    /// Whether something that could show the new UVs was not resampled.
    pub fn is_partial(&self) -> bool {
        self.has_colors_only || !self.plan.kept.is_empty()
    }
}

/// A texture that was resampled for the new UVs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BakedTexture {
    /// Index of the material in the written file.
    pub material: usize,
    /// Where in the material the texture is named.
    pub slot: String,
    /// Index of the texture in the written file.
    pub texture: usize,
    /// Texels along its side.
    pub side: u32,
}

/// A texture that was not resampled, and still samples the UVs that it did.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct KeptTexture {
    /// Index of the material; none for a texture that a primitive itself names.
    pub material: Option<usize>,
    /// Where in the material the texture is named.
    pub slot: String,
    /// Why.
    pub reason: String,
}
