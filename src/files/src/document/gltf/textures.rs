//! Textures and the UV sets that they sample.

use super::body::GltfBody;
use super::document::{self, GltfDocument};
use super::images;
use super::json::{
    array_mut, as_unsigned, extension, invalid, item, items, object_mut, primitive_mut, remove,
    remove_extension, unsigned,
};
use crate::document::bake::MaterialPlanes;
use crate::document::error::listed;
use crate::document::{
    AffectedTexture, BakePlan, BakedTexture, BakedTextures, DocumentError, KeptTexture, MergeNote,
    MergedNote, Primitive, Warning, WriteNotes, uri,
};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

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
        image: source.and_then(|object| images::source(object).ok().flatten()),
    }
}

// Warnings about textures that the new UVs do not fit.

impl GltfDocument {
    /// Returns the warning about a texture that is not resampled.
    pub fn kept_warning(&self, kept: &KeptTexture) -> Warning {
        let texture = named(self, &kept.slot, kept.material);
        let text = format!(
            "{texture} is not resampled and keeps its UVs: {}",
            kept.reason
        );
        Warning::new("textures_kept", text)
    }

    /// Returns the name of a texture by its place in a material.
    pub fn texture_name(&self, slot: &str, material: usize) -> String {
        named(self, slot, Some(material))
    }
}

fn named(document: &GltfDocument, slot: &str, material: Option<usize>) -> String {
    let slot = slot.rsplit('/').next().unwrap_or_default();
    match material {
        Some(material) => format!("{slot} of {}", document::material_name(document, material)),
        None => slot.to_owned(),
    }
}

/// Returns warnings about textures that show the old layout, and about those that could not be resampled, with the reason.
pub(super) fn texture_warnings(document: &GltfDocument, notes: &WriteNotes) -> Vec<Warning> {
    let stale: Vec<String> = (notes.textures_affected.iter())
        .map(|texture| named(document, &texture.slot, texture.material))
        .collect();
    let mut warnings = Vec::new();
    if !stale.is_empty() {
        let stale = listed(stale.iter().map(String::as_str));
        let text = format!("textures show the old layout ({stale}); `--rebake` resamples them");
        warnings.push(Warning::new("textures_stale", text));
    }
    let kept = notes.textures_kept.iter();
    warnings.extend(kept.map(|kept| document.kept_warning(kept)));
    warnings.extend(apart_warnings(notes));
    warnings
}

/// Returns a warning for each reason why materials stay apart.
fn apart_warnings(notes: &WriteNotes) -> Vec<Warning> {
    let mut of_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for apart in notes.merged.iter().flat_map(|merged| &merged.apart) {
        of_reason
            .entry(&apart.reason)
            .or_default()
            .push(&apart.name);
    }
    let warning = |(reason, names): (&str, Vec<&str>)| {
        let materials = listed(names.into_iter());
        Warning::new(
            "materials_apart",
            format!("not merged: {materials} ({reason})"),
        )
    };
    of_reason.into_iter().map(warning).collect()
}

// Insertion of new textures into the document.

/// Number of this wrapping mode in glTF, that of WebGL.
const CLAMP_TO_EDGE: usize = 33071;

/// Assigns the new textures, sampled by set `set`, to the materials, and returns the files of all images. A material
/// that other primitives use too is copied.
pub(super) fn insert(
    document: &GltfDocument,
    body: &mut GltfBody,
    baked: &BakedTextures,
    set: u32,
    stem: &str,
    notes: &mut WriteNotes,
) -> Result<BTreeMap<String, Vec<u8>>, DocumentError> {
    let mut resources = document.resources.clone();
    let mut textures = Vec::new();
    // An image and a texture for each plane.
    for (plane, (_, file)) in baked.plan.planes.iter().zip(&baked.files) {
        let name = free_name(
            &format!("{stem}_{}", plane.name.replace('/', "_")),
            images::file_extension(file),
            &resources,
        );
        let image = push(
            &mut body.json,
            "images",
            json!({"uri": uri::encoded(&name)}),
        )?;
        resources.insert(name, file.clone());
        let sampler = sampler(&mut body.json, plane.filters)?;
        let texture = images::texture(&mut body.json, image, sampler, file)?;
        textures.push(push(&mut body.json, "textures", texture)?);
    }
    // Point the texture infos of each material to its planes.
    for of_material in &baked.plan.materials {
        let material = own_material(document, body, of_material)?;
        for (slot, plane) in &of_material.slots {
            let texture = textures[*plane];
            let pointer = format!("/materials/{material}/{slot}");
            if point(&mut body.json, &pointer, texture, set)? {
                notes.transforms_removed.push(pointer);
            }
            notes.textures_baked.push(BakedTexture {
                material,
                slot: slot.clone(),
                texture,
                side: baked.files[*plane].0,
            });
        }
    }
    insert_merged(document, body, baked, &textures, set, notes)?;
    remove_colors(document, body, &baked.plan)?;
    notes.textures_kept.clone_from(&baked.plan.kept);
    notes.colors_baked = baked.plan.colored.len();
    (notes.warnings).extend(colors_kept(document, &baked.plan));
    Ok(resources)
}

