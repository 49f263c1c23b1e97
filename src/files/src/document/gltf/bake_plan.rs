//! Choice of the textures to make for new UVs.

use super::document::GltfDocument;
use super::images;
use super::json::{extension, item, unsigned};
use super::merge::Look;
use super::textures::{MaterialTextures, TRANSFORM, TextureUse, materials};
use crate::document::bake::{MaterialPlanes, MergedPlanes};
use crate::document::{
    BakePlan, BakePlane, DocumentError, Encoding, Group, KeptTexture, MergePlan, PlaneSource,
    TextureSource, Tint, Wrap,
};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Extension with directions of anisotropy, which are relative to tangents: they turn with the UVs.
pub(super) const ANISOTROPY: &str = "KHR_materials_anisotropy";

/// A texture of a material, with the way to resample it or the reason why that is impossible.
pub(super) struct Slot {
    pub texture: TextureUse,
    pub resampled: Result<Resampled, String>,
}

/// Indices of primitives by their materials, including those of variants.
pub(super) type Users = BTreeMap<usize, BTreeSet<usize>>;

impl GltfDocument {
    /// Plans the textures to make for new UVs of `groups`, and the materials to merge; `unreadable` has the reasons why
    /// images cannot be read.
    pub fn bake_plan(
        &self,
        groups: &[Group],
        merge: Option<&MergePlan>,
        unreadable: &BTreeMap<usize, String>,
    ) -> Result<BakePlan, DocumentError> {
        // Find the textures of every material that a group uses.
        let all: Vec<usize> = (groups.iter().flat_map(|group| &group.primitives))
            .copied()
            .collect();
        let users = users(self, &all)?;
        let first_of_equals = images::first_of_equals(&self.body, &self.resources)?;
        let mut slots = slots(self, &users, &first_of_equals, unreadable);
        keep_frames_together(&users, &mut slots);
        // Separate the materials to merge.
        let merged = merge.map_or(&[][..], |merge| &merge.merged);
        let looks: Vec<Look> = (merged.iter())
            .map(|merged| Look::new(self, merged, &slots))
            .collect::<Result<_, _>>()?;
        let members = merged.iter().flat_map(|merged| &merged.members);
        let replaced: BTreeMap<usize, Vec<Slot>> = members
            .filter_map(|member| slots.remove_entry(member))
            .collect();
        // List the textures that stay, then plan those of each group.
        let mut plan = BakePlan {
            kept: kept(self, &slots)?,
            merge: merge.cloned(),
            ..BakePlan::default()
        };
        let infos = replaced.values().flatten();
        (plan.replaced).extend(infos.map(|slot| slot.texture.pointer.clone()));
        for (number, group) in groups.iter().enumerate() {
            let group = PlannedGroup {
                number,
                name: &group.name,
                members: group.primitives.iter().copied().collect(),
                first: plan.planes.len(),
            };
            for (number, (merged, look)) in merged.iter().zip(&looks).enumerate() {
                let of_look = |primitive: &usize| {
                    let material = self.primitives[*primitive].material?;
                    merged
                        .members
                        .contains(&material)
                        .then_some((*primitive, material))
                };
                let primitives = group.members.iter().filter_map(of_look).collect();
                group.plan_merged(&mut plan, number, look, &primitives);
            }
            group.plan_others(&mut plan, &users, &slots);
        }
        Ok(plan)
    }
}

/// Returns the primitives, of some, that have each material.
pub(super) fn users(document: &GltfDocument, primitives: &[usize]) -> Result<Users, DocumentError> {
    let mut users = Users::new();
    for &index in primitives {
        let primitive = &document.primitives[index];
        for material in materials(primitive.material, document.object(primitive)?)? {
            users.entry(material).or_default().insert(index);
        }
    }
    Ok(users)
}

/// Returns the textures of all materials that some primitives have.
pub(super) fn slots(
    document: &GltfDocument,
    users: &Users,
    first_of_equals: &[usize],
    unreadable: &BTreeMap<usize, String>,
) -> BTreeMap<usize, Vec<Slot>> {
    let of_material = |&material: &usize| {
        let slots = slots_of(document, material, first_of_equals, unreadable);
        (material, slots)
    };
    users.keys().map(of_material).collect()
}

