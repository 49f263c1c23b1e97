use super::colors::Color;
use super::material::{GltfMaterials, Material};
use super::new_gltf::{self, New, NewMesh, NewPrimitive, Shape};
use super::{Document, DocumentError, NewUvs, OutputFormat, Primitive, Warning};
use std::collections::BTreeMap;

/// A document in the form in which it is written, and what its vertices and triangles were before.
#[derive(Clone)]
pub struct Conversion {
    /// The document.
    pub document: Document,
    /// For each vertex over all primitives its number in the file; `None` where none has changed.
    pub vertices: Option<Vec<u32>>,
    /// For each triangle over all primitives its number in the file; `None` where none has changed.
    pub faces: Option<Vec<u32>>,
}

/// Which UVs of a file without sets of them go along into a new document. Those that textures sample always do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OldUvs {
    /// All.
    Kept,
    /// No others: new ones take their place.
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

    /// UVs for the file as UVs for the document.
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
    /// The document in the form in which it is written: for glTF triangles of any file become glTF, with objects as meshes and with
    /// materials, pictures and colors; else it stays as it is.
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

/// A document of triangles and colors without names.
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

/// What colors of vertices are seen on: without a material glTF would show a metal.
pub(super) fn colored() -> Material {
    Material::named("vertex colors")
}
