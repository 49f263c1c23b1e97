//! Conversion of materials to glTF.

use super::mtl::Dropped;
use super::{Material, TextureMap, UploadedPictures};
use crate::document::uri::encoded;
use crate::document::{Warning, error};
use serde_json::{Map as Members, Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Number of this wrapping mode in glTF, that of WebGL.
const CLAMP_TO_EDGE: usize = 33071;

/// Materials of a new glTF file with their textures.
pub(in crate::document) struct GltfMaterials<'a> {
    pictures: UploadedPictures<'a>,
    /// Files of the images.
    pub resources: BTreeMap<String, Vec<u8>>,
    materials: Vec<Value>,
    images: Vec<Value>,
    textures: Vec<Value>,
    extensions: BTreeSet<&'static str>,
    /// Bump maps that are taken as normal maps, and those that are not.
    bump_maps: [BTreeSet<String>; 2],
}

impl<'a> GltfMaterials<'a> {
    /// Starts without materials; their pictures are among these files.
    pub fn new(resources: &'a BTreeMap<String, Vec<u8>>) -> Self {
        Self {
            pictures: UploadedPictures::among(resources),
            resources: BTreeMap::new(),
            materials: Vec::new(),
            images: Vec::new(),
            textures: Vec::new(),
            extensions: BTreeSet::new(),
            bump_maps: [BTreeSet::new(), BTreeSet::new()],
        }
    }

    /// Appends a material whose maps are relative to `folder`. Returns whether it has textures.
    pub fn push(&mut self, material: &Material, folder: &str) -> bool {
        let n_textures = self.textures.len();
        // Members of the core specification.
        let mut pbr =
            json!({"metallicFactor": material.metallic, "roughnessFactor": material.roughness});
        let [r, g, b] = material.color.map(|x| x.min(1.0));
        if [r, g, b, material.alpha] != [1.0; 4] {
            pbr["baseColorFactor"] = json!([r, g, b, material.alpha]);
        }
        self.put(
            &mut pbr,
            "baseColorTexture",
            material.color_map.as_ref(),
            folder,
        );
        self.put(
            &mut pbr,
            "metallicRoughnessTexture",
            material.metallic_roughness_map.as_ref(),
            folder,
        );
        let mut json = json!({"name": material.name, "pbrMetallicRoughness": pbr});
        self.put_normal_map(&mut json, material, folder);
        // Emission above 1 becomes a strength, in an extension.
        let glow = material.emission.into_iter().fold(0.0, f64::max);
        if glow > 0.0 {
            let strength = glow.max(1.0);
            json["emissiveFactor"] = json!(material.emission.map(|x| x / strength));
            self.put(
                &mut json,
                "emissiveTexture",
                material.emission_map.as_ref(),
                folder,
            );
        }
        if material.alpha < 1.0 || material.is_cut_out {
            json["alphaMode"] = json!("BLEND");
        }
        // Extensions.
        let extensions = extensions(material, glow);
        if !extensions.is_empty() {
            self.extensions
                .extend(extensions.iter().map(|(name, _)| *name));
            let named = extensions
                .into_iter()
                .map(|(name, value)| (name.to_owned(), value));
            json["extensions"] = Value::Object(named.collect::<Members<_, _>>());
        }
        self.materials.push(json);
        self.textures.len() > n_textures
    }

    /// Adds a texture to `parent`, if the picture exists.
    fn put(&mut self, parent: &mut Value, slot: &str, map: Option<&TextureMap>, folder: &str) {
        if let Some(info) = map.and_then(|map| self.info(map, folder)) {
            parent[slot] = info;
        }
    }

    /// Adds the normal map, unless it is a bump map of one channel, which holds heights, not directions.
    fn put_normal_map(&mut self, json: &mut Value, material: &Material, folder: &str) {
        let Some(map) = &material.normal_map else {
            return;
        };
        if material.is_bump {
            let Some((_, bytes)) = self.pictures.find(folder, &map.path) else {
                return;
            };
            let is_left_out = is_gray(bytes);
            self.bump_maps[usize::from(is_left_out)].insert(material.name.clone());
            if is_left_out {
                return;
            }
        }
        self.put(json, "normalTexture", Some(map), folder);
        if map.strength != 1.0 && json.get("normalTexture").is_some() {
            json["normalTexture"]["scale"] = json!(map.strength);
        }
    }

