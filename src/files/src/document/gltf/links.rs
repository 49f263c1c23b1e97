//! References of a document to materials, textures, images, samplers, accessors and buffer views.

use super::body::GltfBody;
use super::json::{array_mut, as_unsigned, items, required, unsigned};
use crate::document::DocumentError;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Collections of objects that can lose their last reference. Objects refer only to objects of later collections.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Collection {
    Materials,
    Textures,
    Images,
    Samplers,
    Accessors,
    BufferViews,
}

/// An object of a collection.
pub(super) type GltfObject = (Collection, usize);

impl Collection {
    pub const ALL: [Self; 6] = [
        Self::Materials,
        Self::Textures,
        Self::Images,
        Self::Samplers,
        Self::Accessors,
        Self::BufferViews,
    ];

    /// Returns the member of the document that holds the collection.
    pub fn key(self) -> &'static str {
        match self {
            Self::Materials => "materials",
            Self::Textures => "textures",
            Self::Images => "images",
            Self::Samplers => "samplers",
            Self::Accessors => "accessors",
            Self::BufferViews => "bufferViews",
        }
    }

    fn of_key(key: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|collection| collection.key() == key)
    }
}

/// Calls `place` for every reference to an object of a collection, with its owner, the object, and the number.
/// References in unknown extensions are left out; `origin.rs` has them.
pub(super) fn visit(
    json: &mut Value,
    place: &mut dyn FnMut(Option<GltfObject>, GltfObject, &mut Value),
) {
    let Some(root) = json.as_object_mut() else {
        return;
    };
    for (key, value) in root {
        let collection = Collection::of_key(key);
        match (collection, value) {
            (Some(collection), Value::Array(objects)) => {
                for (index, object) in objects.iter_mut().enumerate() {
                    let mut visitor = Visitor {
                        owner: Some((collection, index)),
                        place,
                    };
                    visitor.collected(collection, object);
                    visitor.infos_and_extensions(object);
                }
            }
            (_, value) => {
                let mut visitor = Visitor { owner: None, place };
                visitor.core(key, value);
                visitor.member_of(key, value);
            }
        }
    }
}

struct Visitor<'a> {
    owner: Option<GltfObject>,
    place: &'a mut dyn FnMut(Option<GltfObject>, GltfObject, &mut Value),
}

