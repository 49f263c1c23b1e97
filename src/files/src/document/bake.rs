//! Plan and result of resampling a document's textures for new UVs.

use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Tangents of the three corners of a face, with the sign of the bitangent.
pub type CornerTangents = [[f32; 4]; 3];

/// Encoding of the texels of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Encoding {
    /// Colors in sRGB; alpha is data.
    Color,
    /// Plain numbers.
    Data,
    /// Directions relative to tangents.
    Normal,
}

/// Behavior of a texture beyond its borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// Repeats itself.
    Repeat,
    /// Repeats itself, mirrored every other time.
    Mirror,
    /// Continues its outermost texels.
    Clamp,
}

/// Mapping of an image to a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureSource {
    /// Index of the image.
    pub image: usize,
    /// Wrapping beyond its left and right, and beyond its top and bottom.
    pub wrap: [Wrap; 2],
    /// UV set that it samples.
    pub set: u32,
    /// Transform of the UVs: two rows of a linear map and a shift.
    pub transform: [[f64; 3]; 2],
}

impl TextureSource {
    /// Returns the place in the image for these UVs, in multiples of its size.
    pub fn place(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        self.transform.map(|[a, b, c]| a * u + b * v + c)
    }
}

/// A texture to make: parts of one UV space, each with its own source.
#[derive(Debug, Clone, PartialEq)]
pub struct BakePlane {
    /// Purpose, in words that can be part of a file name.
    pub name: String,
    /// Index of the group whose UV space it covers.
    pub group: usize,
    /// Encoding of its texels.
    pub encoding: Encoding,
    /// Filters of its sampler, `magFilter` and `minFilter` in the numbers of glTF.
    pub filters: [Option<usize>; 2],
    /// Source of the texels of each primitive.
    pub sources: BTreeMap<usize, TextureSource>,
}

impl BakePlane {
    /// Returns whether enlarged texels are shown without interpolation.
    pub fn is_nearest(&self) -> bool {
        // `NEAREST` of WebGL, as glTF numbers filters.
        const NEAREST: usize = 9728;
        self.filters[0] == Some(NEAREST)
    }
}

/// Textures to make for a document, and those that cannot be made.
#[derive(Debug, Clone, Default)]
pub struct BakePlan {
    /// Textures to make.
    pub planes: Vec<BakePlane>,
    /// Textures that stay unchanged, together with the UVs that they sample.
    pub kept: Vec<KeptTexture>,
    pub(super) materials: Vec<MaterialPlanes>,
    /// JSON pointers of the texture infos that will be replaced.
    pub(super) replaced: BTreeSet<String>,
    /// Primitives with directions relative to tangents.
    pub(super) normal_mapped: BTreeSet<usize>,
}

/// Planes of a material for the primitives of one group.
#[derive(Debug, Clone)]
pub(super) struct MaterialPlanes {
    pub material: usize,
    /// Indices of the primitives.
    pub primitives: BTreeSet<usize>,
    /// Paths within the material and the planes that go there.
    pub slots: Vec<(String, usize)>,
}

impl BakePlan {
    /// Returns whether a primitive needs tangents for its new UVs.
    pub fn is_normal_mapped(&self, primitive: usize) -> bool {
        self.normal_mapped.contains(&primitive)
    }
}

/// New textures for new UVs.
#[derive(Debug, Clone)]
pub struct BakedTextures {
    /// The plan that was carried out.
    pub plan: BakePlan,
    /// Side in texels and file, PNG, JPEG or `WebP`, of each plane.
    pub files: Vec<(u32, Vec<u8>)>,
    /// For each primitive the tangents of its new UVs, if it has normals and a normal map.
    pub tangents: Vec<Option<Vec<CornerTangents>>>,
    /// `true` if the document has vertex colors and no texture to resample.
    pub has_colors_only: bool,
}

impl BakedTextures {
    /// Returns whether something that could show the new UVs was not resampled.
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
