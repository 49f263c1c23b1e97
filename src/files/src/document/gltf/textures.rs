//! Textures and the UV sets that they sample.
use super::json::{as_unsigned, extension, item, items, remove, remove_extension, unsigned};
use crate::document::{AffectedTexture, DocumentError, Primitive};
use serde_json::{Value, json};
use std::collections::BTreeSet;

pub(super) const TRANSFORM: &str = "KHR_texture_transform";

/// A reference to a texture together with the UV set that it samples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct TextureUse {
    /// Material; `None` for textures of the primitive itself.
    pub material: Option<usize>,
    /// JSON pointer of the texture info.
    pub pointer: String,
    /// Path within the material or the primitive.
    pub slot: String,
    pub texture: usize,
    /// n of the effective `TEXCOORD_n`.
    pub set: u32,
    /// `true` if tangents are relative to it.
    pub is_normal_map: bool,
}

/// UV sets below 32, one bit each.
pub(super) type SetMask = u32;

/// Textures of one material, and the sets that they sample.
#[derive(Default, Clone)]
pub(super) struct MaterialTextures {
    pub uses: Vec<TextureUse>,
    pub sampled: SetMask,
    pub normal_mapped: SetMask,
}

impl MaterialTextures {
    /// Returns a copy without the textures whose JSON pointers are in `places`.
    pub fn without(&self, places: &BTreeSet<String>) -> Self {
        let uses = self.uses.iter();
        let others = uses.filter(|texture| !places.contains(&texture.pointer));
        Self::new(others.cloned().collect())
    }

    fn new(uses: Vec<TextureUse>) -> Self {
        let mask = |uses: &mut dyn Iterator<Item = &TextureUse>| {
            uses.fold(0, |mask, texture| {
                mask | 1u32.checked_shl(texture.set).unwrap_or(0)
            })
        };
        Self {
            sampled: mask(&mut uses.iter()),
            normal_mapped: mask(&mut uses.iter().filter(|texture| texture.is_normal_map)),
            uses,
        }
    }

    /// Collects the textures of material `material`; an unknown material has no textures.
    pub fn of_material(json: &Value, material: usize) -> Self {
        let mut uses = Vec::new();
        if let Ok(object) = item(json, "materials", material) {
            let pointer = format!("/materials/{material}");
            let material = Some(material);
            TexturePlace { material, pointer }.search(object, "", &mut uses);
        }
        Self::new(uses)
    }

    /// Collects the textures to which a primitive itself refers, such as those of feature ids.
    pub fn of_primitive(primitive: &Primitive, object: &Value) -> Self {
        let mut uses = Vec::new();
        if let Some(extensions) = object.get("extensions") {
            let (mesh, primitive) = (primitive.mesh, primitive.primitive);
            let place = TexturePlace {
                material: None,
                pointer: format!("/meshes/{mesh}/primitives/{primitive}/extensions"),
            };
            place.search(extensions, "", &mut uses);
        }
        Self::new(uses)
    }
}

/// Returns the material of a primitive and those of its variants; `object` is its JSON.
pub(super) fn materials(
    material: Option<usize>,
    object: &Value,
) -> Result<Vec<usize>, DocumentError> {
    let mut materials: Vec<usize> = material.into_iter().collect();
    if let Some(variants) = extension(object, "KHR_materials_variants") {
        for mapping in items(variants, "mappings")? {
            materials.extend(unsigned(mapping, "material")?);
        }
    }
    materials.sort_unstable();
    materials.dedup();
    Ok(materials)
}

/// Place at which texture infos are searched.
struct TexturePlace {
    material: Option<usize>,
    pointer: String,
}

impl TexturePlace {
    /// Collects every texture info below `value`: an object with an `index`, under a name that ends in `texture`.
    fn search(&self, value: &Value, slot: &str, uses: &mut Vec<TextureUse>) {
        let children: Vec<(String, &Value)> = match value {
            Value::Object(members) => members.iter().map(|(k, v)| (k.clone(), v)).collect(),
            Value::Array(items) => items
                .iter()
                .enumerate()
                .map(|(k, v)| (k.to_string(), v))
                .collect(),
            _ => return,
        };
        for (key, child) in children {
            // Extras belong to applications and refer to nothing.
            if key == "extras" {
                continue;
            }
            let slot = if slot.is_empty() {
                key.clone()
            } else {
                format!("{slot}/{key}")
            };
            // A texture info has an index and a telling name; search everything else.
            let key = key.to_ascii_lowercase();
            let texture = child.get("index").and_then(as_unsigned);
            if let Some(texture) = texture.filter(|_| key.ends_with("texture")) {
                uses.push(TextureUse {
                    material: self.material,
                    pointer: format!("{}/{slot}", self.pointer),
                    texture,
                    set: set_in_effect(child),
                    is_normal_map: key.ends_with("normaltexture"),
                    slot,
                });
            } else {
                self.search(child, &slot, uses);
            }
        }
    }
}

/// Returns the set that a texture info samples: its transform's, else its own, else 0.
fn set_in_effect(info: &Value) -> u32 {
    let set = |object: Option<&Value>| as_unsigned(object?.get("texCoord")?);
    set(extension(info, TRANSFORM))
        .or_else(|| set(Some(info)))
        .and_then(|set| u32::try_from(set).ok())
        .unwrap_or(0)
}

/// Removes the transform of a texture info and keeps the set that it samples. Returns whether there was one.
pub(super) fn remove_transform(json: &mut Value, texture: &TextureUse) -> bool {
    let Some(info) = json.pointer_mut(&texture.pointer) else {
        return false;
    };
    if remove_extension(info, TRANSFORM).is_none() {
        return false;
    }
    if texture.set == 0 {
        remove(info, "texCoord");
    } else {
        info["texCoord"] = json!(texture.set);
    }
    true
}

/// Returns the note for the report that this texture must be baked again.
pub(super) fn affected(json: &Value, texture: &TextureUse) -> AffectedTexture {
    let source = item(json, "textures", texture.texture).ok();
    AffectedTexture {
        material: texture.material,
        slot: texture.slot.clone(),
        texture: texture.texture,
        image: source.and_then(|object| unsigned(object, "source").ok().flatten()),
    }
}
