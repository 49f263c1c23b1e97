//! Output of the document with a new UV set as files.

use super::body::GltfBody;
use super::document::{self, GltfDocument};
use super::join::join;
use super::json::{item_mut, remove_extension};
use super::links::{Collection, NewIndices};
use super::replacement::EMISSIVE_STRENGTH;
use super::rewrite::rewrite;
use super::texcoord_set::{self, Choice, Textures};
use super::textures::{self, TRANSFORM, affected, remove_transform, texture_warnings};
use super::{as_obj, buffers, extensions, images, marking, primitives};
use crate::document::error::listed;
use crate::document::{
    BakedTextures, DocumentError, JoinedPrimitive, Layout, Mark, NewUvs, OutputFormat, Warning,
    WriteNotes, WriteOptions, Written, uri,
};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use unwrapd_maps::mesh::VAxis;

/// An extension of meshes that refers to the indices of the primitives, which a split invalidates.
const MANIFOLD: &str = "EXT_mesh_manifold";

impl GltfDocument {
    /// Writes the document with `uvs` as a `TEXCOORD_n`, and with textures made for them; `mark` is its present mark,
    /// if that fits.
    pub(in crate::document) fn write(
        &self,
        uvs: &NewUvs,
        options: &WriteOptions,
        baked: Option<&BakedTextures>,
        mark: Option<&Mark>,
    ) -> Result<Written, DocumentError> {
        write(self, uvs, mark, options, baked)
    }
}

/// Writes `document` with `uvs`, and with the textures made for them.
fn write(
    document: &GltfDocument,
    uvs: &NewUvs,
    present: Option<&Mark>,
    options: &WriteOptions,
    baked: Option<&BakedTextures>,
) -> Result<Written, DocumentError> {
    if options.format == OutputFormat::Obj {
        return as_obj::write(document, uvs, options, baked);
    }
    // Choose the set of each primitive and write its UVs.
    let plan = baked.map(|baked| &baked.plan);
    let (choices, textures) = texcoord_set::choose(document, uvs, present, options, plan)?;
    let mut body = document.body.clone();
    let mut notes = WriteNotes {
        extensions_dropped: document.decompressed.clone(),
        ..WriteNotes::default()
    };
    for (index, choice) in choices.iter().enumerate() {
        let (Some(choice), Some(corners)) = (choice, uvs.toward(index, VAxis::Down)) else {
            continue;
        };
        let primitive = &document.primitives[index];
        let note = rewrite(document, &mut body, index, &corners, choice, baked)
            .map_err(|error| primitives::located(error, primitive.mesh, primitive.primitive))?;
        notes.primitives.push(note);
    }
    // Textures: warnings, transforms that no longer apply, and baked ones.
    let warnings = set_warnings(document, &choices, &textures, options, baked.is_some());
    notes.warnings.extend(warnings);
    if uvs.layout == Layout::New {
        release_textures(&mut body.json, &choices, &textures, &mut notes);
    }
    let resources = match baked {
        Some(baked) => {
            let set = choices.iter().flatten().map(|choice| choice.set).next();
            let set = set.unwrap_or(0);
            Cow::Owned(textures::insert(
                document,
                &mut body,
                baked,
                set,
                &options.stem,
                &mut notes,
            )?)
        }
        None => Cow::Borrowed(&document.resources),
    };
    // Primitives of merged materials.
    if let Some(baked) = baked {
        notes.joined = join(document, &mut body, &baked.plan.merged)?;
    }
    if let Some(merged) = &mut notes.merged {
        merged.draw_calls_after = textures::draw_calls(&body.json)?;
    }
    // Extensions that no longer hold, and the mark.
    drop_manifold(&mut body.json, &mut notes)?;
    let gone = ["KHR_texture_transform", MANIFOLD];
    let gone: Vec<&str> = gone
        .into_iter()
        .filter(|name| is_dropped(name, &notes))
        .collect();
    notes
        .extensions_dropped
        .extend(extensions::prune(&mut body.json, &gone)?);
    if !notes.primitives.is_empty() {
        let warning = mark(
            &mut body.json,
            uvs,
            &choices,
            options,
            notes.joined.as_deref(),
        )?;
        notes.warnings.extend(warning);
    }
    let warnings = texture_warnings(document, &notes);
    notes.warnings.extend(warnings);
    // Remove objects that have lost their last reference.
    let places = document.origin.clean(&mut body)?;
    if baked.is_some() {
        let mut gone = vec![images::WEBP, images::KTX2];
        if notes.merged.is_some() {
            gone.extend([EMISSIVE_STRENGTH, TRANSFORM]);
        }
        let dropped = extensions::prune(&mut body.json, &gone)?;
        notes.extensions_dropped.extend(dropped);
    }
    renumber(&mut notes, &places);
    let files = files(body, &document.chunks, &resources, options, &mut notes)?;
    Ok(Written { files, notes })
}