fn slots_of(
    document: &GltfDocument,
    material: usize,
    first_of_equals: &[usize],
    unreadable: &BTreeMap<usize, String>,
) -> Vec<Slot> {
    let json = &document.body.json;
    let is_anisotropic = json
        .pointer(&format!("/materials/{material}"))
        .is_some_and(|object| extension(object, ANISOTROPY).is_some());
    let textures = MaterialTextures::of_material(json, material).uses;
    let slot = |texture: TextureUse| {
        let resampled = Resampled::of(json, &texture).and_then(|mut resampled| {
            // Images of equal bytes are decoded once, and resampled once where they are shown alike.
            let image = &mut resampled.source.image;
            *image = first_of_equals.get(*image).copied().unwrap_or(*image);
            match unreadable.get(&resampled.source.image) {
                Some(reason) => Err(reason.clone()),
                None if is_anisotropic => Err("its material is anisotropic".to_owned()),
                None => Ok(resampled),
            }
        });
        Slot { texture, resampled }
    };
    textures.into_iter().map(slot).collect()
}

/// Keeps all normal maps of the primitives of a kept one: a primitive has only one tangent per vertex.
fn keep_frames_together(users: &Users, slots: &mut BTreeMap<usize, Vec<Slot>>) {
    loop {
        let keeps = |material: &usize| {
            slots[material]
                .iter()
                .any(|slot| slot.texture.is_normal_map && slot.resampled.is_err())
        };
        let held: BTreeSet<usize> = (users.iter().filter(|(material, _)| keeps(material)))
            .flat_map(|(_, primitives)| primitives.iter().copied())
            .collect();
        let mut changed = false;
        for (material, slots) in &mut *slots {
            if users[material].is_disjoint(&held) {
                continue;
            }
            for slot in slots
                .iter_mut()
                .filter(|slot: &&mut Slot| slot.texture.is_normal_map && slot.resampled.is_ok())
            {
                slot.resampled =
                    Err("another normal map of its surface is not resampled".to_owned());
                changed = true;
            }
        }
        if !changed {
            return;
        }
    }
}

fn kept(
    document: &GltfDocument,
    slots: &BTreeMap<usize, Vec<Slot>>,
) -> Result<Vec<KeptTexture>, DocumentError> {
    let mut kept = BTreeSet::new();
    let mut keep = |texture: &TextureUse, reason: &str| {
        kept.insert(KeptTexture {
            material: texture.material,
            slot: texture.slot.clone(),
            reason: reason.to_owned(),
        })
    };
    for slot in slots.values().flatten() {
        if let Err(reason) = &slot.resampled {
            keep(&slot.texture, reason);
        }
    }
    for primitive in &document.primitives {
        for texture in MaterialTextures::of_primitive(primitive, document.object(primitive)?).uses {
            keep(&texture, "it belongs to the primitive, not to a material");
        }
    }
    Ok(kept.into_iter().collect())
}

/// A group whose textures are planned.
struct PlannedGroup<'a> {
    number: usize,
    name: &'a str,
    /// Indices of its primitives.
    members: BTreeSet<usize>,
    /// Index of its first plane.
    first: usize,
}