/// Removes the vertex colors that textures have now.
fn remove_colors(
    document: &GltfDocument,
    body: &mut GltfBody,
    plan: &BakePlan,
) -> Result<(), DocumentError> {
    for &index in &plan.colored {
        let primitive = &document.primitives[index];
        let object = primitive_mut(&mut body.json, primitive.mesh, primitive.primitive)?;
        remove(&mut object["attributes"], document::COLOR);
    }
    Ok(())
}

/// Returns a warning for each reason why vertex colors stay.
fn colors_kept(document: &GltfDocument, plan: &BakePlan) -> Vec<Warning> {
    let mut of_reason: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
    for (&index, reason) in &plan.colors_kept {
        let meshes = of_reason.entry(reason).or_default();
        meshes.insert(document.primitives[index].mesh);
    }
    let warning = |(reason, meshes): (&str, BTreeSet<usize>)| {
        let meshes = document::listed_meshes(document, &meshes);
        let text = format!("the vertex colors of {meshes} stay as they are: {reason}");
        Warning::new("colors_kept", text)
    };
    of_reason.into_iter().map(warning).collect()
}

/// Adds the merged materials with their `textures`, and assigns them to their primitives.
fn insert_merged(
    document: &GltfDocument,
    body: &mut GltfBody,
    baked: &BakedTextures,
    textures: &[usize],
    set: u32,
    notes: &mut WriteNotes,
) -> Result<(), DocumentError> {
    let Some(plan) = &baked.plan.merge else {
        return Ok(());
    };
    let mut note = MergeNote {
        materials: Vec::new(),
        apart: plan.apart.clone(),
        draw_calls_before: draw_calls(&document.body.json)?,
        draw_calls_after: 0,
    };
    for planes in &baked.plan.merged {
        let merged = &plan.merged[planes.merged];
        let material = push(&mut body.json, "materials", planes.material.clone())?;
        for &index in &planes.primitives {
            let primitive = &document.primitives[index];
            let object = primitive_mut(&mut body.json, primitive.mesh, primitive.primitive)?;
            object["material"] = json!(material);
        }
        for (slot, plane) in &planes.slots {
            let pointer = format!("/materials/{material}/{slot}");
            point(&mut body.json, &pointer, textures[*plane], set)?;
            notes.textures_baked.push(BakedTexture {
                material,
                slot: slot.clone(),
                texture: textures[*plane],
                side: baked.files[*plane].0,
            });
        }
        // Name what it replaces, with the transforms that are gone.
        for &member in &merged.members {
            let uses = MaterialTextures::of_material(&body.json, member).uses;
            let transformed = uses.into_iter().filter(|texture| {
                let info = body.json.pointer(&texture.pointer);
                info.is_some_and(|info| extension(info, TRANSFORM).is_some())
            });
            (notes.transforms_removed).extend(transformed.map(|texture| texture.pointer));
        }
        let names = merged.members.iter();
        note.materials.push(MergedNote {
            material,
            name: merged.name.clone(),
            replaces: names
                .map(|&member| document::plain_material_name(document, member))
                .collect(),
        });
    }
    notes.merged = Some(note);
    Ok(())
}

/// Returns the number of draw calls of all nodes: the primitives of their meshes, including points and lines.
pub(super) fn draw_calls(json: &Value) -> Result<usize, DocumentError> {
    let mut n_calls = 0;
    for node in items(json, "nodes")? {
        if let Some(mesh) = unsigned(node, "mesh")? {
            n_calls += items(item(json, "meshes", mesh)?, "primitives")?.len();
        }
    }
    Ok(n_calls)
}

/// Appends to a top-level array and returns the index.
fn push(json: &mut Value, collection: &str, object: Value) -> Result<usize, DocumentError> {
    let objects = array_mut(json, collection)?;
    objects.push(object);
    Ok(objects.len() - 1)
}