/// Marks the UVs that were written in the document, if their purpose is known.
fn mark(
    json: &mut Value,
    uvs: &NewUvs,
    choices: &[Option<Choice>],
    options: &WriteOptions,
    joined: Option<&[JoinedPrimitive]>,
) -> Result<Option<Warning>, DocumentError> {
    let Some(terms) = &options.terms else {
        marking::clear(json);
        return Ok(None);
    };
    let parts: Vec<Vec<usize>> = match joined {
        Some(joined) => (joined.iter())
            .map(|joined| joined.parts.iter().map(|part| part.primitive).collect())
            .collect(),
        None => (0..choices.len()).map(|index| vec![index]).collect(),
    };
    let written = parts.into_iter().map(|parts| {
        let set = choices[*parts.first()?].as_ref()?.set;
        let corners: Option<Vec<_>> = parts
            .iter()
            .map(|&part| uvs.toward(part, VAxis::Down))
            .collect();
        let corners = corners?.into_iter().flatten();
        Some((
            set,
            corners
                .map(|face| face.map(|uv| uv.map(f64::from)))
                .collect(),
        ))
    });
    marking::set(json, &Mark::new(terms, written))
}

/// Updates materials, textures and images in notes to the numbers of the written file.
fn renumber(notes: &mut WriteNotes, places: &NewIndices) {
    let merged = notes
        .merged
        .iter_mut()
        .flat_map(|merged| &mut merged.materials);
    for merged in merged {
        merged.material = places.of((Collection::Materials, merged.material));
    }
    for baked in &mut notes.textures_baked {
        baked.material = places.of((Collection::Materials, baked.material));
        baked.texture = places.of((Collection::Textures, baked.texture));
    }
    for affected in &mut notes.textures_affected {
        affected.texture = places.of((Collection::Textures, affected.texture));
        affected.image = affected
            .image
            .map(|image| places.of((Collection::Images, image)));
    }
}

fn is_dropped(name: &str, notes: &WriteNotes) -> bool {
    match name {
        MANIFOLD => notes
            .primitives
            .iter()
            .any(|note| note.vertices_after > note.vertices_before),
        _ => !notes.transforms_removed.is_empty(),
    }
}

/// Lists the textures that sampled a replaced set and removes the transforms that were made for it.
fn release_textures(
    json: &mut Value,
    choices: &[Option<Choice>],
    textures: &Textures,
    notes: &mut WriteNotes,
) {
    // Collect the textures that sampled a replaced set: those of primitives and of materials.
    let replaced = choices.iter().flatten().filter(|choice| choice.had_set);
    let mut released = Vec::new();
    let mut sets = BTreeSet::new();
    for choice in replaced {
        released.extend(
            choice
                .own
                .uses
                .iter()
                .filter(|texture| texture.set == choice.set),
        );
        sets.extend(
            choice
                .materials
                .iter()
                .map(|material| (*material, choice.set)),
        );
    }
    for (material, set) in sets {
        let uses = textures
            .get(&material)
            .map_or(&[][..], |textures| &textures.uses);
        released.extend(uses.iter().filter(|texture| texture.set == set));
    }
    // Report them, and remove their transforms.
    for texture in released {
        notes.textures_affected.push(affected(json, texture));
        if remove_transform(json, texture) {
            notes.transforms_removed.push(texture.pointer.clone());
        }
    }
    notes.textures_affected.sort();
}

/// Removes the manifold indices of meshes whose vertices were split.
fn drop_manifold(json: &mut Value, notes: &mut WriteNotes) -> Result<(), DocumentError> {
    let split = notes
        .primitives
        .iter()
        .filter(|note| note.vertices_after > note.vertices_before);
    let meshes: BTreeSet<usize> = split.map(|note| note.mesh).collect();
    for mesh in meshes {
        if remove_extension(item_mut(json, "meshes", mesh)?, MANIFOLD).is_some() {
            notes.warnings.push(Warning::new(
                "manifold_dropped",
                format!("mesh {mesh}: {MANIFOLD} is dropped because vertices were split"),
            ));
        }
    }
    Ok(())
}

