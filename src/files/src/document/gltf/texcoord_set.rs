//! Which `TEXCOORD_n` the new UVs go to.
use super::GltfDocument;
use super::textures::{MaterialTextures, SetMask, materials};
use crate::document::{BakePlan, DocumentError, Layout, Mark, NewUvs, WriteOptions};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The largest n that may be asked for: sets have to be contiguous, so that lower ones are filled.
const MAX_SET: u32 = 15;

/// Where the UVs of one primitive go.
pub(super) struct Choice {
    pub set: u32,
    /// Lower sets that the primitive lacks and that must exist, or that it has for no other reason.
    pub missing: Vec<u32>,
    /// Whether the set was written by us, as the mark of the document says.
    pub is_marked: bool,
    /// Whether the primitive had the set.
    pub had_set: bool,
    /// Whether a normal map sampled the set as it was.
    pub had_normal_map: bool,
    /// The materials of the primitive.
    pub materials: Vec<usize>,
    /// Textures of the primitive itself.
    pub own: MaterialTextures,
}

/// The textures of all materials in use, each searched once.
pub(super) type Textures = BTreeMap<usize, MaterialTextures>;

/// What matters of a primitive here.
struct Candidate {
    index: usize,
    present: SetMask,
    sampled: SetMask,
    normal_mapped: SetMask,
    materials: Vec<usize>,
    own: MaterialTextures,
    /// The set that was written before.
    marked: Option<u32>,
}

impl Candidate {
    /// Whether a set is there only because `set` is and needed it: it has the same accessor, and no texture samples it.
    fn is_filled(&self, document: &GltfDocument, lower: u32, set: u32) -> bool {
        let Ok(object) = document.object(&document.primitives[self.index]) else {
            return false;
        };
        let accessor = |set: u32| object["attributes"].get(format!("TEXCOORD_{set}"));
        !has(self.sampled, lower) && accessor(lower) == accessor(set)
    }
}

/// One choice per primitive that gets UVs. All primitives of a mesh get the same set, so that its atlas has one name:
/// the one asked for; else set 0 where no texture samples it; else the one that was written for the same purpose before, as `mark`
/// says; else the first set that none of them has. Textures of `plan` will not sample what they do; they may be shared by meshes,
/// so that all of these get the same set then.
pub(super) fn choose(
    document: &GltfDocument,
    (uvs, mark): (&NewUvs, Option<&Mark>),
    options: &WriteOptions,
    plan: Option<&BakePlan>,
) -> Result<(Vec<Option<Choice>>, Textures), DocumentError> {
    let mut textures = Textures::new();
    let mut meshes: BTreeMap<usize, Vec<Candidate>> = BTreeMap::new();
    for (index, primitive) in document.primitives.iter().enumerate() {
        if uvs.corners[index].is_some() {
            let mut candidate = candidate(document, index, plan, &mut textures)?;
            candidate.marked = mark.and_then(|mark| mark.sets.of(index));
            let together = plan.map_or(primitive.mesh, |_| 0);
            meshes.entry(together).or_default().push(candidate);
        }
    }
    let mut choices: Vec<Option<Choice>> = document.primitives.iter().map(|_| None).collect();
    for candidates in meshes.into_values() {
        let reused = reusable(&candidates, mark, options);
        let set = set_for(&candidates, uvs.layout, options, reused)?;
        for candidate in candidates {
            let had_set = has(candidate.present, set);
            let is_marked = candidate.marked == Some(set);
            let is_free = |lower: &u32| {
                !has(candidate.present, *lower)
                    || is_marked && candidate.is_filled(document, *lower, set)
            };
            choices[candidate.index] = Some(Choice {
                set,
                missing: (0..set).filter(is_free).collect(),
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
) -> Result<Candidate, DocumentError> {
    let primitive = &document.primitives[index];
    let object = document.object(primitive)?;
    let own = MaterialTextures::of_primitive(primitive, object);
    let mut candidate = Candidate {
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

/// The set that all of some primitives got before for the same purpose, and that no texture has come to sample since.
fn reusable(candidates: &[Candidate], mark: Option<&Mark>, options: &WriteOptions) -> Option<u32> {
    let (terms, present) = (options.terms.as_ref()?, &mark?.terms);
    let set = candidates.first()?.marked?;
    let is_free = |c: &Candidate| c.marked == Some(set) && !has(c.sampled, set);
    let is_same = terms.separate_nodes == present.separate_nodes;
    (is_same && candidates.iter().all(is_free)).then_some(set)
}

fn set_for(
    candidates: &[Candidate],
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
