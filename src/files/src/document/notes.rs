use super::{BakedTexture, KeptTexture, Warning};
use serde::Serialize;

/// Changes that writing a new UV set made to a document.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct WriteNotes {
    /// One entry per primitive that got UVs.
    pub primitives: Vec<PrimitiveNote>,
    /// Textures that sampled a set that was replaced: they show the old layout and need a re-bake.
    pub textures_affected: Vec<AffectedTexture>,
    /// Textures that were resampled for the new UVs.
    pub textures_baked: Vec<BakedTexture>,
    /// Textures that were to be resampled and could not be: they sample the UVs that they did.
    pub textures_kept: Vec<KeptTexture>,
    /// JSON pointers of texture transforms that applied to a replaced set and were removed.
    pub transforms_removed: Vec<String>,
    /// Extensions that are gone from the file: compression that was undone, data that the new indices made wrong.
    pub extensions_dropped: Vec<String>,
    /// For each triangle over all primitives written its number among those of the document; `None` where none has changed.
    #[serde(skip)]
    pub faces: Option<Vec<u32>>,
    /// Further warnings for users; reports list them among their own.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

/// Changes to one primitive.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PrimitiveNote {
    /// Index of the mesh in the file.
    pub mesh: usize,
    /// Index of the primitive in its mesh.
    pub primitive: usize,
    /// n of the `TEXCOORD_n` written.
    pub texcoord: u32,
    /// `true` if the primitive had that set before.
    pub replaced: bool,
    /// Vertices before.
    pub vertices_before: usize,
    /// Vertices now: a vertex whose corners have different UVs was split.
    pub vertices_after: usize,
    /// `true` if the indices needed a wider integer type.
    pub indices_widened: bool,
    /// `true` if a strip or fan became a triangle list.
    pub converted_to_triangles: bool,
    /// Treatment of the tangents.
    pub tangents: TangentsNote,
    /// For each vertex now its number before, as elements of the accessors are counted; `None` where each is what it was.
    #[serde(skip)]
    pub sources: Option<Vec<u32>>,
}

/// Treatment of the tangents of a primitive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TangentsNote {
    /// There were none, or they belong to another set.
    Untouched,
    /// They belonged to the replaced set and were computed again (MikkTSpace).
    Recomputed,
    /// They belonged to the replaced set and could not be computed again.
    Dropped,
}

/// A texture of a material that samples a replaced UV set.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct AffectedTexture {
    /// Index of the material; none for a texture that the primitive itself names.
    pub material: Option<usize>,
    /// Where in the material the texture is named, such as `pbrMetallicRoughness/baseColorTexture`.
    pub slot: String,
    /// Index of the texture.
    pub texture: usize,
    /// Index of its image, where it has a plain one.
    pub image: Option<usize>,
}
