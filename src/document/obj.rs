//! Wavefront OBJ: polygons, vertex order, groups, materials and comments are kept.
//!
//! The text is the document. It is read once into triangles, and written by going through its statements again: texture
//! coordinates are replaced, corners of polygons are given the new ones, everything else stands as it stood. OBJ has one
//! UV set, so an old one is always replaced. A polygon whose triangles lie apart in UV space is split along its
//! diagonals, as a corner of a polygon has one UV.
use super::obj_text::rewrite;
use super::{
    DocumentError, Layout, NewUvs, OutputFormat, Primitive, SpaceMap, Upload, Warning,
    WriteOptions, Written,
};
use super::{new_gltf, new_obj, obj_mark, obj_moved};
use crate::certificate::CornerUvs;
use crate::measure::VAxis;
use crate::mesh::io::{self, Format};
use std::collections::BTreeMap;

/// A file as it was read.
#[derive(Clone)]
pub struct ObjDocument {
    bytes: Vec<u8>,
    obj: io::obj::Obj,
    primitives: Vec<Primitive>,
    resources: BTreeMap<String, Vec<u8>>,
}

/// Whether the content, or else the name, says so.
pub(super) fn is_obj(upload: &Upload) -> bool {
    Format::detect(&upload.name, &upload.bytes) == Some(Format::Obj)
}

impl ObjDocument {
    /// Reads the main file.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        Self::parse(upload.bytes.clone(), upload.resources.clone())
    }

    fn parse(bytes: Vec<u8>, resources: BTreeMap<String, Vec<u8>>) -> Result<Self, DocumentError> {
        let mut obj = io::obj::read(&bytes)?;
        let primitive = Primitive::of_file(std::mem::take(&mut obj.mesh))?;
        Ok(Self {
            bytes,
            obj,
            primitives: vec![primitive],
            resources,
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
        let uv = |corner: &io::obj::Corner| Some(self.obj.texcoords[corner.texcoord? as usize]);
        Ok(self.fans(uv).collect())
    }

    /// The normals per face corner; `None` where a corner has none.
    pub fn corner_normals(&self) -> Option<Vec<[[f64; 3]; 3]>> {
        let normal = |corner: &io::obj::Corner| {
            Some(self.obj.normals[corner.normal? as usize].map(f64::from))
        };
        self.fans(normal).collect()
    }

    /// The document with `uvs`.
    pub fn write(&self, uvs: &NewUvs, options: &WriteOptions) -> Result<Written, DocumentError> {
        if options.format != OutputFormat::Obj {
            let primitive = &self.primitives[0];
            let normal = |corner: &io::obj::Corner| Some(self.obj.normals[corner.normal? as usize]);
            let normals: Option<Vec<_>> = self.fans(normal).collect();
            return new_gltf::write(primitive, normals.as_deref(), uvs, options);
        }
        new_obj::only_set(options)?;
        let mut notes = super::WriteNotes::default();
        let text = match uvs.toward(0, VAxis::Up) {
            Some(corners) => {
                let had_uvs = !self.obj.texcoords.is_empty();
                notes
                    .primitives
                    .push(new_obj::note(&self.primitives[0], had_uvs));
                let rewritten = rewrite(&self.bytes, &self.obj, &corners);
                if had_uvs && uvs.layout == Layout::New {
                    notes.warnings.push(Warning::new(
                        "uvs_replaced",
                        "the UVs of the file were replaced: textures made for them need a re-bake",
                    ));
                }
                if rewritten.split_polygons > 0 {
                    let n = rewritten.split_polygons;
                    notes.warnings.push(Warning::new(
                        "polygons_split",
                        format!("polygons split along a seam: {n}"),
                    ));
                }
                rewritten.text
            }
            None => self.bytes.clone(),
        };
        let mut files = vec![(format!("{}.obj", options.stem), text)];
        files.extend(self.material_files());
        Ok(Written { files, notes })
    }

    /// A value for each corner of each triangle, in the order of the triangles; `None` for a triangle of which a corner
    /// has none.
    fn fans<T: Copy>(
        &self,
        value: impl Fn(&io::obj::Corner) -> Option<T> + Copy,
    ) -> impl Iterator<Item = Option<[T; 3]>> {
        self.obj.polygons().flat_map(move |polygon| {
            (1..polygon.len().saturating_sub(1)).map(move |k| {
                Some([
                    value(&polygon[0])?,
                    value(&polygon[k])?,
                    value(&polygon[k + 1])?,
                ])
            })
        })
    }

    /// The material files that the text names, as far as they were supplied.
    fn material_files(&self) -> Vec<(String, Vec<u8>)> {
        let mut names: Vec<String> = io::obj::statements(&self.bytes)
            .filter(|statement| statement.keyword == b"mtllib")
            .flat_map(|statement| statement.words)
            .map(|word| String::from_utf8_lossy(word).into_owned())
            .collect();
        names.sort_unstable();
        names.dedup();
        let supplied = |name: String| Some((name.clone(), self.resources.get(&name)?.clone()));
        names.into_iter().filter_map(supplied).collect()
    }
}
