//! UVs to write, options of writing, and notes on the result.

use super::{
    BakedTexture, DocumentError, JoinedPrimitive, KeptTexture, MergeNote, Primitive, Terms, Warning,
};
use crate::io::Format;
use serde::{Deserialize, Serialize};
use unwrapd_maps::mesh::VAxis;

/// UVs of each face's three corners.
pub type Corners = [[f32; 2]; 3];

/// A UV set to write.
#[derive(Debug, Clone)]
pub struct NewUvs {
    /// Relation to the set that it replaces.
    pub layout: Layout,
    /// Direction of v in these numbers; 1 − v is written if that of the file is opposite.
    pub v_axis: VAxis,
    /// For each primitive of the document the UVs of each corner of each face; `None` if the primitive takes no part.
    pub corners: Vec<Option<Vec<Corners>>>,
}

/// Relation of a UV set to the one that it replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Unrelated: textures that sampled the old one need a re-bake, and their transforms are removed.
    New,
    /// An edited version of the old one: textures are unchanged.
    Edited,
}

impl NewUvs {
    /// Checks that there is one entry per primitive and one corner triple per face, all finite.
    pub(super) fn check(&self, primitives: &[Primitive]) -> Result<(), DocumentError> {
        let is_complete = self.corners.len() == primitives.len();
        let mut all = self.corners.iter().zip(primitives);
        if is_complete && all.all(|(corners, primitive)| fit(corners.as_deref(), primitive)) {
            Ok(())
        } else {
            Err(DocumentError::InvalidUvs)
        }
    }

    /// Returns the UVs of a primitive with the requested direction of v; 1 − v is exact for multiples of 2⁻²³ in the
    /// unit square.
    pub fn toward(&self, primitive: usize, v_axis: VAxis) -> Option<Vec<Corners>> {
        let corners = self.corners[primitive].as_ref()?;
        let turned = |[u, v]: [f32; 2]| {
            // No −0, so that equal UVs have equal bits.
            let v = if self.v_axis == v_axis { v } else { 1.0 - v };
            [u + 0.0, v + 0.0]
        };
        Some(corners.iter().map(|face| face.map(turned)).collect())
    }
}

/// Returns whether there is a finite corner triple for each face, if there are any.
fn fit(corners: Option<&[Corners]>, primitive: &Primitive) -> bool {
    corners.is_none_or(|corners| {
        let mut numbers = corners.as_flattened().as_flattened().iter();
        corners.len() == primitive.triangles.len() && numbers.all(|x| x.is_finite())
    })
}

/// Format of the file to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum OutputFormat {
    /// One binary glTF file.
    Glb,
    /// glTF as JSON, with separate files for its buffer and images.
    Gltf,
    /// Wavefront OBJ.
    Obj,
}

impl OutputFormat {
    /// Returns the extension of its main file.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Glb => Format::Glb.extension(),
            Self::Gltf => Format::Gltf.extension(),
            Self::Obj => Format::Obj.extension(),
        }
    }
}

/// Options for writing a document.
#[derive(Debug, Clone)]
pub struct WriteOptions {
    /// Type of the main file.
    pub format: OutputFormat,
    /// Name of the main file without its extension.
    pub stem: String,
    /// Set to write, as in `TEXCOORD_n`; by default the first one that breaks no texture.
    pub texcoord: Option<u32>,
    /// Replaces a set that textures sample; set 0 if `texcoord` is `None`.
    pub overwrite: bool,
    /// Purpose of the UVs, which the file records if possible.
    pub terms: Option<Terms>,
}

/// Written files and notes.
#[derive(Debug, Clone)]
pub struct Written {
    /// Relative names and contents, the main file first.
    pub files: Vec<(String, Vec<u8>)>,
    /// Notes for the report.
    pub notes: WriteNotes,
}

/// Changes that writing a new UV set made to a document.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct WriteNotes {
    /// One entry per primitive that got UVs, before any were joined.
    pub primitives: Vec<PrimitiveNote>,
    /// Textures that sampled a set that was replaced: they show the old layout and need a re-bake.
    pub textures_affected: Vec<AffectedTexture>,
    /// Textures that were resampled for the new UVs.
    pub textures_baked: Vec<BakedTexture>,
    /// Textures that were to be resampled and could not be: they sample the UVs that they did.
    pub textures_kept: Vec<KeptTexture>,
    /// Primitives whose vertex colors were drawn into textures and removed.
    pub colors_baked: usize,
    /// JSON pointers of texture transforms that applied to a replaced set and were removed.
    pub transforms_removed: Vec<String>,
    /// Extensions that are gone from the file: compression that was undone, data that the new indices made wrong.
    pub extensions_dropped: Vec<String>,
    /// Materials that were merged; absent unless that was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub merged: Option<MergeNote>,
    /// The triangle primitives of the written file; `None` if they are those of the document.
    #[serde(skip)]
    pub joined: Option<Vec<JoinedPrimitive>>,
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
