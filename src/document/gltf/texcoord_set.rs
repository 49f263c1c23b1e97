//! Which `TEXCOORD_n` the new UVs go to.
use super::GltfDocument;
use super::textures::{TextureUse, TextureUses};
use crate::document::{DocumentError, NewUvs, WriteOptions};
use std::collections::BTreeMap;

/// The largest n that may be asked for: sets have to be contiguous, so that lower ones are filled.
const MAX_SET: u32 = 15;

/// Where the UVs of one primitive go.
pub(super) struct Choice {
    pub set: u32,
    /// Lower sets that the primitive lacks and that must exist.
    pub missing: Vec<u32>,
    /// Textures that sampled the set as it was.
    pub replaced: Vec<TextureUse>,
    /// Whether the primitive had the set.
    pub had_set: bool,
}

/// What matters of a primitive here.
struct Candidate {
    present: Vec<u32>,
    textures: Vec<TextureUse>,
}

impl Candidate {
    fn is_sampled(&self, set: u32) -> bool {
        self.textures.iter().any(|texture| texture.set == set)
    }

    fn has(&self, set: u32) -> bool {
        self.present.contains(&set)
    }
}

/// One choice per primitive that gets UVs. All primitives of a mesh get the same set, so that its atlas has one name:
/// the one asked for; else set 0 where no texture samples it; else the first set that none of them has.
pub(super) fn choose(
    document: &GltfDocument,
    uvs: &NewUvs,
    options: &WriteOptions,
) -> Result<Vec<Option<Choice>>, DocumentError> {
    let mut cache = TextureUses::default();
    let mut meshes: BTreeMap<usize, Vec<(usize, Candidate)>> = BTreeMap::new();
    for (index, primitive) in document.primitives.iter().enumerate() {
        if uvs.corners[index].is_none() {
            continue;
        }
        let object = document.object(primitive)?;
        let candidate = Candidate {
            present: present_sets(object),
            textures: cache.of(&document.body.json, primitive, object)?,
        };
        meshes
            .entry(primitive.mesh)
            .or_default()
            .push((index, candidate));
    }
    let mut choices: Vec<Option<Choice>> = document.primitives.iter().map(|_| None).collect();
    for candidates in meshes.into_values() {
        let set = set_for(&candidates, options)?;
        for (index, candidate) in candidates {
            choices[index] = Some(Choice {
                set,
                missing: (0..set).filter(|lower| !candidate.has(*lower)).collect(),
                had_set: candidate.has(set),
                replaced: candidate
                    .textures
                    .into_iter()
                    .filter(|texture| texture.set == set && candidate.present.contains(&set))
                    .collect(),
            });
        }
    }
    Ok(choices)
}

fn set_for(
    candidates: &[(usize, Candidate)],
    options: &WriteOptions,
) -> Result<u32, DocumentError> {
    let all = |test: &dyn Fn(&Candidate) -> bool| candidates.iter().all(|(_, c)| test(c));
    let asked = options.texcoord.or(options.overwrite.then_some(0));
    match asked {
        Some(set) if set > MAX_SET => Err(DocumentError::LimitExceeded(format!(
            "TEXCOORD_{set}: sets go up to {MAX_SET}"
        ))),
        Some(set) if options.overwrite || all(&|c| !c.has(set) || !c.is_sampled(set)) => Ok(set),
        Some(set) => Err(DocumentError::TexcoordInUse(set)),
        None => (0..=MAX_SET)
            .find(|&set| all(&|c| !c.has(set) || set == 0 && !c.is_sampled(0)))
            .ok_or_else(|| DocumentError::LimitExceeded("no UV set is free".to_owned())),
    }
}

fn present_sets(primitive: &serde_json::Value) -> Vec<u32> {
    let attributes = primitive["attributes"].as_object();
    let names = attributes.into_iter().flat_map(serde_json::Map::keys);
    names
        .filter_map(|name| name.strip_prefix("TEXCOORD_")?.parse().ok())
        .collect()
}