    fn info(&mut self, map: &TextureMap, folder: &str) -> Option<Value> {
        let (name, bytes) = self.pictures.find(folder, &map.path)?;
        if !self.resources.contains_key(name) {
            self.resources.insert(name.to_owned(), bytes.to_vec());
        }
        let parts: Vec<String> = name.split('/').map(encoded).collect();
        let own_name = name.rsplit('/').next().unwrap_or(name);
        let stem = own_name.rsplit_once('.').map_or(own_name, |(stem, _)| stem);
        let image = json!({"name": stem, "uri": parts.join("/")});
        let source = place_of(&mut self.images, image);
        let mut texture = json!({"source": source});
        if map.clamp {
            texture["sampler"] = json!(0);
        }
        let mut info = json!({"index": place_of(&mut self.textures, texture)});
        let ([su, sv], [ou, ov]) = (map.scale, map.offset);
        if map.scale != [1.0; 2] || map.offset != [0.0; 2] {
            // v points down here: 1 - (sv (1 - v) + ov).
            let transform = json!({"scale": [su, sv], "offset": [ou, 1.0 - sv - ov]});
            info["extensions"] = json!({"KHR_texture_transform": transform});
            self.extensions.insert("KHR_texture_transform");
        }
        Some(info)
    }

    /// Adds the nonempty collections to the members of a glTF file.
    pub fn insert_into(&self, json: &mut Value) {
        let collections = [
            ("materials", &self.materials),
            ("textures", &self.textures),
            ("images", &self.images),
        ];
        for (key, objects) in collections {
            if !objects.is_empty() {
                json[key] = json!(objects);
            }
        }
        if self
            .textures
            .iter()
            .any(|texture| texture.get("sampler").is_some())
        {
            json["samplers"] = json!([{"wrapS": CLAMP_TO_EDGE, "wrapT": CLAMP_TO_EDGE}]);
        }
        if !self.extensions.is_empty() {
            json["extensionsUsed"] = json!(self.extensions);
        }
    }

    /// Returns warnings about content that could not be transferred.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        let listed = |names: &BTreeSet<String>| error::listed(names.iter().map(String::as_str));
        if !self.pictures.missing.is_empty() {
            let message = format!(
                "material pictures were not supplied and are left out: {}; they belong beside the material file",
                listed(&self.pictures.missing)
            );
            warnings.push(Warning::new("pictures_missing", message));
        }
        let [taken, left_out] = &self.bump_maps;
        if !taken.is_empty() {
            let message = format!(
                "bump maps are used as normal maps, which is wrong if they hold heights: materials {}",
                listed(taken)
            );
            warnings.push(Warning::new("bump_as_normals", message));
        }
        if !left_out.is_empty() {
            let message = format!(
                "glTF cannot hold height maps, so bump maps are left out: materials {}",
                listed(left_out)
            );
            warnings.push(Warning::new("bump_dropped", message));
        }
        warnings
    }
}

/// Returns the extensions for content outside the core.
fn extensions(material: &Material, glow: f64) -> Vec<(&'static str, Value)> {
    let mut extensions = Vec::new();
    if glow > 1.0 {
        extensions.push((
            "KHR_materials_emissive_strength",
            json!({"emissiveStrength": glow}),
        ));
    }
    if material.specular != [0.5; 3] {
        let factor = material.specular.map(|x| 2.0 * x);
        extensions.push((
            "KHR_materials_specular",
            json!({"specularColorFactor": factor}),
        ));
    }
    if material.ior != 1.5 {
        extensions.push(("KHR_materials_ior", json!({"ior": material.ior})));
    }
    if material.coat[0] > 0.0 {
        let [factor, roughness] = material.coat;
        let coat = json!({"clearcoatFactor": factor, "clearcoatRoughnessFactor": roughness});
        extensions.push(("KHR_materials_clearcoat", coat));
    }
    if material.is_unlit {
        extensions.push(("KHR_materials_unlit", json!({})));
    }
    extensions
}

/// Returns the index of an object, which is appended if there is no equal one.
fn place_of(objects: &mut Vec<Value>, wanted: Value) -> usize {
    let found = objects.iter().position(|object| *object == wanted);
    found.unwrap_or_else(|| {
        objects.push(wanted);
        objects.len() - 1
    })
}

/// Returns whether a PNG or JPEG has one channel, by its header.
fn is_gray(bytes: &[u8]) -> bool {
    if bytes.starts_with(&[0x89, b'P', b'N', b'G']) {
        // The type of color stands at the end of the first chunk; 4 is gray with alpha.
        return matches!(bytes.get(25), Some(0 | 4));
    }
    let mut rest = bytes.strip_prefix(&[0xFF, 0xD8]).unwrap_or_default();
    while let [0xFF, marker, high, low, content @ ..] = rest {
        let is_frame = (0xC0..=0xCF).contains(marker) && ![0xC4, 0xC8, 0xCC].contains(marker);
        if is_frame {
            return content.get(5) == Some(&1);
        }
        let length = usize::from(u16::from_be_bytes([*high, *low]));
        rest = rest.get(2 + length..).unwrap_or_default();
    }
    false
}

// Conversion of materials from glTF.

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
    mut map: impl FnMut(&Value) -> Option<TextureMap>,
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
        normal_map: normal_map.map(|map| TextureMap { strength, ..map }),
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
