//! Insertion of new textures into the document.
use super::body::Body;
use super::json::{
    array_mut, invalid, item, items, object_mut, primitive_mut, remove, remove_extension, unsigned,
};
use super::textures::{TRANSFORM, materials};
use super::{GltfDocument, images, uri};
use crate::document::bake::MaterialPlanes;
use crate::document::{BakedTexture, BakedTextures, DocumentError, WriteNotes};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Number of this wrapping mode in glTF, that of WebGL.
const CLAMP_TO_EDGE: usize = 33071;

/// Assigns the new textures, sampled by set `set`, to the materials, and returns the files of all images. A material
/// that other primitives use too is copied.
pub(super) fn insert(
    document: &GltfDocument,
    body: &mut Body,
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
        let texture = json!({"sampler": sampler, "source": image});
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
    notes.textures_kept.clone_from(&baked.plan.kept);
    Ok(resources)
}

/// Appends to a top-level array and returns the index.
fn push(json: &mut Value, collection: &str, object: Value) -> Result<usize, DocumentError> {
    let objects = array_mut(json, collection)?;
    objects.push(object);
    Ok(objects.len() - 1)
}

/// Returns a file name that no other file has.
fn free_name(stem: &str, extension: &str, taken: &BTreeMap<String, Vec<u8>>) -> String {
    let numbered = |n: usize| match n {
        0 => format!("{stem}.{extension}"),
        n => format!("{stem}_{n}.{extension}"),
    };
    let mut names = (0..).map(numbered);
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

/// Returns the material itself if only these primitives have it, else a copy, which is assigned to them.
fn own_material(
    document: &GltfDocument,
    body: &mut Body,
    of_material: &MaterialPlanes,
) -> Result<usize, DocumentError> {
    let old = of_material.material;
    let primitives: BTreeSet<[usize; 2]> = (of_material.primitives.iter())
        .map(|&index| &document.primitives[index])
        .map(|primitive| [primitive.mesh, primitive.primitive])
        .collect();
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

/// Points a texture info to another texture, sampled by `set` without a transform. Returns whether it had a transform.
fn point(json: &mut Value, pointer: &str, texture: usize, set: u32) -> Result<bool, DocumentError> {
    let gone = || invalid(format!("{pointer} does not exist"));
    let info = json.pointer_mut(pointer).ok_or_else(gone)?;
    object_mut(info)?.insert("index".to_owned(), json!(texture));
    let was_transformed = remove_extension(info, TRANSFORM).is_some();
    if set == 0 {
        remove(info, "texCoord");
    } else {
        info["texCoord"] = json!(set);
    }
    Ok(was_transformed)
}
