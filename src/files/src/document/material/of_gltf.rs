//! Conversion of materials from glTF.
use super::mtl::Dropped;
use super::{Map, Material};
use serde_json::Value;

/// Extensions that are partly transferred, with the members that are.
const CARRIED: [(&str, &[&str]); 5] = [
    (
        "KHR_materials_specular",
        &["specularFactor", "specularColorFactor"],
    ),
    ("KHR_materials_ior", &["ior"]),
    (
        "KHR_materials_clearcoat",
        &["clearcoatFactor", "clearcoatRoughnessFactor"],
    ),
    ("KHR_materials_emissive_strength", &["emissiveStrength"]),
    ("KHR_materials_unlit", &[]),
];

/// Converts a material under the name `name`; `map` converts texture infos to maps. Adds parts that MTL cannot hold to
/// `lost`.
pub(in crate::document) fn material(
    object: &Value,
    name: String,
    mut map: impl FnMut(&Value) -> Option<Map>,
    lost: &mut Dropped,
) -> Material {
    let new = Material::named(name);
    let at = |pointer: &str| object.pointer(pointer);
    let pbr = |key: &str| at(&format!("/pbrMetallicRoughness/{key}"));
    // Color, specular reflection, emission, coat and normals.
    let [r, g, b, alpha] = numbers(pbr("baseColorFactor")).unwrap_or([1.0; 4]);
    let mode = at("/alphaMode").and_then(Value::as_str).unwrap_or("OPAQUE");
    let color_map = pbr("baseColorTexture").and_then(&mut map);
    let of = |name: &str, key: &str| at(&format!("/extensions/{name}/{key}"));
    let specular = number(of("KHR_materials_specular", "specularFactor"), 1.0);
    let tint = numbers(of("KHR_materials_specular", "specularColorFactor")).unwrap_or([1.0; 3]);
    let glow = number(
        of("KHR_materials_emissive_strength", "emissiveStrength"),
        1.0,
    );
    let emission = numbers(at("/emissiveFactor")).unwrap_or([0.0; 3]);
    let clearcoat = |key: &str| number(of("KHR_materials_clearcoat", key), 0.0);
    let normal_map = at("/normalTexture").and_then(&mut map);
    let strength = number(at("/normalTexture/scale"), 1.0);
    // Count the parts that MTL cannot hold.
    for part in lost_parts(object, mode) {
        *lost.entry(part).or_default() += 1;
    }
    Material {
        color: [r, g, b],
        alpha: if mode == "OPAQUE" { 1.0 } else { alpha },
        is_cut_out: mode != "OPAQUE" && color_map.is_some(),
        color_map,
        metallic: number(pbr("metallicFactor"), 1.0),
        roughness: number(pbr("roughnessFactor"), 1.0),
        metallic_roughness_map: pbr("metallicRoughnessTexture").and_then(&mut map),
        specular: tint.map(|x| specular * x / 2.0),
        ior: number(of("KHR_materials_ior", "ior"), new.ior),
        emission: emission.map(|x| x * glow),
        emission_map: at("/emissiveTexture").and_then(&mut map),
        normal_map: normal_map.map(|map| Map { strength, ..map }),
        coat: [
            clearcoat("clearcoatFactor"),
            clearcoat("clearcoatRoughnessFactor"),
        ],
        is_unlit: at("/extensions/KHR_materials_unlit").is_some(),
        ..new
    }
}

/// Returns the names of parts that MTL cannot hold.
fn lost_parts(object: &Value, mode: &str) -> Vec<String> {
    let mut lost = Vec::new();
    if object.get("occlusionTexture").is_some() {
        lost.push("occlusionTexture".to_owned());
    }
    if mode == "MASK" {
        lost.push("alphaCutoff".to_owned());
    }
    let extensions = object.get("extensions").and_then(Value::as_object);
    for (name, extension) in extensions.into_iter().flatten() {
        match CARRIED.iter().find(|(carried, _)| carried == name) {
            None => lost.push(name.clone()),
            Some((_, members)) => {
                let own = extension.as_object().into_iter().flatten();
                let other = own.filter(|(key, _)| !members.contains(&key.as_str()));
                lost.extend(other.map(|(key, _)| format!("{name}/{key}")));
            }
        }
    }
    lost
}

fn number(value: Option<&Value>, default: f64) -> f64 {
    value.and_then(Value::as_f64).unwrap_or(default)
}

fn numbers<const N: usize>(value: Option<&Value>) -> Option<[f64; N]> {
    let numbers = value?.as_array()?.iter().map(Value::as_f64);
    numbers.collect::<Option<Vec<_>>>()?.try_into().ok()
}
