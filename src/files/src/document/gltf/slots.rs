//! Textures of materials, each with the way to resample it.

use super::document::GltfDocument;
use super::images;
use super::json::{extension, item, unsigned};
use super::textures::{MaterialTextures, TRANSFORM, TextureUse, materials};
use crate::document::{DocumentError, Encoding, TextureSource, Wrap};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Extension with directions of anisotropy, which are relative to tangents: they turn with the UVs.
pub(super) const ANISOTROPY: &str = "KHR_materials_anisotropy";

/// Path of the texture of base colors within a material.
pub(super) const BASE_COLOR: &str = "pbrMetallicRoughness/baseColorTexture";

/// A texture of a material, with the way to resample it or the reason why that is impossible.
pub(super) struct Slot {
    pub texture: TextureUse,
    pub resampled: Result<Resampled, String>,
}

/// Indices of primitives by their materials, including those of variants.
pub(super) type Users = BTreeMap<usize, BTreeSet<usize>>;

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
        let image = images::readable(object).map_err(invalid)?;
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
    let readable = "its image is not PNG, JPEG, WebP or KTX2";
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
