//! A file of any format, as triangles in a document of record.

use super::gltf::{self, GltfDocument};
use super::group::{self, Group, GroupBy, Primitive};
use super::obj::ObjDocument;
use super::soup::SoupDocument;
use super::{DocumentError, SpaceMap, Subdivision, Upload, Warning, Written, obj};
use crate::document::Mark;
use crate::document::Marked;
use crate::document::format_of;
use crate::io::Format;
use serde_json::Value;
use std::collections::BTreeSet;
use unwrapd_maps::mesh::Resolution;
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// Content of a file.
#[derive(Clone)]
pub enum Document {
    /// glTF 2.0, `.glb` or `.gltf`.
    Gltf(GltfDocument),
    /// Wavefront OBJ.
    Obj(ObjDocument),
    /// OFF, PLY or STL: triangles without a document around them.
    Soup(SoupDocument),
}

impl Document {
    /// Reads the main file of `upload`; its format is determined by its content, else by the extension of its name.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        match format_of(upload) {
            Some(Format::Glb | Format::Gltf) => GltfDocument::read(upload).map(Self::Gltf),
            Some(Format::Obj) => ObjDocument::read(upload).map(Self::Obj),
            _ => SoupDocument::read(upload).map(Self::Soup),
        }
    }

    /// Returns the warnings of reading for users.
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Gltf(document) => document.warnings(),
            Self::Obj(document) => document.warnings(),
            Self::Soup(document) => document.warnings(),
        }
    }

    /// Returns the triangle primitives in file order.
    pub fn primitives(&self) -> &[Primitive] {
        match self {
            Self::Gltf(document) => document.primitives(),
            Self::Obj(document) => document.primitives(),
            Self::Soup(document) => document.primitives(),
        }
    }

    /// Returns the default grouping of UV spaces: by material for glTF, else all of a file, as that has one UV space.
    pub fn grouping(&self) -> GroupBy {
        match self {
            Self::Gltf(_) => GroupBy::Material,
            Self::Obj(_) | Self::Soup(_) => GroupBy::Scene,
        }
    }

    /// Groups the primitives that share one UV space, in the order of their first primitives. Files without meshes and
    /// materials are one group.
    pub fn groups(&self, by: GroupBy) -> Vec<Group> {
        match self {
            Self::Gltf(document) => group::groups(self.primitives(), by, document),
            Self::Obj(_) | Self::Soup(_) => {
                group::groups(self.primitives(), GroupBy::Scene, &group::Nameless)
            }
        }
    }

    /// Returns the index of a material with this name, or else with this number. Materials of OBJ are those that it
    /// uses, in the order of their first uses; OFF, PLY and STL have none.
    pub fn material(&self, name: &str) -> Option<usize> {
        match self {
            Self::Gltf(document) => document.material(name),
            Self::Obj(document) => document.material(name),
            Self::Soup(_) => None,
        }
    }

    /// Returns the material of each face of a primitive; `None` for a face without one.
    pub fn face_materials(&self, primitive: usize) -> Vec<Option<usize>> {
        match self {
            Self::Obj(document) => document.face_materials(),
            Self::Gltf(_) | Self::Soup(_) => {
                let primitive = &self.primitives()[primitive];
                vec![primitive.material; primitive.triangles.len()]
            }
        }
    }

    /// Returns the name of the object of each face of a primitive, in glTF that of its mesh, in OBJ that of its object or,
    /// in a file without objects, of its group; `None` for a face without one.
    pub fn face_objects(&self, primitive: usize) -> Vec<Option<String>> {
        let of_primitive = |name: Option<String>| {
            let n_faces = self.primitives()[primitive].triangles.len();
            vec![name; n_faces]
        };
        match self {
            Self::Obj(document) => document.face_objects(),
            Self::Gltf(document) => of_primitive(document.mesh_name(primitive)),
            Self::Soup(_) => of_primitive(None),
        }
    }

    /// Returns the color of each vertex of a primitive, linear and with alpha; `None` if it has none.
    pub fn vertex_colors(&self, primitive: usize) -> Result<Option<Vec<[f32; 4]>>, DocumentError> {
        match self {
            Self::Gltf(document) => document.vertex_colors(primitive),
            Self::Obj(document) => Ok(document.vertex_colors()),
            Self::Soup(document) => Ok(document.colors().map(<[_]>::to_vec)),
        }
    }

    /// Returns the direction of v in the numbers of the file.
    pub fn v_axis(&self) -> VAxis {
        match self {
            Self::Gltf(_) => VAxis::Down,
            Self::Obj(_) | Self::Soup(_) => VAxis::Up,
        }
    }

    /// Returns the UVs of set `set` per face corner in the numbers of the file; `None` if the primitive has no such
    /// set.
    pub fn corner_uvs(
        &self,
        primitive: usize,
        set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        match self {
            Self::Gltf(document) => document.corner_uvs(primitive, set),
            Self::Obj(document) => document.corner_uvs(primitive, set),
            Self::Soup(document) => document.corner_uvs(primitive, set),
        }
    }

    /// Returns the number of faces that lack UVs in a primitive for which [`corner_uvs`](Self::corner_uvs) has none.
    pub fn faces_without_uvs(&self, primitive: usize) -> usize {
        match self {
            Self::Obj(document) => document.face_uvs().filter(Option::is_none).count(),
            Self::Gltf(_) | Self::Soup(_) => self.primitives()[primitive].triangles.len(),
        }
    }

    /// Leaves out the faces of an OBJ that have no UVs, if others have: they are written as they are. In glTF, whole primitives
    /// have none.
    #[must_use]
    pub fn with_mapped_faces(self) -> Self {
        match self {
            Self::Obj(document) => Self::Obj(document.with_mapped_faces()),
            other => other,
        }
    }

    /// Returns the numbers of the faces that [`with_mapped_faces`](Self::with_mapped_faces) has kept; `None` if all are.
    pub fn kept_faces(&self) -> Option<&[u32]> {
        match self {
            Self::Obj(document) => document.kept_faces(),
            Self::Gltf(_) | Self::Soup(_) => None,
        }
    }

    /// Returns the number of faces that [`with_mapped_faces`](Self::with_mapped_faces) has left out.
    pub fn n_left_out(&self) -> usize {
        match self {
            Self::Obj(document) => document.n_left_out(),
            Self::Gltf(_) | Self::Soup(_) => 0,
        }
    }

    /// Returns for each corner of a primitive's faces the index of its corner of a polygon, and the number of those;
    /// `None` for a file that is not written back with polygons.
    pub fn polygon_corners(&self, primitive: usize) -> Option<(&[[u32; 3]], u32)> {
        match self {
            Self::Obj(document) if primitive == 0 => Some(document.polygon_corners()),
            _ => None,
        }
    }

    /// Returns the normals of a primitive per face corner; `None` if it has none.
    pub fn corner_normals(
        &self,
        primitive: usize,
    ) -> Result<Option<Vec<[[f64; 3]; 3]>>, DocumentError> {
        match self {
            Self::Gltf(document) => document.corner_normals(primitive),
            Self::Obj(document) => Ok(document.corner_normals()),
            Self::Soup(_) => Ok(None),
        }
    }

    /// Reads the mark of the document and compares it with its UVs.
    pub fn marked(&self) -> Result<Marked, DocumentError> {
        Ok(match self.mark().as_ref().map(Mark::parse) {
            None => Marked::Not,
            Some(Some(mark)) if self.fits(&mark)? => Marked::Fits(Box::new(mark)),
            Some(_) => Marked::Stale,
        })
    }

    /// Returns the texture for which a UV set was made, according to the document. Later changes of the UVs do not
    /// change the shape of the texture.
    pub fn texture_of(&self, set: u32) -> Option<Resolution> {
        let mark = Mark::parse(&self.mark()?)?;
        let is_known = (0..self.primitives().len())
            .any(|primitive: usize| mark.sets.of(primitive) == Some(set));
        (is_known && mark.terms.resolution.is_regular()).then_some(mark.terms.resolution)
    }

    /// Returns the value in the place of a mark.
    fn mark(&self) -> Option<Value> {
        match self {
            Self::Gltf(document) => document.mark(),
            Self::Obj(document) => document.mark(),
            Self::Soup(_) => None,
        }
    }

    fn fits(&self, mark: &Mark) -> Result<bool, DocumentError> {
        mark.fits(self.primitives().len(), |primitive, set| {
            self.corner_uvs(primitive, set)
        })
    }

    /// Gives every node that shows a mesh a mesh of its own; other files than glTF have no nodes.
    pub fn with_separate_meshes(self) -> Result<Self, DocumentError> {
        match self {
            Self::Gltf(document) => document.with_separate_meshes().map(Self::Gltf),
            other => Ok(other),
        }
    }

    /// Returns the primitives in the placement of the first node that shows them; mirrored ones are mirrored back.
    pub fn primitives_in_scene(&self) -> Result<Vec<Primitive>, DocumentError> {
        match self {
            Self::Gltf(document) => document.primitives_in_scene(),
            other => Ok(other.primitives().to_vec()),
        }
    }

    /// Cuts the triangles of each primitive into pieces; attributes other than positions are interpolated.
    pub fn subdivided(self, cuts: &[Subdivision]) -> Result<Self, DocumentError> {
        Subdivision::check(cuts, self.primitives())?;
        match self {
            Self::Gltf(document) => document.subdivided(cuts).map(Self::Gltf),
            Self::Obj(_) => Err(DocumentError::Indivisible(
                "the text of an OBJ file".to_owned(),
            )),
            Self::Soup(document) => Ok(Self::Soup(document.subdivided(cuts))),
        }
    }

    /// Moves the triangles of the document by a map: positions, normals and tangents. All else is unchanged; positions
    /// are those of the meshes, before any transform of a node, skin or morph target.
    pub fn moved(self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        Ok(match self {
            Self::Gltf(document) => Self::Gltf(document.moved(map)?),
            Self::Obj(document) => Self::Obj(document.moved(map)?),
            Self::Soup(document) => Self::Soup(document.moved(map)?),
        })
    }
}

