//! Output of documents, and conversion of other formats to glTF.

use super::material::{GltfMaterials, Material};
use super::new_gltf::{self, New, NewMesh, NewPrimitive, NewShape};
use super::new_obj::{self, Color};
use super::soup::SoupDocument;
use super::{
    BakedTextures, Document, DocumentError, Marked, NewUvs, OutputFormat, Primitive, Warning,
    WriteOptions, Written, obj,
};
use std::collections::BTreeMap;

/// A document in the form in which it is written, with the original numbers of its vertices and triangles.
#[derive(Clone)]
pub struct Conversion {
    /// Converted document.
    pub document: Document,
    /// For each vertex over all primitives its number in the file; `None` if no number has changed.
    pub vertices: Option<Vec<u32>>,
    /// For each triangle over all primitives its number in the file; `None` if no number has changed.
    pub faces: Option<Vec<u32>>,
}

/// UVs of a file without UV sets that are transferred to a new document. Those that textures sample always are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OldUvs {
    /// All UVs.
    Kept,
    /// Only those that textures sample: new ones take the place of the others.
    Sampled,
}

impl Conversion {
    fn none(document: Document) -> Self {
        Self {
            document,
            vertices: None,
            faces: None,
        }
    }

    pub(super) fn new(new: New, warnings: Vec<Warning>) -> Self {
        Self {
            document: Document::Gltf(new.document.with_warnings(warnings)),
            vertices: Some(new.vertices),
            faces: Some(new.faces),
        }
    }

    /// Converts UVs for the file to UVs for the document.
    pub(super) fn uvs(&self, uvs: &NewUvs) -> NewUvs {
        let (Some(faces), Some([Some(corners)])) = (&self.faces, uvs.corners.as_array()) else {
            let corners = vec![None; self.document.primitives().len()];
            return NewUvs { corners, ..*uvs };
        };
        let mut rest = faces.iter().map(|&face| corners[face as usize]);
        NewUvs {
            corners: self
                .document
                .primitives()
                .iter()
                .map(|primitive: &Primitive| {
                    let n = primitive.triangles.len();
                    Some(rest.by_ref().take(n).collect())
                })
                .collect(),
            ..*uvs
        }
    }
}

impl Document {
    /// Writes the document with `uvs` as a UV set.
    pub fn write(&self, uvs: &NewUvs, options: &WriteOptions) -> Result<Written, DocumentError> {
        self.write_baked(uvs, options, None)
    }

    /// Writes the document with `uvs` as a UV set and with textures made for it; only those of glTF are known.
    pub fn write_baked(
        &self,
        uvs: &NewUvs,
        options: &WriteOptions,
        baked: Option<&BakedTextures>,
    ) -> Result<Written, DocumentError> {
        uvs.check(self.primitives())?;
        // Without new UVs, the mark of the present ones stays.
        let is_new = uvs.corners.iter().any(Option::is_some);
        let mut written = match (self, options.format) {
            (Self::Gltf(document), _) => match if is_new { self.marked()? } else { Marked::Not } {
                Marked::Fits(mark) => document.write(uvs, options, baked, Some(&mark))?,
                Marked::Not | Marked::Stale => document.write(uvs, options, baked, None)?,
            },
            (Self::Obj(document), OutputFormat::Obj) => document.write(uvs, options)?,
            (Self::Soup(document), OutputFormat::Obj) => {
                new_obj::write(&document.primitives()[0], document.colors(), uvs, options)?
            }
            (Self::Obj(_) | Self::Soup(_), _) => self.write_converted(uvs, options)?,
        };
        if is_new && options.format == OutputFormat::Obj {
            obj::renew(&mut written, options.terms.as_ref())?;
        }
        Ok(written)
    }

    /// Writes triangles of another format as glTF.
    fn write_converted(
        &self,
        uvs: &NewUvs,
        options: &WriteOptions,
    ) -> Result<Written, DocumentError> {
        let conversion = self.clone().for_output(options.format, OldUvs::Sampled)?;
        let uvs = conversion.uvs(uvs);
        let mut written = conversion.document.write_baked(&uvs, options, None)?;
        let known = self.warnings();
        let noticed = conversion.document.warnings().iter();
        let new = noticed.filter(|warning| !known.contains(warning));
        written.notes.warnings.splice(0..0, new.cloned());
        written.notes.faces = conversion.faces;
        Ok(written)
    }

    /// Converts the document to the form in which it is written: for glTF output triangles of any file become glTF,
    /// with objects as meshes and with materials, pictures and colors; otherwise it is unchanged.
    pub fn for_output(
        self,
        format: OutputFormat,
        old_uvs: OldUvs,
    ) -> Result<Conversion, DocumentError> {
        match (&self, format) {
            (Self::Gltf(_), _) | (_, OutputFormat::Obj) => Ok(Conversion::none(self)),
            (Self::Obj(document), _) => document.to_gltf(old_uvs),
            (Self::Soup(document), _) => document.to_gltf(),
        }
    }
}

impl SoupDocument {
    /// Converts the triangles and colors to glTF.
    fn to_gltf(&self) -> Result<Conversion, DocumentError> {
        of_triangles(&self.primitives[0], self.colors.as_deref(), &self.warnings)
    }
}

/// Creates a document of triangles and colors without names.
fn of_triangles(
    primitive: &Primitive,
    colors: Option<&[Color]>,
    warnings: &[Warning],
) -> Result<Conversion, DocumentError> {
    let n_faces = primitive.triangles.len();
    let shape = NewShape {
        positions: &primitive.positions,
        triangles: &primitive.triangles,
        uvs: vec![None; n_faces],
        normals: vec![None; n_faces],
        colors,
    };
    let no_files = BTreeMap::new();
    let mut materials = GltfMaterials::new(&no_files);
    let whole = NewPrimitive {
        material: colors.map(|_| 0),
        faces: (0..n_faces as u32).collect(),
        with_uvs: false,
    };
    if colors.is_some() {
        materials.push(&colored(), "");
    }
    let mesh = NewMesh {
        name: None,
        primitives: vec![whole],
    };
    let new = new_gltf::document(&shape, &[mesh], &materials)?;
    Ok(Conversion::new(new, warnings.to_vec()))
}

/// Returns the material of vertex colors: without one glTF would show a metal.
pub(super) fn colored() -> Material {
    Material::named("vertex colors")
}