impl PlannedGroup<'_> {
    /// Adds the textures of a merged material for `primitives` of the group, which have these materials.
    fn plan_merged(
        &self,
        plan: &mut BakePlan,
        merged: usize,
        look: &Look,
        primitives: &BTreeMap<usize, usize>,
    ) {
        if primitives.is_empty() {
            return;
        }
        let mut slots = Vec::new();
        for drawn in &look.planes {
            let sources = primitives.iter();
            let wanted = BakePlane {
                name: format!("{}_{}", self.name, word(&drawn.slots[0])),
                group: self.number,
                encoding: drawn.encoding,
                filters: drawn.filters,
                sources: sources
                    .map(|(&primitive, material)| (primitive, drawn.sources[material].clone()))
                    .collect(),
            };
            let plane = joined(&mut plan.planes, self.first, wanted);
            slots.extend(drawn.slots.iter().map(|slot| (slot.clone(), plane)));
            if drawn.encoding == Encoding::Normal {
                plan.normal_mapped.extend(primitives.keys());
            }
        }
        plan.merged.push(MergedPlanes {
            merged,
            primitives: primitives.keys().copied().collect(),
            material: look.material.clone(),
            slots,
        });
    }

    /// Adds the textures of the other materials: for each slot one texture for all materials, as long as no surface has
    /// two of them.
    fn plan_others(&self, plan: &mut BakePlan, users: &Users, slots: &BTreeMap<usize, Vec<Slot>>) {
        for (&material, slots) in slots {
            // Skip materials that no primitive of the group uses.
            let primitives: BTreeSet<usize> = (users[&material].intersection(&self.members))
                .copied()
                .collect();
            if primitives.is_empty() {
                continue;
            }
            // Assign each texture of the material that can be resampled to a plane.
            let mut planes = Vec::new();
            for slot in slots {
                let Ok(resampled) = &slot.resampled else {
                    continue;
                };
                let source = PlaneSource {
                    texture: Some(resampled.source.clone()),
                    tint: Tint::NONE,
                };
                let wanted = BakePlane {
                    name: format!("{}_{}", self.name, word(&slot.texture.slot)),
                    group: self.number,
                    encoding: resampled.encoding,
                    filters: resampled.filters,
                    sources: primitives.iter().map(|&p| (p, source.clone())).collect(),
                };
                planes.push((
                    slot.texture.slot.clone(),
                    joined(&mut plan.planes, self.first, wanted),
                ));
                plan.replaced.insert(slot.texture.pointer.clone());
                if resampled.encoding == Encoding::Normal {
                    plan.normal_mapped.extend(&primitives);
                }
            }
            // Record the planes of the material.
            if !planes.is_empty() {
                plan.materials.push(MaterialPlanes {
                    material,
                    primitives,
                    slots: planes,
                });
            }
        }
    }
}

/// Returns the plane that a texture joins: one for the same slot in which its surfaces have nothing else, or a new one.
fn joined(planes: &mut Vec<BakePlane>, first: usize, wanted: BakePlane) -> usize {
    let takes = |plane: &BakePlane| {
        let kind = |plane: &BakePlane| (plane.encoding, plane.filters);
        let shares_name = plane.name == wanted.name;
        kind(plane) == kind(&wanted)
            && wanted.sources.iter().all(|(primitive, source)| {
                let present = plane.sources.get(primitive);
                present.is_none_or(|present| present == source)
            })
            && (shares_name || wanted.sources.keys().any(|p| plane.sources.contains_key(p)))
    };
    if let Some(found) = planes[first..].iter().position(takes) {
        planes[first + found].sources.extend(wanted.sources);
        first + found
    } else {
        planes.push(wanted);
        planes.len() - 1
    }
}

/// Returns `baseColor` for `pbrMetallicRoughness/baseColorTexture`.
fn word(slot: &str) -> &str {
    let name = slot.rsplit('/').next().unwrap_or(slot);
    name.strip_suffix("Texture").unwrap_or(name)
}

// Sampling of an image by a texture info.

/// A texture that can be resampled.
#[derive(Debug, Clone)]
pub(super) struct Resampled {
    pub encoding: Encoding,
    pub filters: [Option<usize>; 2],
    pub source: TextureSource,
}

