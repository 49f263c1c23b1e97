//! Choice of the `TEXCOORD_n` for new UVs.
use super::document::GltfDocument;
use super::textures::{MaterialTextures, SetMask, materials};
use crate::document::{BakePlan, DocumentError, Layout, Mark, NewUvs, WriteOptions};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Largest n that may be requested: sets must be contiguous, so lower ones are filled.
const MAX_SET: u32 = 15;

/// Destination of the UVs of one primitive.
pub(super) struct Choice {
    pub set: u32,
    /// Lower sets that the primitive lacks and that must exist, or that exist only for this reason.
    pub missing: Vec<u32>,
    /// `true` if this program wrote the set before, according to the mark of the document.
    pub is_marked: bool,
    /// `true` if the primitive had the set.
    pub had_set: bool,
    /// `true` if a normal map sampled the old set.
    pub had_normal_map: bool,
    /// Materials of the primitive.
    pub materials: Vec<usize>,
    /// Textures of the primitive itself.
    pub own: MaterialTextures,
}

/// Textures of all materials in use, each searched once.
pub(super) type Textures = BTreeMap<usize, MaterialTextures>;

/// Properties of a primitive that affect the choice.
struct SetCandidate {
    index: usize,
    present: SetMask,
    sampled: SetMask,
    normal_mapped: SetMask,
    materials: Vec<usize>,
    own: MaterialTextures,
    /// The set that was written before.
    marked: Option<u32>,
}

impl SetCandidate {
    /// Returns whether a set exists only because `set` needed it: it has the same accessor, and no texture samples it.
    fn is_filled(&self, document: &GltfDocument, lower: u32, set: u32) -> bool {
        let Ok(object) = document.object(&document.primitives[self.index]) else {
            return false;
        };
        let accessor = |set: u32| object["attributes"].get(format!("TEXCOORD_{set}"));
        !has(self.sampled, lower) && accessor(lower) == accessor(set)
    }
}

/// Chooses a set for each primitive that gets UVs. All primitives of a mesh get the same set, so that its atlas has one
/// name: the requested one; else set 0 if no texture samples it; else the one that was written for the same purpose
/// before, according to `mark`; else the first set that none has. Textures of `plan` will sample the new set; as meshes
/// may share them, all of these then get the same set.
pub(super) fn choose(
    document: &GltfDocument,
    uvs: &NewUvs,
    mark: Option<&Mark>,
    options: &WriteOptions,
    plan: Option<&BakePlan>,
) -> Result<(Vec<Option<Choice>>, Textures), DocumentError> {
    // Group the primitives by mesh or, if textures are made for them, all together.
    let mut textures = Textures::new();
    let mut meshes: BTreeMap<usize, Vec<SetCandidate>> = BTreeMap::new();
    for (index, primitive) in document.primitives.iter().enumerate() {
        if uvs.corners[index].is_some() {
            let mut candidate = candidate(document, index, plan, &mut textures)?;
            candidate.marked = mark.and_then(|mark| mark.sets.of(index));
            let together = plan.map_or(primitive.mesh, |_| 0);
            meshes.entry(together).or_default().push(candidate);
        }
    }
    let mut choices: Vec<Option<Choice>> = document.primitives.iter().map(|_| None).collect();
    // Choose one set for each group.
    for candidates in meshes.into_values() {
        let reused = reusable(&candidates, mark, options);
        let set = set_for(&candidates, uvs.layout, options, reused)?;
        for candidate in candidates {
            let had_set = has(candidate.present, set);
            let is_marked = candidate.marked == Some(set);
            choices[candidate.index] = Some(Choice {
                set,
                missing: (0..set)
                    .filter(|lower: &u32| {
                        !has(candidate.present, *lower)
                            || is_marked && candidate.is_filled(document, *lower, set)
                    })
                    .collect(),
                is_marked,
                had_set,
                had_normal_map: had_set && has(candidate.normal_mapped, set),
                materials: candidate.materials,
                own: candidate.own,
            });
        }
    }
    Ok((choices, textures))
}

fn candidate(
    document: &GltfDocument,
    index: usize,
    plan: Option<&BakePlan>,
    textures: &mut Textures,
) -> Result<SetCandidate, DocumentError> {
    let primitive = &document.primitives[index];
    let object = document.object(primitive)?;
    let own = MaterialTextures::of_primitive(primitive, object);
    let mut candidate = SetCandidate {
        index,
        present: present_sets(object),
        sampled: own.sampled,
        normal_mapped: own.normal_mapped,
        materials: materials(primitive.material, object)?,
        own,
        marked: None,
    };
    for &material in &candidate.materials {
        let found = textures.entry(material).or_insert_with(|| {
            let found = MaterialTextures::of_material(&document.body.json, material);
            plan.map_or_else(|| found.clone(), |plan| found.without(&plan.replaced))
        });
        candidate.sampled |= found.sampled;
        candidate.normal_mapped |= found.normal_mapped;
    }
    Ok(candidate)
}

/// Returns the set that all of these primitives got before for the same purpose, if no texture samples it by now.
fn reusable(
    candidates: &[SetCandidate],
    mark: Option<&Mark>,
    options: &WriteOptions,
) -> Option<u32> {
    let (terms, present) = (options.terms.as_ref()?, &mark?.terms);
    let set = candidates.first()?.marked?;
    let is_same = terms.separate_nodes == present.separate_nodes;
    (is_same
        && candidates
            .iter()
            .all(|c: &SetCandidate| c.marked == Some(set) && !has(c.sampled, set)))
    .then_some(set)
}

fn set_for(
    candidates: &[SetCandidate],
    layout: Layout,
    options: &WriteOptions,
    reused: Option<u32>,
) -> Result<u32, DocumentError> {
    let overwrite = options.overwrite || layout == Layout::Edited;
    let present = candidates.iter().fold(0, |mask, c| mask | c.present);
    let in_use = candidates
        .iter()
        .fold(0, |mask, c| mask | (c.present & c.sampled));
    match options.texcoord.or(overwrite.then_some(0)) {
        Some(set) if set > MAX_SET => Err(DocumentError::LimitExceeded(format!(
            "TEXCOORD_{set} exceeds the last set, {MAX_SET}"
        ))),
        Some(set) if overwrite || !has(in_use, set) => Ok(set),
        Some(set) => Err(DocumentError::TexcoordInUse(set)),
        None if !has(in_use, 0) => Ok(0),
        None => reused
            .or_else(|| (1..=MAX_SET).find(|set| !has(present, *set)))
            .ok_or_else(|| DocumentError::LimitExceeded("no UV set is free".to_owned())),
    }
}

fn has(mask: SetMask, set: u32) -> bool {
    mask.checked_shr(set).unwrap_or(0) & 1 == 1
}

fn present_sets(primitive: &Value) -> SetMask {
    let attributes = primitive["attributes"].as_object();
    let names = attributes.into_iter().flat_map(Map::keys);
    let sets = names.filter_map(|name| name.strip_prefix("TEXCOORD_")?.parse().ok());
    sets.fold(0, |mask, set| mask | 1u32.checked_shl(set).unwrap_or(0))
}