impl Visitor<'_> {
    fn number(&mut self, collection: Collection, value: Option<&mut Value>) {
        if let Some(value) = value
            && let Some(index) = as_unsigned(value)
        {
            (self.place)(self.owner, (collection, index), value);
        }
    }

    fn member(&mut self, collection: Collection, object: &mut Value, key: &str) {
        self.number(collection, object.get_mut(key));
    }

    fn all(&mut self, collection: Collection, values: Option<&mut Value>) {
        children(values).for_each(|value| self.number(collection, Some(value)));
    }

    /// Visits the references of an object of a collection.
    fn collected(&mut self, collection: Collection, object: &mut Value) {
        match collection {
            Collection::Textures => {
                self.member(Collection::Images, object, "source");
                self.member(Collection::Samplers, object, "sampler");
            }
            Collection::Images => self.member(Collection::BufferViews, object, "bufferView"),
            Collection::Accessors => {
                self.member(Collection::BufferViews, object, "bufferView");
                for part in ["indices", "values"] {
                    let view = object.pointer_mut(&format!("/sparse/{part}/bufferView"));
                    self.number(Collection::BufferViews, view);
                }
            }
            Collection::Materials => self.coarser_materials(object),
            Collection::Samplers | Collection::BufferViews => {}
        }
    }

    /// Visits the materials for smaller sizes on the screen. They count as references of the document, since objects
    /// refer only to later collections.
    fn coarser_materials(&mut self, material: &mut Value) {
        let owner = self.owner.take();
        self.all(
            Collection::Materials,
            material.pointer_mut("/extensions/MSFT_lod/ids"),
        );
        self.owner = owner;
    }

    /// Visits the references of another top-level member by the rules of glTF itself.
    fn core(&mut self, key: &str, value: &mut Value) {
        for object in children(Some(value)) {
            match key {
                "meshes" => {
                    children(object.get_mut("primitives")).for_each(|p| self.primitive(p));
                }
                "skins" => self.member(Collection::Accessors, object, "inverseBindMatrices"),
                "animations" => {
                    for sampler in children(object.get_mut("samplers")) {
                        self.member(Collection::Accessors, sampler, "input");
                        self.member(Collection::Accessors, sampler, "output");
                    }
                    for channel in children(object.get_mut("channels")) {
                        let place = "/target/extensions/KHR_animation_pointer/pointer";
                        if let Some(Value::String(pointer)) = channel.pointer_mut(place) {
                            self.material_pointer(pointer);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// Visits the material that a JSON pointer names.
    fn material_pointer(&mut self, pointer: &mut String) {
        let Some((number, rest)) = (pointer.strip_prefix("/materials/"))
            .and_then(|path| path.split_once('/'))
            .and_then(|(number, rest)| Some((number.parse::<usize>().ok()?, rest)))
        else {
            return;
        };
        let mut value = json!(number);
        self.number(Collection::Materials, Some(&mut value));
        *pointer = format!("/materials/{value}/{rest}");
    }

    fn primitive(&mut self, primitive: &mut Value) {
        self.member(Collection::Materials, primitive, "material");
        self.member(Collection::Accessors, primitive, "indices");
        self.all(Collection::Accessors, primitive.get_mut("attributes"));
        for target in children(primitive.get_mut("targets")) {
            self.all(Collection::Accessors, Some(target));
        }
    }

    /// Visits texture infos and extensions at any depth, which the parser of the document bounds.
    fn infos_and_extensions(&mut self, value: &mut Value) {
        match value {
            Value::Array(items) => items.iter_mut().for_each(|v| self.infos_and_extensions(v)),
            Value::Object(members) => {
                for (key, child) in members {
                    self.member_of(key, child);
                }
            }
            _ => {}
        }
    }

    /// Visits a member of any object.
    fn member_of(&mut self, key: &str, child: &mut Value) {
        match (key, &mut *child) {
            ("extras", _) => return,
            ("extensions", Value::Object(extensions)) => {
                for (name, extension) in extensions {
                    self.extension(name, extension);
                }
            }
            _ if names_texture(key) => {
                self.member(Collection::Textures, child, "index");
            }
            _ => {}
        }
        self.infos_and_extensions(child);
    }

    /// Visits the references of an extension other than texture infos.
    fn extension(&mut self, name: &str, extension: &mut Value) {
        match name {
            "KHR_draco_mesh_compression" => {
                self.member(Collection::BufferViews, extension, "bufferView");
            }
            "EXT_mesh_gpu_instancing" => {
                self.all(Collection::Accessors, extension.get_mut("attributes"));
            }
            "KHR_materials_variants" => {
                for mapping in children(extension.get_mut("mappings")) {
                    self.member(Collection::Materials, mapping, "material");
                }
            }
            "CESIUM_primitive_outline" => self.member(Collection::Accessors, extension, "indices"),
            "EXT_mesh_manifold" => {
                if let Some(primitive) = extension.get_mut("manifoldPrimitive") {
                    self.primitive(primitive);
                }
                self.member(Collection::Accessors, extension, "mergeIndices");
                self.member(Collection::Accessors, extension, "mergeValues");
            }
            "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
                self.member(Collection::Images, extension, "source");
            }
            "EXT_lights_image_based" => {
                for light in children(extension.get_mut("lights")) {
                    for faces in children(light.get_mut("specularImages")) {
                        self.all(Collection::Images, Some(faces));
                    }
                }
            }
            "EXT_structural_metadata" => self.metadata(extension),
            _ => {}
        }
    }

    fn metadata(&mut self, extension: &mut Value) {
        for table in children(extension.get_mut("propertyTables")) {
            for property in children(table.get_mut("properties")) {
                for key in ["values", "arrayOffsets", "stringOffsets"] {
                    self.member(Collection::BufferViews, property, key);
                }
            }
        }
        for texture in children(extension.get_mut("propertyTextures")) {
            let properties = texture.get_mut("properties").and_then(Value::as_object_mut);
            for (key, property) in properties.into_iter().flatten() {
                // Others are texture infos by their names.
                if !names_texture(key) {
                    self.member(Collection::Textures, property, "index");
                }
            }
        }
    }
}

/// Iterates over the elements of an array or the values of an object.
fn children(value: Option<&mut Value>) -> Box<dyn Iterator<Item = &mut Value> + '_> {
    let Some(value) = value else {
        return Box::new(std::iter::empty());
    };
    match value {
        Value::Array(items) => Box::new(items.iter_mut()),
        Value::Object(members) => Box::new(members.values_mut()),
        _ => Box::new(std::iter::empty()),
    }
}

/// Returns whether a member of this name is a texture info.
fn names_texture(key: &str) -> bool {
    key.to_ascii_lowercase().ends_with("texture")
}

// References of a document when it was read, and removal of objects that have lost theirs.

/// State of a document when it was read.
#[derive(Debug, Clone)]
pub(super) struct Origin {
    /// Objects without a reference at that time: they stay unchanged.
    unused: BTreeSet<GltfObject>,
    /// Number of objects per collection at that time.
    lengths: BTreeMap<Collection, usize>,
}

/// For each object its new index; `None` if it is removed.
#[derive(Debug, Default)]
pub(super) struct NewIndices(BTreeMap<Collection, Vec<Option<usize>>>);

impl NewIndices {
    /// Returns the new index of an object; its present one by default.
    pub fn of(&self, (collection, index): GltfObject) -> usize {
        let places = self.0.get(&collection);
        let place = places.and_then(|places| *places.get(index)?);
        place.unwrap_or(index)
    }
}

impl Origin {
    pub fn of(json: &mut Value) -> Self {
        let lengths = lengths(json);
        let live = live(json, &BTreeSet::new(), &BTreeSet::new());
        let unused = objects(&lengths).filter(|object| !live.contains(object));
        Self {
            unused: unused.collect(),
            lengths,
        }
    }

    /// Removes objects that were referenced when the document was read, or were created since, and are not referenced
    /// now, with their bytes. Returns the new indices of the others. New objects take the places of removed ones;
    /// objects to which unknown extensions may refer keep their places.
    pub fn clean(&self, body: &mut GltfBody) -> Result<NewIndices, DocumentError> {
        let unknown = Unknown::of(&body.json);
        let pinned: BTreeSet<GltfObject> = (Collection::ALL.into_iter())
            .flat_map(|collection| unknown.numbers.iter().map(move |&n| (collection, n)))
            .filter(|(collection, n)| n < &self.lengths[collection])
            .collect();
        let lengths = lengths(&body.json);
        let mut kept = self.unused.clone();
        // Objects that have to stay only because others must keep their indices may name more that has to stay.
        let places = loop {
            let live = live(&mut body.json, &kept, &pinned);
            let (places, held) = self.places(&lengths, &live, &pinned);
            if held.is_empty() {
                break places;
            }
            kept.extend(held);
        };
        let gone = objects(&lengths).any(|(collection, n)| places.0[&collection][n].is_none());
        if !gone {
            return Ok(places);
        }
        move_objects(&mut body.json, &places);
        if !unknown.buffers {
            repack_bytes(body)?;
        }
        Ok(places)
    }

    /// Returns the new indices of all objects, and those that are not live but cannot be removed.
    fn places(
        &self,
        lengths: &BTreeMap<Collection, usize>,
        live: &BTreeSet<GltfObject>,
        pinned: &BTreeSet<GltfObject>,
    ) -> (NewIndices, Vec<GltfObject>) {
        let (mut places, mut held) = (NewIndices::default(), Vec::new());
        for collection in Collection::ALL {
            let old = self.lengths[&collection];
            let is_live = |n: &usize| live.contains(&(collection, *n));
            let mut order: Vec<Option<usize>> = (0..old).map(|n| Some(n).filter(is_live)).collect();
            // Put new objects in the places of removed ones, and the others at the end.
            let mut new = (old..lengths[&collection]).filter(is_live);
            for slot in order.iter_mut().filter(|slot| slot.is_none()) {
                *slot = new.next();
            }
            order.extend(new.map(Some));
            // Nothing before an object that may be named by its index can go.
            let last = pinned
                .range((collection, 0)..=(collection, usize::MAX))
                .last();
            let fixed = last.map_or(0, |(_, n)| n + 1).min(order.len());
            let empty = (0..fixed).filter(|&n| order[n].is_none());
            held.extend(empty.map(|n| (collection, n)));
            // Number the objects that remain.
            let mut to = vec![None; lengths[&collection]];
            for (place, from) in order.into_iter().flatten().enumerate() {
                to[from] = Some(place);
            }
            places.0.insert(collection, to);
        }
        (places, held)
    }
}

fn lengths(json: &Value) -> BTreeMap<Collection, usize> {
    let length = |collection: Collection| json[collection.key()].as_array().map_or(0, Vec::len);
    Collection::ALL
        .map(|c| (c, length(c)))
        .into_iter()
        .collect()
}

fn objects(lengths: &BTreeMap<Collection, usize>) -> impl Iterator<Item = GltfObject> {
    let all = lengths.iter();
    all.flat_map(|(&collection, &n)| (0..n).map(move |index| (collection, index)))
}

/// Returns all objects that are referenced by the rest of the document, by `kept`, or by objects so referenced.
fn live(
    json: &mut Value,
    kept: &BTreeSet<GltfObject>,
    pinned: &BTreeSet<GltfObject>,
) -> BTreeSet<GltfObject> {
    let mut live: BTreeSet<GltfObject> = kept.union(pinned).copied().collect();
    let mut names = Vec::new();
    visit(json, &mut |owner, object, _| match owner {
        None => drop(live.insert(object)),
        Some(owner) => names.push((owner, object)),
    });
    // Objects name only those of later collections, so that one pass in their order finds all.
    names.sort_unstable();
    for (owner, object) in names {
        if live.contains(&owner) {
            live.insert(object);
        }
    }
    live
}

/// Moves objects to their new indices, and updates all references.
fn move_objects(json: &mut Value, places: &NewIndices) {
    visit(json, &mut |_, object, number| {
        let place = places.of(object);
        if place != object.1 {
            *number = json!(place);
        }
    });
    for (collection, places) in &places.0 {
        let Some(Value::Array(objects)) = json.get_mut(collection.key()) else {
            continue;
        };
        let moved = places.iter().zip(std::mem::take(objects));
        let mut moved: Vec<(usize, Value)> = moved
            .filter_map(|(place, object)| Some(((*place)?, object)))
            .collect();
        moved.sort_unstable_by_key(|(place, _)| *place);
        objects.extend(moved.into_iter().map(|(_, object)| object));
        // An array without an element is no glTF.
        if objects.is_empty() && !places.is_empty() {
            super::json::remove(json, collection.key());
        }
    }
}

// Compaction of the binary data to the bytes of its buffer views.

/// Alignment of accessors in bytes, sufficient for all components.
const ALIGNMENT: usize = 4;

/// Removes the bytes that lie in no buffer view. Views that overlap still do so.
fn repack_bytes(body: &mut GltfBody) -> Result<(), DocumentError> {
    // Sort the ranges of all views.
    let mut ranges = Vec::new();
    for (index, view) in items(&body.json, "bufferViews")?.iter().enumerate() {
        let start = unsigned(view, "byteOffset")?.unwrap_or(0);
        ranges.push((start, start + required(view, "byteLength")?, index));
    }
    if ranges.is_empty() {
        return Ok(());
    }
    ranges.sort_unstable();
    // Copy each run of overlapping views at once, so that they still share their bytes.
    let old = std::mem::take(&mut body.bin);
    let mut offsets = vec![0; ranges.len()];
    let mut rest = ranges.as_slice();
    while let [(start, mut end, _), ..] = *rest {
        let mut n_joined = 0;
        while let Some((next, next_end, _)) = rest.get(n_joined)
            && (n_joined == 0 || *next < end)
        {
            end = end.max(*next_end);
            n_joined += 1;
        }
        let (joined, others) = rest.split_at(n_joined);
        rest = others;
        let base = body.bin.len().next_multiple_of(ALIGNMENT) + start % ALIGNMENT;
        body.bin.resize(base, 0);
        body.bin
            .extend_from_slice(old.get(start..end).unwrap_or_default());
        for (begin, _, index) in joined {
            offsets[*index] = base + begin - start;
        }
    }
    // Write the new offsets.
    let views = array_mut(&mut body.json, "bufferViews")?;
    for (view, offset) in views.iter_mut().zip(offsets) {
        if offset > 0 || view.get("byteOffset").is_some() {
            view["byteOffset"] = json!(offset);
        }
    }
    Ok(())
}

// Possible references of unknown extensions.

/// Extensions without references to any of the collections, except in texture infos.
const PLAIN: [&str; 8] = [
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
    "KHR_node_visibility",
    "EXT_mesh_features",
    "MSFT_lod",
];

/// Returns whether [`visit`] finds all references of an extension.
fn is_understood(name: &str) -> bool {
    const NAMING: [&str; 11] = [
        "KHR_draco_mesh_compression",
        "EXT_mesh_gpu_instancing",
        "CESIUM_primitive_outline",
        "EXT_mesh_manifold",
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "EXT_texture_avif",
        "MSFT_texture_dds",
        "EXT_lights_image_based",
        "EXT_structural_metadata",
        "EXT_meshopt_compression",
    ];
    name.starts_with("KHR_materials_")
        || name == "KHR_meshopt_compression"
        || PLAIN.contains(&name)
        || NAMING.contains(&name)
}

/// Possible references of unknown extensions.
#[derive(Default)]
struct Unknown {
    /// All whole numbers in them: each may be the index of anything.
    pub numbers: BTreeSet<usize>,
    /// `true` if they have a member `buffer`, and so may refer to places in the binary data.
    pub buffers: bool,
}

impl Unknown {
    pub fn of(json: &Value) -> Self {
        let mut unknown = Self::default();
        unknown.search(json, false);
        unknown
    }

    fn search(&mut self, value: &Value, is_inside: bool) {
        match value {
            Value::Array(items) => items.iter().for_each(|item| self.search(item, is_inside)),
            Value::Object(members) => {
                for (key, child) in members {
                    self.buffers |= is_inside && key == "buffer";
                    match child {
                        _ if key == "extras" => {}
                        Value::Object(extensions) if key == "extensions" => {
                            for (name, extension) in extensions {
                                self.search(extension, is_inside || !is_understood(name));
                            }
                        }
                        _ => self.search(child, is_inside),
                    }
                }
            }
            number if is_inside => self.numbers.extend(as_unsigned(number)),
            _ => {}
        }
    }
}
