//! References of a document when it was read, and removal of objects that have lost theirs.

use super::body::Body;
use super::json::{array_mut, as_unsigned, items, required, unsigned};
use super::links::{Collection, Object, visit};
use crate::document::DocumentError;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// State of a document when it was read.
#[derive(Debug, Clone)]
pub(super) struct Origin {
    /// Objects without a reference at that time: they stay unchanged.
    unused: BTreeSet<Object>,
    /// Number of objects per collection at that time.
    lengths: BTreeMap<Collection, usize>,
}

/// For each object its new index; `None` if it is removed.
#[derive(Debug, Default)]
pub(super) struct Places(BTreeMap<Collection, Vec<Option<usize>>>);

impl Places {
    /// Returns the new index of an object; its present one by default.
    pub fn of(&self, (collection, index): Object) -> usize {
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
    pub fn clean(&self, body: &mut Body) -> Result<Places, DocumentError> {
        let unknown = Unknown::of(&body.json);
        let pinned: BTreeSet<Object> = (Collection::ALL.into_iter())
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
        live: &BTreeSet<Object>,
        pinned: &BTreeSet<Object>,
    ) -> (Places, Vec<Object>) {
        let (mut places, mut held) = (Places::default(), Vec::new());
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

fn objects(lengths: &BTreeMap<Collection, usize>) -> impl Iterator<Item = Object> {
    let all = lengths.iter();
    all.flat_map(|(&collection, &n)| (0..n).map(move |index| (collection, index)))
}

/// Returns all objects that are referenced by the rest of the document, by `kept`, or by objects so referenced.
fn live(json: &mut Value, kept: &BTreeSet<Object>, pinned: &BTreeSet<Object>) -> BTreeSet<Object> {
    let mut live: BTreeSet<Object> = kept.union(pinned).copied().collect();
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
fn move_objects(json: &mut Value, places: &Places) {
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
fn repack_bytes(body: &mut Body) -> Result<(), DocumentError> {
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
