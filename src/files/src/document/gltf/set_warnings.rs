//! Warnings about the chosen UV sets.
use super::texcoord_set::{Choice, Textures};
use super::{GltfDocument, names};
use crate::document::warning::listed;
use crate::document::{Warning, WriteOptions};
use std::collections::{BTreeMap, BTreeSet};

/// Returns warnings about new UVs that are not in set 0, with the reason, and about sets that had to be filled.
pub(super) fn set_warnings(
    document: &GltfDocument,
    (choices, textures): (&[Option<Choice>], &Textures),
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
    let elsewhere = elsewhere.into_iter().map(|(set, (meshes, samplers))| {
        let meshes = names::of_meshes(document, &meshes);
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
        let meshes = names::of_meshes(document, &meshes);
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
                Some(material) => format!("{slot} of {}", names::of_material(document, material)),
                None => slot.to_owned(),
            }
        })
        .collect()
}