/// Returns a file name that no other file has.
fn free_name(stem: &str, extension: &str, taken: &BTreeMap<String, Vec<u8>>) -> String {
    let mut names = (0..).map(|n: usize| match n {
        0 => format!("{stem}.{extension}"),
        n => format!("{stem}_{n}.{extension}"),
    });
    names
        .find(|name| !taken.contains_key(name))
        .unwrap_or_default()
}

/// Returns the index of the sampler with these filters and without repetition.
fn sampler(json: &mut Value, [mag, min]: [Option<usize>; 2]) -> Result<usize, DocumentError> {
    let mut wanted = json!({"wrapS": CLAMP_TO_EDGE, "wrapT": CLAMP_TO_EDGE});
    for (key, filter) in [("magFilter", mag), ("minFilter", min)] {
        if let Some(filter) = filter {
            wanted[key] = json!(filter);
        }
    }
    match items(json, "samplers")?
        .iter()
        .position(|sampler| *sampler == wanted)
    {
        Some(sampler) => Ok(sampler),
        None => push(json, "samplers", wanted),
    }
}

/// Returns the material itself if only these primitives have it, else a copy, which is assigned to them. Primitives
/// without a material get a new one that shows the same.
fn own_material(
    document: &GltfDocument,
    body: &mut GltfBody,
    of_material: &MaterialPlanes,
) -> Result<usize, DocumentError> {
    let primitives: BTreeSet<[usize; 2]> = (of_material.primitives.iter())
        .map(|&index| &document.primitives[index])
        .map(|primitive| [primitive.mesh, primitive.primitive])
        .collect();
    let Some(old) = of_material.material else {
        let new = push(&mut body.json, "materials", json!({}))?;
        for [mesh, primitive] in primitives {
            primitive_mut(&mut body.json, mesh, primitive)?["material"] = json!(new);
        }
        return Ok(new);
    };
    if users(&body.json, old)?.is_subset(&primitives) {
        return Ok(old);
    }
    let copy = item(&body.json, "materials", old)?.clone();
    let new = push(&mut body.json, "materials", copy)?;
    for [mesh, primitive] in primitives {
        let object = primitive_mut(&mut body.json, mesh, primitive)?;
        if unsigned(object, "material")? == Some(old) {
            object["material"] = json!(new);
        }
        let mappings = object.pointer_mut("/extensions/KHR_materials_variants/mappings");
        for mapping in mappings.and_then(Value::as_array_mut).into_iter().flatten() {
            if unsigned(mapping, "material")? == Some(old) {
                mapping["material"] = json!(new);
            }
        }
    }
    Ok(new)
}

/// Returns mesh and index of all primitives that have a material, including points and lines.
fn users(json: &Value, material: usize) -> Result<BTreeSet<[usize; 2]>, DocumentError> {
    let mut users = BTreeSet::new();
    for (mesh, object) in items(json, "meshes")?.iter().enumerate() {
        for (primitive, object) in items(object, "primitives")?.iter().enumerate() {
            if materials(unsigned(object, "material")?, object)?.contains(&material) {
                users.insert([mesh, primitive]);
            }
        }
    }
    Ok(users)
}

/// Points a texture info, which is created if it is missing, to another texture, sampled by `set` without a transform. Returns whether it had a transform.
fn point(json: &mut Value, pointer: &str, texture: usize, set: u32) -> Result<bool, DocumentError> {
    let info = info_mut(json, pointer)?;
    object_mut(info)?.insert("index".to_owned(), json!(texture));
    let was_transformed = remove_extension(info, TRANSFORM).is_some();
    if set == 0 {
        remove(info, "texCoord");
    } else {
        info["texCoord"] = json!(set);
    }
    Ok(was_transformed)
}

/// Returns the texture info at a place of an existing material, and creates it if it is missing.
fn info_mut<'a>(json: &'a mut Value, pointer: &str) -> Result<&'a mut Value, DocumentError> {
    let mut value = json;
    for name in pointer.split('/').skip(1) {
        value = match value {
            Value::Array(items) => name.parse().ok().and_then(|k: usize| items.get_mut(k)),
            Value::Object(members) => Some(members.entry(name).or_insert_with(|| json!({}))),
            _ => None,
        }
        .ok_or_else(|| invalid(format!("{pointer} does not exist")))?;
    }
    Ok(value)
}
