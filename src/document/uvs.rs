use super::{DocumentError, Primitive, WriteNotes};
use serde::{Deserialize, Serialize};

/// A new UV set on the integer grid.
#[derive(Debug, Clone)]
pub struct NewUvs<'a> {
    /// k: a coordinate i stands for i / 2ᵏ; at most 23, so that f32 holds it exactly.
    pub grid_bits: u32,
    /// Per primitive of the document the grid coordinates of each corner of each face, v up; `None` where the
    /// primitive takes no part.
    pub corners: Vec<Option<&'a [[[i32; 2]; 3]]>>,
}

impl NewUvs<'_> {
    /// Whether there is one entry per primitive, one corner triple per face, and an exact f32 for each coordinate.
    pub(super) fn check(&self, primitives: &[Primitive]) -> Result<(), DocumentError> {
        let fits = self.grid_bits <= 23
            && self.corners.len() == primitives.len()
            && self
                .corners
                .iter()
                .zip(primitives)
                .all(|(corners, primitive)| {
                    corners.is_none_or(|corners| corners.len() == primitive.triangles.len())
                });
        let range = 0..=(1 << self.grid_bits.min(23));
        let on_grid = self
            .corners
            .iter()
            .flatten()
            .flat_map(|corners| corners.iter().flatten().flatten())
            .all(|coordinate| range.contains(coordinate));
        if fits && on_grid {
            Ok(())
        } else {
            Err(DocumentError::InvalidUvs)
        }
    }
}

/// What kind of file to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum OutputFormat {
    /// One binary glTF file.
    Glb,
    /// glTF as JSON, with its buffer and images beside it.
    Gltf,
    /// Wavefront OBJ.
    Obj,
}

/// How to write a document.
#[derive(Debug, Clone)]
pub struct WriteOptions {
    /// What kind of file.
    pub format: OutputFormat,
    /// Name of the main file without its extension.
    pub stem: String,
    /// The set to write, as in `TEXCOORD_n`; by default the first one that breaks no texture.
    pub texcoord: Option<u32>,
    /// Replace a set that textures sample; set 0 where `texcoord` names none.
    pub overwrite: bool,
}

/// Written files and what was done to write them.
#[derive(Debug, Clone)]
pub struct Written {
    /// Relative names and contents, the main file first.
    pub files: Vec<(String, Vec<u8>)>,
    /// What the reader of the report has to know.
    pub notes: WriteNotes,
}
