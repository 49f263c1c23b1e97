//! Plan and result of resampling a document's textures for new UVs.

use super::MergePlan;
use serde::Serialize;
use serde_json::Value;
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

/// Affine map of the values of a texel, channel by channel: `offset + factor × value`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tint {
    /// Factor of each channel.
    pub factor: [f32; 4],
    /// Summand of each channel.
    pub offset: [f32; 4],
}

impl Tint {
    /// The map that changes nothing.
    pub const NONE: Self = Self::factor([1.0; 4]);

    /// Creates the map that multiplies channels.
    pub const fn factor(factor: [f32; 4]) -> Self {
        Self {
            factor,
            offset: [0.0; 4],
        }
    }

    /// Maps a value.
    pub(crate) fn applied(&self, value: [f32; 4]) -> [f32; 4] {
        [0, 1, 2, 3].map(|k| self.offset[k] + self.factor[k] * value[k])
    }
}

/// Source of the texels of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneSource {
    /// The texture; white if there is none.
    pub texture: Option<TextureSource>,
    /// Map of the texture's decoded values: colors in linear light, directions in [−1, 1].
    pub tint: Tint,
    /// `true` if values are multiplied by the vertex colors of the surface.
    pub is_colored: bool,
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
    pub sources: BTreeMap<usize, PlaneSource>,
}

impl BakePlane {
    /// Returns whether enlarged texels are shown without interpolation.
    pub fn is_nearest(&self) -> bool {
        is_nearest(self.filters)
    }

    /// Iterates over the textures that it draws from.
    pub fn textures(&self) -> impl Iterator<Item = &TextureSource> {
        self.sources
            .values()
            .filter_map(|source| source.texture.as_ref())
    }
}

/// Returns whether a sampler with these filters shows enlarged texels without interpolation.
pub(super) fn is_nearest([mag, _]: [Option<usize>; 2]) -> bool {
    // `NEAREST` of WebGL, as glTF numbers filters.
    const NEAREST: usize = 9728;
    mag == Some(NEAREST)
}

/// Circumstances that decide which textures are made.
#[derive(Debug, Clone, Copy)]
pub struct BakeRequest<'a> {
    /// Materials to merge; `None` if that was not requested.
    pub merge: Option<&'a MergePlan>,
    /// Reasons why images cannot be read, by their indices.
    pub unreadable: &'a BTreeMap<usize, String>,
    /// Textures that stay unless their material is merged.
    pub kept: &'a [KeptTexture],
    /// `true` if vertex colors are drawn into base-color textures.
    pub draws_colors: bool,
}

/// Textures to make for a document, and those that cannot be made.
#[derive(Debug, Clone, Default)]
pub struct BakePlan {
    /// Textures to make.
    pub planes: Vec<BakePlane>,
    /// Textures that stay unchanged, together with the UVs that they sample.
    pub kept: Vec<KeptTexture>,
    /// Materials to merge, and those that stay apart; `None` if that was not requested.
    pub merge: Option<MergePlan>,
    pub(super) materials: Vec<MaterialPlanes>,
    pub(super) merged: Vec<MergedPlanes>,
    /// JSON pointers of the texture infos that will be replaced.
    pub(super) replaced: BTreeSet<String>,
    /// Primitives with directions relative to tangents.
    pub(super) normal_mapped: BTreeSet<usize>,
    /// Primitives whose vertex colors are drawn into textures.
    pub(super) colored: BTreeSet<usize>,
    /// Reasons why the vertex colors of primitives were to be drawn and are not.
    pub(super) colors_kept: BTreeMap<usize, String>,
}

/// Planes of a material for the primitives of one group.
#[derive(Debug, Clone)]
pub(super) struct MaterialPlanes {
    /// Index of the material; `None` for primitives without one.
    pub material: Option<usize>,
    /// Indices of the primitives.
    pub primitives: BTreeSet<usize>,
    /// Paths within the material and the planes that go there.
    pub slots: Vec<(String, usize)>,
}

/// A material that replaces several, and its planes.
#[derive(Debug, Clone)]
pub(super) struct MergedPlanes {
    /// Index into the merged materials of the plan.
    pub merged: usize,
    /// Indices of the primitives that get it.
    pub primitives: BTreeSet<usize>,
    /// The material; the texture infos of the planes are written when their textures exist.
    pub material: Value,
    /// Paths within the material and the planes that go there.
    pub slots: Vec<(String, usize)>,
}

impl BakePlan {
    /// Returns whether there is nothing to make, to keep or to merge.
    pub fn is_empty(&self) -> bool {
        self.planes.is_empty() && self.kept.is_empty() && self.merged.is_empty()
    }

    /// Returns whether a primitive needs tangents for its new UVs.
    pub fn is_normal_mapped(&self, primitive: usize) -> bool {
        self.normal_mapped.contains(&primitive)
    }

    /// Returns whether the vertex colors of a primitive are drawn into a texture.
    pub fn is_colored(&self, primitive: usize) -> bool {
        self.colored.contains(&primitive)
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
        self.has_colors_only || !self.plan.kept.is_empty() || !self.plan.colors_kept.is_empty()
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
