//! Conversion of OBJ to glTF: each object a mesh, each of its materials a primitive.

use super::material::{Dropped, GltfMaterials, Material, MaterialFiles};
use super::new_gltf::{self, NewMesh, NewPrimitive, NewShape, unit_normals};
use super::new_obj::{Color, WHITE, from_srgb};
use super::obj::{ObjDocument, name_of};
use super::write::{Conversion, OldUvs, colored};
use super::{DocumentError, Warning, error};
use crate::io::obj::{Statement, statements};
use std::collections::{BTreeSet, HashMap, HashSet};

impl ObjDocument {
    /// Converts the triangles to glTF, with objects, materials, pictures and colors.
    pub(super) fn to_gltf(&self, old_uvs: OldUvs) -> Result<Conversion, DocumentError> {
        convert(self, old_uvs)
    }

    /// Returns the index of a material with this name, or else with this number, in the order of first uses.
    pub fn material(&self, name: &str) -> Option<usize> {
        let names = ObjParts::of(self.bytes()).materials;
        let named = names.iter().position(|known| known == name);
        named.or_else(|| name.parse().ok().filter(|&index| index < names.len()))
    }

    /// Returns the material of each triangle; `None` for one without.
    pub fn face_materials(&self) -> Vec<Option<usize>> {
        let parts = parts_of_faces(self, &ObjParts::of(self.bytes()));
        self.of_kept(parts.len(), |face| Some(parts[face].material? as usize))
    }

    /// Returns the name of the object, or in a file without objects of the group, of each triangle; `None` for one
    /// without.
    pub fn face_objects(&self) -> Vec<Option<String>> {
        let all = ObjParts::of(self.bytes());
        let parts = parts_of_faces(self, &all);
        self.of_kept(parts.len(), |face| {
            Some(all.objects[parts[face].object? as usize].clone())
        })
    }

    /// Collects the attribute of each of `n_faces` triangles of the file that were kept.
    fn of_kept<T>(&self, n_faces: usize, attribute: impl Fn(usize) -> T) -> Vec<T> {
        match self.kept_faces() {
            Some(kept) => kept.iter().map(|&face| attribute(face as usize)).collect(),
            None => (0..n_faces).map(attribute).collect(),
        }
    }