impl Resampled {
    /// Analyzes a texture of a material; the error is the reason why it cannot be resampled.
    pub fn of(json: &Value, texture: &TextureUse) -> Result<Self, String> {
        let encoding = encoding(&texture.slot)
            .ok_or_else(|| "the meaning of its texels is unknown".to_owned())?;
        if is_animated(json, &texture.pointer) {
            return Err("its transform is animated".to_owned());
        }
        let invalid = |error: DocumentError| error.to_string();
        let object = item(json, "textures", texture.texture).map_err(invalid)?;
        let image = images::source(object).map_err(invalid)?;
        let image = image.ok_or_else(|| no_image(object))?;
        let sampler = unsigned(object, "sampler").map_err(invalid)?;
        let sampler = sampler.and_then(|sampler| item(json, "samplers", sampler).ok());
        let number = |key: &str| sampler.and_then(|s| unsigned(s, key).ok().flatten());
        let info = json.pointer(&texture.pointer).unwrap_or(&Value::Null);
        Ok(Self {
            encoding,
            filters: ["magFilter", "minFilter"].map(number),
            source: TextureSource {
                image,
                wrap: ["wrapS", "wrapT"].map(|key| wrap(number(key))),
                set: texture.set,
                transform: transform(extension(info, TRANSFORM)),
            },
        })
    }
}

/// Returns the reason why a texture has no image that can be read, with the extension and the image that it names.
fn no_image(texture: &Value) -> String {
    let readable = "its image is not PNG, JPEG or WebP";
    let extensions = texture.get("extensions").and_then(Value::as_object);
    let named = extensions.into_iter().flatten().find_map(|(name, object)| {
        let image = unsigned(object, "source").ok().flatten()?;
        Some(format!("{readable}: image {image} of {name}"))
    });
    named.unwrap_or_else(|| readable.to_owned())
}

/// Returns the encoding of a texture at this path of a material, by the core specification and ratified extensions.
fn encoding(slot: &str) -> Option<Encoding> {
    Some(match slot.rsplit('/').next().unwrap_or(slot) {
        "baseColorTexture"
        | "emissiveTexture"
        | "sheenColorTexture"
        | "specularColorTexture"
        | "diffuseTransmissionColorTexture"
        | "diffuseTexture"
        | "specularGlossinessTexture" => Encoding::Color,
        "metallicRoughnessTexture"
        | "occlusionTexture"
        | "clearcoatTexture"
        | "clearcoatRoughnessTexture"
        | "transmissionTexture"
        | "thicknessTexture"
        | "sheenRoughnessTexture"
        | "specularTexture"
        | "iridescenceTexture"
        | "iridescenceThicknessTexture"
        | "diffuseTransmissionTexture" => Encoding::Data,
        "normalTexture" | "clearcoatNormalTexture" => Encoding::Normal,
        _ => return None,
    })
}

/// Returns whether an animation changes a member of the texture info.
fn is_animated(json: &Value, pointer: &str) -> bool {
    let channels = (json
        .get("animations")
        .and_then(Value::as_array)
        .into_iter()
        .flatten())
    .filter_map(|animation| animation.get("channels")?.as_array());
    let target = |channel: &Value| {
        let target = extension(channel.get("target")?, "KHR_animation_pointer")?;
        Some(target.get("pointer")?.as_str()?.starts_with(pointer))
    };
    channels
        .flatten()
        .any(|channel| target(channel) == Some(true))
}

fn wrap(code: Option<usize>) -> Wrap {
    match code {
        Some(33071) => Wrap::Clamp,
        Some(33648) => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}

/// Returns the transform: scale, then a counter-clockwise rotation as seen with v down, then a shift.
fn transform(extension: Option<&Value>) -> [[f64; 3]; 2] {
    let number = |value: Option<&Value>, default: f64| {
        value
            .and_then(Value::as_f64)
            .filter(|x| x.is_finite())
            .unwrap_or(default)
    };
    let member = |key: &str| extension.and_then(|extension| extension.get(key));
    let pair = |key: &str, default: f64| {
        [0, 1].map(|k| number(member(key).and_then(|pair| pair.get(k)), default))
    };
    let (offset, scale) = (pair("offset", 0.0), pair("scale", 1.0));
    let (sin, cos) = number(member("rotation"), 0.0).sin_cos();
    [
        [cos * scale[0], sin * scale[1], offset[0]],
        [-sin * scale[0], cos * scale[1], offset[1]],
    ]
}
