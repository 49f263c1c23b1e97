//! A glTF document: read, inspected and moved.

use super::accessor::Accessor;
use super::body::GltfBody;
use super::json::{self, invalid, item, items, unsigned};
use super::links::Origin;
use super::primitives::{self, Collected};
use super::{buffers, compression, extensions, images, marking, scene};
use crate::document::error::{listed, unused_not_finite};
use crate::document::group::Names;
use crate::document::{CornerTangents, DocumentError, Primitive, Upload, Warning};
use crate::io::without_mark;
use serde_json::Value;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use unwrapd_maps::mesh::CornerUvs;

/// Attribute of vertex colors that multiply the base color.
pub(super) const COLOR: &str = "COLOR_0";

/// A glTF document, decompressed.
#[derive(Clone)]
pub struct GltfDocument {
    pub(super) body: GltfBody,
    /// State of the document when it was read.
    pub(super) origin: Origin,
    /// GLB chunks that are neither JSON nor the binary buffer.
    pub(super) chunks: Vec<(u32, Vec<u8>)>,
    /// Files of the upload to which images refer.
    pub(super) resources: BTreeMap<String, Vec<u8>>,
    /// Compression extensions that were decoded on reading.
    pub(super) decompressed: Vec<String>,
    pub(super) primitives: Vec<Primitive>,
    /// For primitives that use a part of shared accessors, the elements that are their vertices, in increasing order.
    pub(super) used: Vec<Option<Vec<u32>>>,
    /// Warnings collected so far.
    pub(super) warnings: Vec<Warning>,
}

impl GltfDocument {
    /// Reads a `.glb` or `.gltf` file; the content determines which.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        // The container and the JSON.
        let container = if buffers::is_glb(&upload.bytes) {
            buffers::split(&upload.bytes)?
        } else {
            buffers::Container {
                json: &upload.bytes,
                bin: None,
                others: Vec::new(),
            }
        };
        let mut json = json::parse(without_mark(container.json))?;
        if !json.is_object() {
            return Err(invalid("the JSON is not an object"));
        }
        extensions::check(&json)?;
        // Buffers in one piece, without compression.
        let origin = Origin::of(&mut json);
        let mut body = buffers::join(json, container.bin, upload)?;
        compression::decompress(&mut body)?;
        let compression = [
            compression::DRACO,
            compression::MESHOPT[0],
            compression::MESHOPT[1],
        ];
        let decompressed = extensions::prune(&mut body.json, &compression)?;
        // Triangles.
        let Collected {
            primitives,
            used,
            n_unused_not_finite,
        } = primitives::collect(&body)?;
        if primitives
            .iter()
            .all(|primitive| primitive.triangles.is_empty())
        {
            return Err(DocumentError::NoTriangles);
        }
        let others = container.others.into_iter();
        Ok(Self {
            chunks: others.map(|(kind, bytes)| (kind, bytes.to_vec())).collect(),
            resources: images::supplied(&body.json, &upload.resources)?,
            body,
            origin,
            decompressed,
            primitives,
            used,
            warnings: unused_not_finite(n_unused_not_finite).into_iter().collect(),
        })
    }

    /// Adds warnings to the document.
    #[must_use]
    pub(in crate::document) fn with_warnings(mut self, warnings: Vec<Warning>) -> Self {
        self.warnings.extend(warnings);
        self
    }

    /// Returns the warnings collected so far.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Returns the triangle primitives in file order.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// Returns the value in the place of a mark.
    pub(in crate::document) fn mark(&self) -> Option<Value> {
        marking::mark(&self.body.json).cloned()
    }

    /// Returns the index of a material with this name, or else with this number.
    pub fn material(&self, name: &str) -> Option<usize> {
        let materials = self.body.json["materials"].as_array()?;
        let named = materials.iter().position(|m| m["name"] == name);
        named.or_else(|| name.parse().ok().filter(|&index| index < materials.len()))
    }

    /// Returns the name of the mesh of a primitive, if it has one.
    pub fn mesh_name(&self, primitive: usize) -> Option<String> {
        let mesh = self.primitives.get(primitive)?.mesh;
        let name = self.body.json["meshes"][mesh]["name"].as_str()?;
        Some(name.to_owned())
    }

    /// Returns the UVs of `TEXCOORD_set` per face corner as stored, v down; `None` if the primitive has no such
    /// attribute.
    pub fn corner_uvs(
        &self,
        primitive: usize,
        set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        let Some(triangles) = self.primitives.get(primitive) else {
            return Ok(None);
        };
        let attributes = &self.object(triangles)?["attributes"];
        let name = format!("TEXCOORD_{set}");
        let Some(index) = unsigned(attributes, &name)? else {
            return Ok(None);
        };
        self.corner_values(primitive, &name, index, "VEC2")
            .map(Some)
    }

    /// Returns the normals per face corner; `None` if the primitive has none.
    pub fn corner_normals(
        &self,
        primitive: usize,
    ) -> Result<Option<Vec<[[f64; 3]; 3]>>, DocumentError> {
        let attributes = &self.object(&self.primitives[primitive])?["attributes"];
        match unsigned(attributes, "NORMAL")? {
            Some(index) => {
                let normals = self.corner_values(primitive, "NORMAL", index, "VEC3");
                normals.map(Some)
            }
            None => Ok(None),
        }
    }

    /// Returns the tangents per face corner; `None` if the primitive has none, or no normals to go with them.
    pub fn corner_tangents(
        &self,
        primitive: usize,
    ) -> Result<Option<Vec<CornerTangents>>, DocumentError> {
        let attributes = &self.object(&self.primitives[primitive])?["attributes"];
        let index = unsigned(attributes, "TANGENT")?.filter(|_| attributes.get("NORMAL").is_some());
        let Some(index) = index else {
            return Ok(None);
        };
        let tangents = self.corner_values(primitive, "TANGENT", index, "VEC4")?;
        let single = tangents
            .iter()
            .map(|face| face.map(|t: [f64; 4]| t.map(|x| x as f32)));
        Ok(Some(single.collect()))
    }

    /// Returns the bytes of an image's file.
    pub fn image(&self, index: usize) -> Result<Cow<'_, [u8]>, DocumentError> {
        images::bytes(&self.body, index, &self.resources)
    }

    /// Returns the numbers of an accessor of `N` components at each face corner.
    fn corner_values<const N: usize>(
        &self,
        primitive: usize,
        name: &str,
        index: usize,
        kind: &str,
    ) -> Result<Vec<[[f64; N]; 3]>, DocumentError> {
        let accessor = Accessor::open(&self.body, index)?;
        if !accessor.is(kind) {
            return Err(invalid(format!("{name} is not of type {kind}")));
        }
        let values = accessor.values()?;
        let used = self.used[primitive].as_deref();
        let faces = self.primitives[primitive].triangles.iter();
        Ok(faces
            .map(|face| {
                face.map(|vertex: u32| {
                    let element = used.map_or(vertex, |used| used[vertex as usize]) as usize;
                    std::array::from_fn(|k| values[N * element + k])
                })
            })
            .collect())
    }

    /// Returns the JSON of a primitive.
    pub(super) fn object(&self, primitive: &Primitive) -> Result<&Value, DocumentError> {
        items(
            item(&self.body.json, "meshes", primitive.mesh)?,
            "primitives",
        )?
        .get(primitive.primitive)
        .ok_or_else(|| invalid("a primitive is gone"))
    }

    /// Reads the triangles again, after the body has changed.
    pub(super) fn collect(&mut self) -> Result<(), DocumentError> {
        let collected = primitives::collect(&self.body)?;
        (self.primitives, self.used) = (collected.primitives, collected.used);
        Ok(())
    }

    /// Returns whether a primitive has vertex colors.
    pub fn has_vertex_colors(&self) -> bool {
        self.primitives.iter().any(|primitive| {
            let object = self.object(primitive);
            object.is_ok_and(|object| object["attributes"].get(COLOR).is_some())
        })
    }

    /// Gives every node that shows a mesh a mesh of its own.
    pub fn with_separate_meshes(mut self) -> Result<Self, DocumentError> {
        scene::separate_meshes(&mut self.body.json)?;
        self.collect()?;
        Ok(self)
    }

    /// Returns the primitives in the placement of the first node that shows them; mirrored ones are mirrored back.
    pub fn primitives_in_scene(&self) -> Result<Vec<Primitive>, DocumentError> {
        let placements = scene::placements(&self.body.json)?;
        Ok(self
            .primitives
            .iter()
            .map(|primitive: &Primitive| {
                let placement = &placements[primitive.mesh];
                let positions = primitive.positions.iter();
                Primitive {
                    positions: positions.map(|p| scene::placed(placement, *p)).collect(),
                    ..primitive.clone()
                }
            })
            .collect())
    }
}

