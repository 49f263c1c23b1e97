//! OFF, PLY and STL: triangles without a document around them. They are written as new glTF or OBJ files.
use super::{
    DocumentError, NewUvs, Primitive, SpaceMap, Subdivision, Upload, Warning, WriteOptions,
    Written, fanned, new_gltf,
};
use crate::certificate::CornerUvs;
use crate::mesh::io::{self, Format};

/// A file as it was read.
#[derive(Clone)]
pub struct SoupDocument {
    primitives: Vec<Primitive>,
    warnings: Vec<Warning>,
}

/// Whether the content, or else the name, says so.
pub(super) fn is_soup(upload: &Upload) -> bool {
    matches!(
        Format::detect(&upload.name, &upload.bytes),
        Some(Format::Off | Format::Ply | Format::Stl)
    )
}

impl SoupDocument {
    /// Reads the main file.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        let (mesh, place) = match Format::detect(&upload.name, &upload.bytes) {
            Some(Format::Off) => (io::off::read(&upload.bytes)?, "line"),
            Some(Format::Ply) => (io::ply::read(&upload.bytes)?, "face"),
            Some(Format::Stl) => (io::stl::read(&upload.bytes)?, "line"),
            Some(Format::Obj) | None => return Err(DocumentError::UnknownFormat),
        };
        Ok(Self {
            warnings: fanned::warning(&mesh.fanned, place).into_iter().collect(),
            primitives: vec![Primitive::of_file(mesh)?],
        })
    }

    /// What reading noticed.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The triangles: all polygons of the file as one primitive.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The triangles cut into pieces.
    #[must_use]
    pub fn subdivided(mut self, cuts: &[Subdivision]) -> Self {
        for (primitive, cut) in self.primitives.iter_mut().zip(cuts) {
            cut.apply(primitive);
        }
        self
    }

    /// The triangles where a map carries them.
    pub fn moved(mut self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        let positions = &mut self.primitives[0].positions;
        *positions = map.positions(positions);
        let is_lost = |p: &[f32; 3]| !p.iter().all(|x| x.is_finite());
        match positions.iter().position(is_lost) {
            Some(vertex) => Err(DocumentError::NonFinitePosition(format!("vertex {vertex}"))),
            None => Ok(self),
        }
    }

    /// These formats have no UVs that are read here.
    pub fn corner_uvs(
        &self,
        _primitive: usize,
        _set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        Ok(None)
    }

    /// The triangles with `uvs`, as a new glTF file.
    pub fn write(&self, uvs: &NewUvs, options: &WriteOptions) -> Result<Written, DocumentError> {
        new_gltf::write(&self.primitives[0], None, uvs, options)
    }
}
