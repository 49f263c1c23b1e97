//! Wavefront OBJ: polygons, groups and vertex order kept.
use super::{CornerUvs, DocumentError, NewUvs, Primitive, Upload, WriteOptions, Written};

/// A file as it was read.
pub struct ObjDocument {
    primitives: Vec<Primitive>,
}

/// Whether the content, or else the name, says so.
pub(super) fn is_obj(upload: &Upload) -> bool {
    upload.extension() == "obj"
}

impl ObjDocument {
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
