//! Conversion of OBJ to glTF: each object a mesh, each of its materials a primitive.
use super::conversion::{Conversion, OldUvs, colored};
use super::material::{Dropped, GltfMaterials, Material, MaterialFiles};
use super::new_gltf::{self, NewMesh, NewPrimitive, Shape, unit_normals};
use super::obj::ObjDocument;
use super::obj_parts::{ObjParts, Part};
use super::{DocumentError, Warning, warning};
use std::collections::{BTreeSet, HashMap};

impl ObjDocument {
    /// Converts the triangles to glTF, with objects, materials, pictures and colors.
    pub(super) fn to_gltf(&self, old_uvs: OldUvs) -> Result<Conversion, DocumentError> {
        convert(self, old_uvs)
    }
}

/// Converts the document to glTF.
fn convert(document: &ObjDocument, old_uvs: OldUvs) -> Result<Conversion, DocumentError> {
    // Objects and materials.
    let parts = ObjParts::of(document.bytes());
    let parts_of_faces = parts_of_faces(document, &parts);
    let described = document.materials();
    let (files, mut warnings) = (&described.files, described.warnings());
    let mut materials = Materials {
        found: GltfMaterials::new(document.resources()),
        indices: HashMap::new(),
        is_textured: Vec::new(),
        has_colors: parts.colors.is_some(),
        dropped: Dropped::new(),
        unknown: BTreeSet::new(),
    };
    let mut meshes = meshes(&parts, &parts_of_faces, |material| {
        materials.index(&parts, material, files)
    });
    // Old UVs are kept only if wanted or if a texture of the mesh samples them.
    for mesh in &mut meshes {
        let is_textured = |p: &NewPrimitive| p.material.is_some_and(|m| materials.is_textured[m]);
        let with_uvs = old_uvs == OldUvs::Kept || mesh.primitives.iter().any(is_textured);
        for primitive in &mut mesh.primitives {
            primitive.with_uvs = with_uvs;
        }
    }
    let primitive = &document.primitives()[0];
    let shape = Shape {
        positions: &primitive.positions,
        triangles: &primitive.triangles,
        uvs: document
            .face_uvs()
            .map(|uvs| uvs.and_then(downward))
            .collect(),
        normals: document
            .face_normals()
            .map(|n| n.and_then(unit_normals))
            .collect(),
        colors: parts.colors.as_deref(),
    };
    let new = new_gltf::document(&shape, &meshes, &materials.found)?;
    warnings.extend(document.warnings().iter().cloned());
    warnings.extend(materials.warnings(!files.is_empty()));
    warnings.extend(parts.warnings());
    Ok(Conversion::new(new, warnings))
}

/// Returns the object and the material of each triangle.
fn parts_of_faces(document: &ObjDocument, parts: &ObjParts) -> Vec<Part> {
    let sizes = document.polygon_sizes();
    let polygons = parts.of_polygons.iter().zip(sizes);
    polygons
        .flat_map(|(part, size)| std::iter::repeat_n(*part, size.saturating_sub(2)))
        .collect()
}

/// Returns objects and their materials in the order of their first triangles.
fn meshes(
    parts: &ObjParts,
    parts_of_faces: &[Part],
    mut material: impl FnMut(Option<u32>) -> Option<usize>,
) -> Vec<NewMesh> {
    let mut meshes: Vec<NewMesh> = Vec::new();
    let mut of_objects = HashMap::new();
    let mut of_parts = HashMap::new();
    // Open the mesh and the primitive of each part at its first triangle.
    for (face, part) in (0..).zip(parts_of_faces) {
        let mesh = *of_objects.entry(part.object).or_insert_with(|| {
            meshes.push(NewMesh {
                name: part
                    .object
                    .map(|object| parts.objects[object as usize].clone()),
                primitives: Vec::new(),
            });
            meshes.len() - 1
        });
        let primitives = &mut meshes[mesh].primitives;
        let primitive = *of_parts.entry(*part).or_insert_with(|| {
            primitives.push(NewPrimitive {
                material: material(part.material),
                faces: Vec::new(),
                with_uvs: false,
            });
            primitives.len() - 1
        });
        primitives[primitive].faces.push(face);
    }
    meshes
}

/// Turns v down for glTF; returns `None` if a number is not finite.
fn downward(uvs: [[f64; 2]; 3]) -> Option<[[f32; 2]; 3]> {
    let uvs = uvs.map(|[u, v]| [u as f32 + 0.0, (1.0 - v) as f32 + 0.0]);
    uvs.as_flattened()
        .iter()
        .all(|x| x.is_finite())
        .then_some(uvs)
}

/// Materials in use.
struct Materials<'a> {
    found: GltfMaterials<'a>,
    indices: HashMap<Option<u32>, usize>,
    is_textured: Vec<bool>,
    has_colors: bool,
    dropped: Dropped,
    unknown: BTreeSet<String>,
}

impl Materials<'_> {
    /// Returns the index of a material, which is created at its first occurrence.
    fn index(
        &mut self,
        parts: &ObjParts,
        material: Option<u32>,
        files: &MaterialFiles,
    ) -> Option<usize> {
        if material.is_none() && !self.has_colors {
            return None;
        }
        if let Some(&index) = self.indices.get(&material) {
            return Some(index);
        }
        let is_textured = match material.map(|material| &parts.materials[material as usize]) {
            None => self.found.push(&colored(), ""),
            Some(name) => {
                let described = files.material(name, &mut self.dropped);
                let (material, folder) = described.unwrap_or_else(|| {
                    self.unknown.insert(name.clone());
                    (Material::named(name), "")
                });
                self.found.push(&material, folder)
            }
        };
        let index = self.is_textured.len();
        self.is_textured.push(is_textured);
        self.indices.insert(material, index);
        Some(index)
    }

    fn warnings(&self, has_files: bool) -> Vec<Warning> {
        let mut warnings = self.found.warnings();
        if has_files && !self.unknown.is_empty() {
            let names = warning::listed(self.unknown.iter().map(String::as_str));
            let message = format!("materials without a description become white: {names}");
            warnings.push(Warning::new("materials_unknown", message));
        }
        if !self.dropped.is_empty() {
            let counted = self.dropped.iter();
            let counted: Vec<String> = counted.map(|(word, n)| format!("{word} ({n})")).collect();
            let words = warning::listed(counted.iter().map(String::as_str));
            let message =
                format!("glTF cannot hold these material statements, which are left out: {words}");
            warnings.push(Warning::new("material_statements_dropped", message));
        }
        warnings
    }
}
