//! Choice of the materials that can be merged.
//!
//! [`Replacement`](super::replacement::Replacement) draws factors and textures anew for the atlas. Everything else
//! (alpha mode, culling, extensions, filtering) belongs to a material as a whole, so materials that differ in it stay
//! apart.

use super::document::{self, GltfDocument};
use super::images;
use super::json::{as_unsigned, extension, item, items};
use super::replacement::{EMISSIVE_STRENGTH, number};
use super::slots::{ANISOTROPY, Slot, slots, users};
use super::textures::materials;
use crate::document::bake::is_nearest;
use crate::document::{ApartMaterial, DocumentError, MergePlan, MergedMaterial};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};

impl GltfDocument {
    /// Plans which of the materials that each request names become one. `unreadable` has the reasons why images cannot
    /// be read.
    pub fn merge_plan(
        &self,
        requested: &[MergedMaterial],
        unreadable: &BTreeMap<usize, String>,
    ) -> Result<MergePlan, DocumentError> {
        let all: Vec<usize> = (0..self.primitives.len()).collect();
        let users = users(self, &all)?;
        let first_of_equals = images::first_of_equals(&self.body, &self.resources)?;
        let slots = slots(self, &users, &first_of_equals, unreadable);
        let in_variants = materials_of_variants(self)?;
        let mut plan = MergePlan::default();
        for request in requested {
            let mut buckets: Vec<Bucket> = Vec::new();
            for &material in request.members.iter().filter(|m| users.contains_key(m)) {
                let object = item(&self.body.json, "materials", material)?;
                let obstacle = if in_variants.contains(&material) {
                    Some("it belongs to a variant of a surface".to_owned())
                } else {
                    obstacle(&self.body.json, material, object, &slots[&material])
                };
                match obstacle {
                    Some(reason) => plan.apart.push(apart(self, material, reason)),
                    None => {
                        Bucket::assign(&mut buckets, material, traits(object, &slots[&material]));
                    }
                }
            }
            plan_request(self, &mut plan, &request.name, buckets);
        }
        plan.apart.sort_by_key(|apart| apart.material);
        Ok(plan)
    }

    /// Returns the number of materials.
    pub fn n_materials(&self) -> usize {
        self.body.json["materials"].as_array().map_or(0, Vec::len)
    }
}

/// Adds the materials of one request: one for each kind that has several members, the most frequent kind first.
fn plan_request(document: &GltfDocument, plan: &mut MergePlan, name: &str, buckets: Vec<Bucket>) {
    let mut buckets = buckets;
    buckets.sort_by_key(|bucket| std::cmp::Reverse(bucket.members.len()));
    // Name what keeps materials from the largest bucket.
    if let [main, others @ ..] = buckets.as_slice() {
        if let ([alone], []) = (main.members.as_slice(), others) {
            let reason = "there is no other material to merge it with".to_owned();
            plan.apart.push(apart(document, *alone, reason));
        }
        for bucket in others {
            let differing = main.traits.differences(&bucket.traits).join(", ");
            for &material in &bucket.members {
                let of = document::material_name(document, main.members[0]);
                let reason = format!("{differing}: not as in {of}");
                plan.apart.push(apart(document, material, reason));
            }
        }
    }
    let several = buckets
        .into_iter()
        .filter(|bucket| bucket.members.len() > 1);
    for (number, bucket) in (1..).zip(several) {
        let name = match number {
            1 => name.to_owned(),
            number => format!("{name}_{number}"),
        };
        let members = bucket.members;
        plan.merged.push(MergedMaterial { name, members });
    }
}

fn apart(document: &GltfDocument, material: usize, reason: String) -> ApartMaterial {
    ApartMaterial {
        material,
        name: document::plain_material_name(document, material),
        reason,
    }
}

/// Returns the materials that variants can give to a surface.
fn materials_of_variants(document: &GltfDocument) -> Result<BTreeSet<usize>, DocumentError> {
    let mut found = BTreeSet::new();
    for mesh in items(&document.body.json, "meshes")? {
        for primitive in items(mesh, "primitives")? {
            if extension(primitive, "KHR_materials_variants").is_some() {
                let own = primitive.get("material").and_then(as_unsigned);
                found.extend(materials(own, primitive)?);
            }
        }
    }
    Ok(found)
}

/// Returns the reason why a material cannot be merged with any other.
fn obstacle(json: &Value, material: usize, object: &Value, slots: &[Slot]) -> Option<String> {
    if is_animated(json, material) {
        return Some("it is animated".to_owned());
    }
    if extension(object, ANISOTROPY).is_some() {
        return Some("it is anisotropic".to_owned());
    }
    let failed = slots.iter().find_map(|slot| {
        let reason = slot.resampled.as_ref().err()?;
        Some((&slot.texture.slot, reason))
    });
    failed.map(|(slot, reason)| format!("{slot} cannot be resampled: {reason}"))
}

/// Returns whether an animation changes a member of a material.
fn is_animated(json: &Value, material: usize) -> bool {
    let place = format!("/materials/{material}/");
    let animations = json.get("animations").and_then(Value::as_array);
    let channels = (animations.into_iter().flatten())
        .filter_map(|animation| animation.get("channels")?.as_array())
        .flatten();
    channels
        .filter_map(|channel| extension(channel.get("target")?, "KHR_animation_pointer"))
        .filter_map(|target| target.get("pointer")?.as_str())
        .any(|pointer| pointer.starts_with(&place))
}