    /// Returns the color of each vertex, linear; `None` if no vertex has one.
    pub fn vertex_colors(&self) -> Option<Vec<Color>> {
        ObjParts::of(self.bytes()).colors
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
    let uvs: Vec<_> = document
        .face_uvs()
        .map(|uvs| uvs.and_then(downward))
        .collect();
    // Faces without UVs get primitives of their own, so that the others keep theirs.
    let has_uvs = |face: u32| old_uvs == OldUvs::Kept && uvs[face as usize].is_some();
    let mut meshes = meshes(&parts, &parts_of_faces, has_uvs, |material| {
        materials.index(&parts, material, files)
    });
    // Old UVs are kept only if wanted or if a texture of the mesh samples them.
    for mesh in &mut meshes {
        let with_uvs = old_uvs == OldUvs::Kept
            || mesh
                .primitives
                .iter()
                .any(|p: &NewPrimitive| p.material.is_some_and(|m| materials.is_textured[m]));
        for primitive in &mut mesh.primitives {
            primitive.with_uvs = with_uvs;
        }
    }
    let primitive = &document.primitives()[0];
    let shape = NewShape {
        positions: &primitive.positions,
        triangles: &primitive.triangles,
        uvs,
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
    has_uvs: impl Fn(u32) -> bool,
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
        let primitive = *of_parts.entry((*part, has_uvs(face))).or_insert_with(|| {
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
            let names = error::listed(self.unknown.iter().map(String::as_str));
            let message = format!("materials without a description become white: {names}");
            warnings.push(Warning::new("materials_unknown", message));
        }
        if !self.dropped.is_empty() {
            let counted = self.dropped.iter();
            let counted: Vec<String> = counted.map(|(word, n)| format!("{word} ({n})")).collect();
            let words = error::listed(counted.iter().map(String::as_str));
            let message =
                format!("glTF cannot hold these material statements, which are left out: {words}");
            warnings.push(Warning::new("material_statements_dropped", message));
        }
        warnings
    }
}

// Data of polygons and vertices of an OBJ text besides their shape: objects, groups, materials, colors.

/// Most meshes and primitives into which a file is divided: each is an object in JSON and a draw call.
const MOST_PARTS: usize = 8192;

/// Names and colors of an OBJ file.
#[derive(Debug, Default)]
struct ObjParts {
    /// Names of objects, or of groups in a file without objects.
    pub objects: Vec<String>,
    /// Names of materials.
    pub materials: Vec<String>,
    /// For each polygon its object and its material.
    pub of_polygons: Vec<Part>,
    /// For each vertex its color, if any has one.
    pub colors: Option<Vec<Color>>,
    /// Number of groups that divide objects further.
    n_lost_groups: usize,
    /// Number of points, lines and curves.
    n_lost_elements: usize,
    /// Number of parts, if they are too many to be kept apart.
    n_joined_parts: usize,
}

/// An object and a material, each by its index.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Hash)]
struct Part {
    pub object: Option<u32>,
    pub material: Option<u32>,
}

impl ObjParts {
    /// Reads the statements of a text.
    pub fn of(bytes: &[u8]) -> Self {
        let (mut objects, mut groups, mut materials) = (
            PartNames::default(),
            PartNames::default(),
            PartNames::default(),
        );
        let mut polygons = Vec::new();
        let mut colors = Vec::new();
        let (mut is_colored, mut n_lost_elements) = (false, 0);
        // Read names and colors in effect at each polygon and vertex.
        for statement in statements(bytes) {
            match statement.keyword {
                b"o" => objects.begin(&statement),
                b"g" => groups.begin(&statement),
                b"usemtl" => materials.begin(&statement),
                b"f" | b"fo" => {
                    polygons.push([objects.current, groups.current, materials.current]);
                }
                b"v" => {
                    let color = color(&statement);
                    is_colored |= color.is_some();
                    colors.push(color.unwrap_or(WHITE));
                }
                b"p" | b"l" | b"curv" | b"curv2" | b"surf" => n_lost_elements += 1,
                _ => {}
            }
        }
        // Objects divide the file into parts; without objects, groups do.
        let has_objects = !objects.all.is_empty();
        let n_lost_groups = if has_objects {
            lost_groups(&polygons)
        } else {
            0
        };
        let mut of_polygons: Vec<Part> = polygons
            .iter()
            .map(|&[object, group, material]: &[Option<u32>; 3]| Part {
                object: if has_objects { object } else { group },
                material,
            })
            .collect();
        Self {
            n_joined_parts: join(&mut of_polygons),
            of_polygons,
            objects: if has_objects { objects } else { groups }.all,
            materials: materials.all,
            colors: is_colored.then_some(colors),
            n_lost_groups,
            n_lost_elements,
        }
    }

    /// Returns warnings about content that a glTF file cannot hold.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if self.n_joined_parts > 0 {
            let n = self.n_joined_parts;
            let message = format!(
                "the {n} parts of the file are joined: a glTF file gets at most {MOST_PARTS}"
            );
            warnings.push(Warning::new("parts_joined", message));
        }
        if self.n_lost_groups > 0 {
            let n = self.n_lost_groups;
            let message = format!("objects become meshes; the {n} groups in them are left out");
            warnings.push(Warning::new("groups_dropped", message));
        }
        if self.n_lost_elements > 0 {
            let n = self.n_lost_elements;
            let message = format!("points, lines and curves are left out: {n} statements");
            warnings.push(Warning::new("elements_dropped", message));
        }
        warnings
    }
}

/// Names in the order of their first use, and the current one.
#[derive(Default)]
struct PartNames {
    all: Vec<String>,
    numbers: HashMap<String, u32>,
    current: Option<u32>,
}

impl PartNames {
    fn begin(&mut self, statement: &Statement) {
        let name = name_of(statement);
        self.current = (!name.is_empty()).then(|| {
            *self.numbers.entry(name).or_insert_with_key(|name| {
                self.all.push(name.clone());
                self.all.len() as u32 - 1
            })
        });
    }
}

/// Drops objects, and then materials, if there are too many parts. Returns the number of parts in that case, else 0.
fn join(parts: &mut [Part]) -> usize {
    let n = |parts: &[Part]| parts.iter().collect::<HashSet<_>>().len();
    let n_parts = n(parts);
    if n_parts <= MOST_PARTS {
        return 0;
    }
    for part in &mut *parts {
        part.object = None;
    }
    if n(parts) > MOST_PARTS {
        parts.fill(Part::default());
    }
    n_parts
}

/// Counts the groups of objects that have more than one group.
fn lost_groups(polygons: &[[Option<u32>; 3]]) -> usize {
    let pairs: BTreeSet<_> = polygons.iter().map(|[o, g, _]| (*o, *g)).collect();
    let pairs: Vec<_> = pairs.into_iter().collect();
    let mixed = pairs.chunk_by(|a, b| a.0 == b.0).filter(|c| c.len() > 1);
    mixed.flatten().filter(|(_, group)| group.is_some()).count()
}

/// Parses the color of `v x y z r g b`.
fn color(statement: &Statement) -> Option<Color> {
    let [_, _, _, r, g, b] = statement.words[..] else {
        return None;
    };
    let number = |word: &[u8]| {
        let number: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
        number.is_finite().then_some(number)
    };
    Some(from_srgb([number(r)?, number(g)?, number(b)?, 1.0]))
}
