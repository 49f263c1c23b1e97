//! Sampling of an image by a texture info.
use super::json::{extension, item, unsigned};
use super::textures::{TRANSFORM, TextureUse};
use crate::document::{Encoding, TextureSource, Wrap};
use serde_json::Value;

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
        let invalid = |error: crate::document::DocumentError| error.to_string();
        let object = item(json, "textures", texture.texture).map_err(invalid)?;
        let image = unsigned(object, "source").map_err(invalid)?;
        let image = image.ok_or_else(|| "it has no PNG or JPEG image".to_owned())?;
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