fn files(
    mut body: GltfBody,
    chunks: &[(u32, Vec<u8>)],
    resources: &BTreeMap<String, Vec<u8>>,
    options: &WriteOptions,
    notes: &mut WriteNotes,
) -> Result<Vec<(String, Vec<u8>)>, DocumentError> {
    let stem = &options.stem;
    // One file, or JSON with separate files.
    let (files, outside) = match options.format {
        OutputFormat::Glb => {
            let outside = images::embed(&mut body, resources)?;
            body.seal()?;
            let glb = buffers::glb_of(&to_json(&body.json, false), &body.bin, chunks)?;
            (vec![(format!("{stem}.glb"), glb)], outside)
        }
        OutputFormat::Gltf => {
            body.seal()?;
            let name = format!("{stem}.bin");
            if !body.bin.is_empty() {
                item_mut(&mut body.json, "buffers", 0)?["uri"] = json!(uri::encoded(&name));
            }
            let (images, outside) = images::beside(&body.json, resources)?;
            let mut files = vec![(format!("{stem}.gltf"), to_json(&body.json, true))];
            if !body.bin.is_empty() {
                files.push((name, body.bin));
            }
            files.extend(images);
            (files, outside)
        }
        OutputFormat::Obj => {
            return Err(DocumentError::UnsupportedOutput("glTF as OBJ".to_owned()));
        }
    };
    // Images that remain references.
    for uri in outside {
        let uri: String = uri.chars().filter(|c| !c.is_control()).take(120).collect();
        notes.warnings.push(Warning::new(
            "image_missing",
            format!("the image `{uri}` was not supplied and remains a reference"),
        ));
    }
    Ok(files)
}

fn to_json(json: &Value, pretty: bool) -> Vec<u8> {
    let text = if pretty {
        format!("{json:#}\n")
    } else {
        json.to_string()
    };
    text.into_bytes()
}

// Warnings about the chosen UV sets.

/// Returns warnings about new UVs that are not in set 0, with the reason, and about sets that had to be filled.
fn set_warnings(
    document: &GltfDocument,
    choices: &[Option<Choice>],
    textures: &Textures,
    options: &WriteOptions,
    is_rebaked: bool,
) -> Vec<Warning> {
    let mut elsewhere: BTreeMap<u32, (BTreeSet<usize>, BTreeSet<String>)> = BTreeMap::new();
    let mut filled: BTreeMap<u32, BTreeSet<usize>> = BTreeMap::new();
    // Meshes with UVs outside set 0, and meshes whose lower sets were filled.
    for (primitive, choice) in document.primitives.iter().zip(choices) {
        let Some(choice) = choice else {
            continue;
        };
        if !choice.missing.is_empty() {
            filled.entry(choice.set).or_default().insert(primitive.mesh);
        }
        if options.texcoord.is_none() && choice.set > 0 {
            let (meshes, samplers) = elsewhere.entry(choice.set).or_default();
            meshes.insert(primitive.mesh);
            samplers.extend(samplers_of_set_0(document, choice, textures));
        }
    }
    // Say why these UVs are not in set 0, and name the sets that were filled.
    let elsewhere = elsewhere.into_iter().map(|(set, (meshes, samplers))| {
        let meshes = document::listed_meshes(document, &meshes);
        let samplers = listed(samplers.iter().map(String::as_str));
        let text = if is_rebaked {
            format!(
                "the new UVs of {meshes} are in UV set {set}, because set 0 is sampled by textures that were not resampled \
                 ({samplers}). `--overwrite` puts them on set 0, where these textures do not fit"
            )
        } else {
            format!(
                "the new UVs of {meshes} are in UV set {set}, because textures sample set 0 ({samplers}). `unwrap --rebake` \
                 resamples the textures and uses set 0; `--overwrite` uses set 0 and leaves the textures as they are"
            )
        };
        Warning::new("uvs_beside_set_0", text)
    });
    let filled = filled.into_iter().map(|(set, meshes)| {
        let meshes = document::listed_meshes(document, &meshes);
        let text = format!(
            "{meshes}: glTF requires the sets below UV set {set}, so the missing ones hold the same UVs"
        );
        Warning::new("uv_sets_filled", text)
    });
    elsewhere.chain(filled).collect()
}

/// Returns the textures that sample set 0 of a primitive.
fn samplers_of_set_0(document: &GltfDocument, choice: &Choice, textures: &Textures) -> Vec<String> {
    let of_materials = choice
        .materials
        .iter()
        .filter_map(|material| textures.get(material));
    let uses = of_materials
        .flat_map(|textures| &textures.uses)
        .chain(&choice.own.uses);
    uses.filter(|texture| texture.set == 0)
        .map(|texture| {
            let slot = texture.slot.rsplit('/').next().unwrap_or_default();
            match texture.material {
                Some(material) => {
                    format!("{slot} of {}", document::material_name(document, material))
                }
                None => slot.to_owned(),
            }
        })
        .collect()
}