/// Properties in which materials must agree to be merged.
struct Traits {
    /// Values by name; extensions without the places of their textures.
    values: BTreeMap<String, Value>,
    /// Filtering of the textures; `None` without textures, which go with any.
    filtering: Option<Filtering>,
}

/// Filtering that is seen: an atlas with mip levels blurs small text that had none, and one without flickers.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Filtering {
    /// `true` if a texture shows enlarged texels without interpolation.
    is_nearest: bool,
    /// `true` if all textures use mip levels.
    has_mip_levels: bool,
}

/// Materials that can be one.
struct Bucket {
    members: Vec<usize>,
    traits: Traits,
}

impl Bucket {
    /// Adds a material to the first bucket whose members agree with it, or to a new one.
    fn assign(buckets: &mut Vec<Self>, material: usize, traits: Traits) {
        let mut known = buckets.iter_mut();
        match known.find(|bucket| bucket.traits.differences(&traits).is_empty()) {
            Some(bucket) => {
                bucket.members.push(material);
                bucket.traits.filtering = bucket.traits.filtering.or(traits.filtering);
            }
            None => buckets.push(Self {
                members: vec![material],
                traits,
            }),
        }
    }
}

impl Traits {
    /// Returns the names of the properties that differ.
    fn differences(&self, other: &Self) -> Vec<String> {
        let names: BTreeSet<&String> = self.values.keys().chain(other.values.keys()).collect();
        let mut differing: Vec<String> = (names.into_iter())
            .filter(|name| self.values.get(*name) != other.values.get(*name))
            .cloned()
            .collect();
        if let (Some(a), Some(b)) = (self.filtering, other.filtering) {
            let filters = [
                ("magFilter", a.is_nearest != b.is_nearest),
                ("minFilter", a.has_mip_levels != b.has_mip_levels),
            ];
            let unequal = filters.into_iter().filter(|(_, differs)| *differs);
            differing.extend(unequal.map(|(name, _)| name.to_owned()));
        }
        differing
    }
}

/// Collects the traits of a material: all members except those that merging draws into textures.
fn traits(object: &Value, slots: &[Slot]) -> Traits {
    const DRAWN: [&str; 8] = [
        "name",
        "extras",
        "extensions",
        "pbrMetallicRoughness",
        "normalTexture",
        "occlusionTexture",
        "emissiveTexture",
        "emissiveFactor",
    ];
    let alpha_mode = object.get("alphaMode").cloned();
    let alpha_mode = alpha_mode.unwrap_or_else(|| json!("OPAQUE"));
    let mut values = BTreeMap::new();
    for (name, value) in object.as_object().into_iter().flatten() {
        if !DRAWN.contains(&name.as_str()) {
            values.insert(name.clone(), without_textures(value));
        }
    }
    // Members with defaults, and one that has a meaning in one mode only.
    values.remove("alphaCutoff");
    if alpha_mode == "MASK" {
        let cutoff = number(object, "/alphaCutoff", 0.5);
        values.insert("alphaCutoff".to_owned(), json!(cutoff));
    }
    values.insert("alphaMode".to_owned(), alpha_mode);
    let is_double_sided = object.get("doubleSided") == Some(&json!(true));
    values.insert("doubleSided".to_owned(), json!(is_double_sided));
    let extensions = object.get("extensions").and_then(Value::as_object);
    for (name, value) in extensions.into_iter().flatten() {
        if name != EMISSIVE_STRENGTH {
            values.insert(name.clone(), without_textures(value));
        }
    }
    let resampled = slots.iter().filter_map(|slot| slot.resampled.as_ref().ok());
    let filters: Vec<_> = resampled.map(|resampled| resampled.filters).collect();
    let filtering = Filtering {
        is_nearest: filters.iter().any(|filters| is_nearest(*filters)),
        has_mip_levels: filters.iter().all(has_mip_levels),
    };
    Traits {
        values,
        filtering: (!filters.is_empty()).then_some(filtering),
    }
}

/// Returns a value without the images and places of its texture infos, and with all numbers as floating-point ones.
fn without_textures(value: &Value) -> Value {
    match value {
        Value::Number(number) => json!(number.as_f64()),
        Value::Array(items) => items.iter().map(without_textures).collect(),
        Value::Object(members) => {
            let is_info = members.contains_key("index");
            let place = |name: &str| is_info && ["index", "texCoord", "extensions"].contains(&name);
            let kept = members
                .iter()
                .filter(|(name, _)| !place(name) && *name != "extras");
            let kept = kept.map(|(name, value)| (name.clone(), without_textures(value)));
            Value::Object(kept.collect::<Map<String, Value>>())
        }
        other => other.clone(),
    }
}

/// Returns whether a sampler with these filters uses mip levels, as renderers do by default.
fn has_mip_levels([_, min]: &[Option<usize>; 2]) -> bool {
    // `NEAREST` and `LINEAR` of WebGL, the only filters without.
    !matches!(min, Some(9728 | 9729))
}
