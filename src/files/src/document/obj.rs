//! Wavefront OBJ: polygons, vertex order, groups, materials and comments are kept.
//!
//! The text is the document. It is read once into triangles, and written by going through its statements again: texture
//! coordinates are replaced, corners of polygons are given the new ones, everything else stands as it stood. OBJ has one
//! UV set, so an old one is always replaced. A polygon whose triangles lie apart in UV space is split along
//! diagonals between them, as a corner of a polygon has one UV.
use super::obj_materials::ObjMaterials;
use super::obj_text::rewrite;
use super::warning::unused_not_finite;
use super::{
    DocumentError, Layout, NewUvs, Primitive, SpaceMap, Upload, Warning, WriteNotes, WriteOptions,
    Written,
};
use super::{fanned, new_obj, obj_mark, obj_moved};
use crate::io;
use std::collections::BTreeMap;
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// A file as it was read.
#[derive(Clone)]
pub struct ObjDocument {
    bytes: Vec<u8>,
    obj: io::obj::Obj,
    primitives: Vec<Primitive>,
    resources: BTreeMap<String, Vec<u8>>,
    warnings: Vec<Warning>,
}

impl ObjDocument {
    /// Reads the main file.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        Self::parse(upload.bytes.clone(), upload.resources.clone())
    }

    fn parse(bytes: Vec<u8>, resources: BTreeMap<String, Vec<u8>>) -> Result<Self, DocumentError> {
        let mut obj = io::obj::read(&bytes)?;
        let fanned = fanned::warning(&obj.mesh.fanned, "line");
        let mut primitive = Primitive::of_file(std::mem::take(&mut obj.mesh))?;
        let unused = unused_not_finite(primitive.place_unused());
        let warnings = fanned.into_iter().chain(unused).collect();
        Ok(Self {
            bytes,
            obj,
            primitives: vec![primitive],
            resources,
            warnings,
        })
    }

    /// The document with its triangles where a map carries them.
    pub fn moved(self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        let positions = &self.primitives[0].positions;
        let bytes = obj_moved::moved(&self.bytes, &self.obj, positions, map);
        Self::parse(bytes, self.resources)
    }

    /// What the document has in the place of a mark.
    pub(super) fn mark(&self) -> Option<serde_json::Value> {
        obj_mark::find(&self.bytes)
    }

    /// What reading noticed.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The triangles: all polygons of the file as one primitive.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The texture coordinates, which are set 0; `None` where a corner has none.
    pub fn corner_uvs(
        &self,
        primitive: usize,
        set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        if primitive > 0 || set > 0 {
            return Ok(None);
        }
        Ok(self.face_uvs().collect())
    }

    /// The normals per face corner; `None` where a corner has none.
    pub fn corner_normals(&self) -> Option<Vec<[[f64; 3]; 3]>> {
        self.face_normals().collect()
    }

    /// The document with `uvs`.
    pub fn write(&self, uvs: &NewUvs, options: &WriteOptions) -> Result<Written, DocumentError> {
        new_obj::only_set(options)?;
        let materials = self.materials();
        let mut notes = WriteNotes {
            warnings: materials.warnings(),
            ..WriteNotes::default()
        };
        let text = match uvs.toward(0, VAxis::Up) {
            Some(corners) => {
                let had_uvs = !self.obj.texcoords.is_empty();
                notes
                    .primitives
                    .push(new_obj::note(&self.primitives[0], had_uvs));
                let rewritten = rewrite(
                    &self.bytes,
                    &self.obj,
                    &self.primitives[0].positions,
                    &corners,
                );
                if had_uvs && uvs.layout == Layout::New {
                    notes.warnings.extend(materials.warnings_of_new_uvs());
                }
                if rewritten.split_polygons > 0 {
                    let n = rewritten.split_polygons;
                    notes.warnings.push(Warning::new(
                        "polygons_split",
                        format!("{n} polygons are split along a seam"),
                    ));
                }
                rewritten.text
            }
            None => self.bytes.clone(),
        };
        let mut files = vec![(format!("{}.obj", options.stem), text)];
        files.extend(materials.beside(&self.resources));
        Ok(Written { files, notes })
    }

    /// A value for each corner of each triangle, in the order of the triangles; `None` for a triangle of which a corner
    /// has none.
    fn per_face<T>(
        &self,
        value: impl Fn(&io::obj::Corner) -> Option<T>,
    ) -> impl Iterator<Item = Option<[T; 3]>> {
        let of = move |corner: u32| value(&self.obj.corners[corner as usize]);
        let triangles = self.obj.corner_triangles.iter();
        triangles.map(move |&[a, b, c]| Some([of(a)?, of(b)?, of(c)?]))
    }

    /// The texture coordinates of each triangle that has them.
    pub(super) fn face_uvs(&self) -> impl Iterator<Item = Option<CornerUvs>> {
        self.per_face(|corner| Some(self.obj.texcoords[corner.texcoord? as usize]))
    }

    /// The normals of each triangle that has them.
    pub(super) fn face_normals(&self) -> impl Iterator<Item = Option<[[f64; 3]; 3]>> {
        self.per_face(|corner| Some(self.obj.normals[corner.normal? as usize].map(f64::from)))
    }

    /// The corners of each polygon; one of n has n − 2 triangles.
    pub(super) fn polygon_sizes(&self) -> impl Iterator<Item = usize> {
        self.obj.polygons().map(<[_]>::len)
    }

    /// The text.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The files that it may refer to.
    pub(super) fn resources(&self) -> &BTreeMap<String, Vec<u8>> {
        &self.resources
    }

    /// The materials that the text names.
    pub(super) fn materials(&self) -> ObjMaterials {
        ObjMaterials::of(&self.bytes, &self.resources)
    }
}
