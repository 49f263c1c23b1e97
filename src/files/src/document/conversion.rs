use super::colors::Color;
use super::material::{GltfMaterials, Material};
use super::new_gltf::{self, New, NewMesh, NewPrimitive, Shape};
use super::{Document, DocumentError, NewUvs, OutputFormat, Primitive, Warning};
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
        let own = |primitive: &Primitive| {
            let n = primitive.triangles.len();
            Some(rest.by_ref().take(n).collect())
        };
        NewUvs {
            corners: self.document.primitives().iter().map(own).collect(),
            ..*uvs
        }
    }
}

impl Document {
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

/// Creates a document of triangles and colors without names.
pub(super) fn of_triangles(
    primitive: &Primitive,
    colors: Option<&[Color]>,
    warnings: &[Warning],
) -> Result<Conversion, DocumentError> {
    let n_faces = primitive.triangles.len();
    let shape = Shape {
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
