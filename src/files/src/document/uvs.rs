use super::{Document, DocumentError, Primitive, Terms, Upload, WriteNotes};
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
    /// Number of unit squares side by side along u that a new layout may cover.
    pub pages: u32,
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
    /// Checks that there is one entry per primitive and one corner triple per face, all finite and in a new layout on
    /// its pages.
    pub(super) fn check(&self, primitives: &[Primitive]) -> Result<(), DocumentError> {
        let fits = self.corners.len() == primitives.len()
            && self
                .corners
                .iter()
                .zip(primitives)
                .all(|(corners, primitive)| {
                    corners
                        .as_ref()
                        .is_none_or(|corners| corners.len() == primitive.triangles.len())
                });
        let is_possible = |[u, v]: &[f32; 2]| match self.layout {
            Layout::New => (0.0..=self.pages as f32).contains(u) && (0.0..=1.0).contains(v),
            Layout::Edited => u.is_finite() && v.is_finite(),
        };
        let mut corners = self.corners.iter().flatten();
        if fits && corners.all(|c| c.as_flattened().iter().all(is_possible)) {
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

impl Written {
    /// Reads the document from the written bytes.
    pub fn read_again(&self) -> Result<Document, DocumentError> {
        let mut files = self.files.iter().cloned();
        let (name, bytes) = files.next().unwrap_or_default();
        Document::read(&Upload {
            name,
            bytes,
            resources: files.collect(),
        })
    }
}
