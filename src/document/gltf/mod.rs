//! glTF 2.0.
use crate::document::{CornerUvs, DocumentError, NewUvs, Primitive, Upload, WriteOptions, Written};

/// A file as it was read.
pub struct GltfDocument {
    primitives: Vec<Primitive>,
}

/// Whether the content, or else the name, says so.
pub(in crate::document) fn is_gltf(upload: &Upload) -> bool {
    upload.extension() == "glb"
}

impl GltfDocument {
    /// Reads the main file.
    pub fn read(_upload: &Upload) -> Result<Self, DocumentError> {
        Err(DocumentError::UnknownFormat)
    }

    /// The triangles.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The UVs of set `set`.
    pub fn corner_uvs(
        &self,
        _primitive: usize,
        _set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        Ok(None)
    }

    /// The document with `uvs`.
    pub fn write(&self, _uvs: &NewUvs, _options: &WriteOptions) -> Result<Written, DocumentError> {
        Err(DocumentError::UnknownFormat)
    }
}