// Names of meshes and materials of a glTF.

/// Most characters of a name that are shown.
const SHOWN: usize = 80;

/// Lists some of the meshes, and the number of further ones.
pub(super) fn listed_meshes(document: &GltfDocument, meshes: &BTreeSet<usize>) -> String {
    let names: Vec<String> = meshes
        .iter()
        .map(|&mesh: &usize| quoted(Names::mesh(document, mesh), "mesh", mesh))
        .collect();
    listed(names.iter().map(String::as_str))
}

/// Returns the name of a material, or its number.
pub(super) fn material_name(document: &GltfDocument, material: usize) -> String {
    quoted(Names::material(document, material), "material", material)
}

/// Returns the name of a material without quotes, or its number.
pub(super) fn plain_material_name(document: &GltfDocument, material: usize) -> String {
    let name = Names::material(document, material);
    name.unwrap_or_else(|| format!("material {material}"))
}

fn quoted(name: Option<String>, kind: &str, index: usize) -> String {
    name.map_or_else(|| format!("{kind} {index}"), |name| format!("`{name}`"))
}

impl Names for GltfDocument {
    fn mesh(&self, index: usize) -> Option<String> {
        self.name_of("meshes", index)
    }

    fn material(&self, index: usize) -> Option<String> {
        self.name_of("materials", index)
    }
}

impl GltfDocument {
    /// Returns a name in a form that fits on a line; `None` if there is nothing to show.
    fn name_of(&self, kind: &str, index: usize) -> Option<String> {
        let name = self.body.json[kind][index]["name"].as_str()?;
        let name: String = name
            .chars()
            .filter(|c| !c.is_control())
            .take(SHOWN)
            .collect();
        let name = name.trim();
        (!name.is_empty()).then(|| name.to_owned())
    }
}