impl Written {
    /// Reads the document from the written bytes.
    pub fn read_again(&self) -> Result<Document, DocumentError> {
        let mut files = self.files.iter().cloned();
        let (name, bytes) = files.next().unwrap_or_default();
        Document::read(&Upload {
            name,
            bytes,
            resources: files.collect(),
        })
    }
}

// Files to which an upload refers.

/// Adds the files to which an upload refers, and those to which these refer, as far as `read` finds them. Whether a
/// missing one is needed is decided when the document is read.
pub fn with_references(mut upload: Upload, read: impl Fn(&str) -> Option<Vec<u8>>) -> Upload {
    let mut tried = BTreeSet::new();
    while let new = (references(&upload))
        .difference(&tried)
        .cloned()
        .collect::<Vec<_>>()
        && !new.is_empty()
    {
        for reference in new {
            if let Some(content) = read(&reference) {
                upload.resources.insert(reference.clone(), content);
            }
            tried.insert(reference);
        }
    }
    upload
}

/// Returns the paths to which the main file, and the material files among the others, may refer: those of buffers,
/// images, material files and their pictures. None is absolute or leaves the folder.
pub fn references(upload: &Upload) -> BTreeSet<String> {
    match format_of(upload) {
        Some(Format::Glb | Format::Gltf) => gltf::references(&upload.bytes).into_iter().collect(),
        Some(Format::Obj) => references_of_obj(upload),
        _ => BTreeSet::new(),
    }
}

fn references_of_obj(upload: &Upload) -> BTreeSet<String> {
    let materials = obj::material_paths(&upload.bytes);
    let supplied = (upload.resources.iter()).filter(|(path, _)| materials.contains(*path));
    let pictures: Vec<_> = supplied
        .map(|(path, bytes)| obj::picture_paths(path, bytes))
        .collect();
    materials
        .into_iter()
        .chain(pictures.into_iter().flatten())
        .collect()
}
