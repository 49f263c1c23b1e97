//! glTF 2.0, `.glb` and `.gltf`.
//!
//! The document of record is the JSON value itself, with its order and numbers: untouched parts cannot be lost. Reading
//! normalizes it: all buffers are joined into one array of bytes, Draco and meshopt data are decoded into plain
//! accessors. Accessors are read by a reader that checks each against the bytes that really exist. Writing appends: new
//! views and accessors follow the old ones, and the primitives refer to them; accessors that may be shared are never
//! changed. Objects that lose their last reference are then replaced by new ones or removed.
mod accessor;
mod as_obj;
mod bake_plan;
mod baked;
mod body;
mod bounds;
mod buffers;
mod component;
mod draco;
mod extensions;
mod glb;
mod images;
mod json;
mod links;
mod marking;
mod meshopt;
mod mode;
mod moved;
mod names;
mod obj_names;
mod obj_pictures;
mod origin;
mod positions;
mod primitives;
mod references;
mod rewrite;
mod scene;
mod subdivide;
mod tangents;
mod texcoord_set;
mod texture_warnings;
mod textures;
mod tree;
mod uri;
mod vertices;
mod write;

use super::warning::unused_not_finite;
use super::{
    BakePlan, BakedTextures, CornerTangents, DocumentError, Group, Mark, NewUvs, Primitive,
    SpaceMap, Subdivision, Upload, Warning, WriteOptions, Written,
};
use crate::io::without_mark;
pub use references::references;
pub use tangents::tangents;
use unwrapd_maps::mesh::CornerUvs;
pub(in crate::document) use uri::{encoded, normalized};

use accessor::Accessor;
use body::Body;
use json::{invalid, item, items, unsigned};
use origin::Origin;
use primitives::Collected;
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A glTF document, decompressed.
#[derive(Clone)]
pub struct GltfDocument {
    body: Body,
    /// State of the document when it was read.
    origin: Origin,
    /// GLB chunks that are neither JSON nor the binary buffer.
    chunks: Vec<(u32, Vec<u8>)>,
    /// Files of the upload to which images refer.
    resources: BTreeMap<String, Vec<u8>>,
    /// Compression extensions that were decoded on reading.
    decompressed: Vec<String>,
    primitives: Vec<Primitive>,
    /// For primitives that use a part of shared accessors, the elements that are their vertices, in increasing order.
    used: Vec<Option<Vec<u32>>>,
    /// Warnings collected so far.
    warnings: Vec<Warning>,
}

impl GltfDocument {
    /// Reads a `.glb` or `.gltf` file; the content determines which.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        // The container and the JSON.
        let container = if glb::is_glb(&upload.bytes) {
            glb::split(&upload.bytes)?
        } else {
            glb::Container {
                json: &upload.bytes,
                bin: None,
                others: Vec::new(),
            }
        };
        let mut json = tree::parse(without_mark(container.json))?;
        if !json.is_object() {
            return Err(invalid("the JSON is not an object"));
        }
        extensions::check(&json)?;
        // Buffers in one piece, without compression.
        let origin = Origin::of(&mut json);
        let mut body = buffers::join(json, container.bin, upload)?;
        draco::decompress(&mut body)?;
        let compression = [draco::NAME, meshopt::NAMES[0], meshopt::NAMES[1]];
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

    /// Plans the textures to make for new UVs of `groups`; `unreadable` has the reasons why images cannot be read.
    pub fn bake_plan(
        &self,
        groups: &[Group],
        unreadable: &BTreeMap<usize, String>,
    ) -> Result<BakePlan, DocumentError> {
        bake_plan::plan(self, groups, unreadable)
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
        let at = |vertex: u32| {
            let element = used.map_or(vertex, |used| used[vertex as usize]) as usize;
            std::array::from_fn(|k| values[N * element + k])
        };
        let faces = self.primitives[primitive].triangles.iter();
        Ok(faces.map(|face| face.map(at)).collect())
    }

    /// Returns the JSON of a primitive.
    fn object(&self, primitive: &Primitive) -> Result<&Value, DocumentError> {
        items(
            item(&self.body.json, "meshes", primitive.mesh)?,
            "primitives",
        )?
        .get(primitive.primitive)
        .ok_or_else(|| invalid("a primitive is gone"))
    }

    /// Reads the triangles again, after the body has changed.
    fn collect(&mut self) -> Result<(), DocumentError> {
        let collected = primitives::collect(&self.body)?;
        (self.primitives, self.used) = (collected.primitives, collected.used);
        Ok(())
    }

    /// Returns whether a primitive has vertex colors.
    pub fn has_vertex_colors(&self) -> bool {
        self.primitives.iter().any(|primitive| {
            let object = self.object(primitive);
            object.is_ok_and(|object| object["attributes"].get("COLOR_0").is_some())
        })
    }

    /// Cuts the triangles of the document into pieces.
    pub fn subdivided(mut self, cuts: &[Subdivision]) -> Result<Self, DocumentError> {
        let mut body = self.body.clone();
        for (index, cut) in cuts.iter().enumerate() {
            subdivide::subdivide(&self, &mut body, index, cut)?;
        }
        self.body = body;
        self.collect()?;
        Ok(self)
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
        let placed = |primitive: &Primitive| {
            let placement = &placements[primitive.mesh];
            let positions = primitive.positions.iter();
            Primitive {
                positions: positions.map(|p| scene::placed(placement, *p)).collect(),
                ..primitive.clone()
            }
        };
        Ok(self.primitives.iter().map(placed).collect())
    }

    /// Moves the triangles of the document by a map.
    pub fn moved(mut self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        moved::move_surfaces(&mut self.body, &self.primitives, map)?;
        self.collect()?;
        Ok(self)
    }

    /// Writes the document with `uvs` as a `TEXCOORD_n`, and with textures made for them; `mark` is its present mark,
    /// if that fits.
    pub(in crate::document) fn write(
        &self,
        uvs: &NewUvs,
        options: &WriteOptions,
        baked: Option<&BakedTextures>,
        mark: Option<&Mark>,
    ) -> Result<Written, DocumentError> {
        write::write(self, uvs, mark, options, baked)
    }
}
