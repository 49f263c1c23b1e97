//! Judgment of a document's UVs as stored in its bytes.

use std::collections::HashMap;

use rayon::prelude::*;

use super::group_uvs::GroupUvs;
use super::question::Question;
use super::report::GroupReport;
use crate::PipelineError;
use crate::documents::nodes::Nodes;
use crate::options::MeasureOptions;
use unwrapd_files::document::{Document, GroupBy, Written};
use unwrapd_maps::certificate::{Certificate, Claims};
use unwrapd_maps::measure::{self, Measures};
use unwrapd_maps::mesh::{Resolution, VAxis};

/// Maximum number of texels of all coverage rasters together, and minimum side of each. Up to 256 groups get the
/// finest raster of 4096²: 2³²/256 = 4096².
const MOST_RASTER_TEXELS: u64 = 1 << 32;
const COARSEST_RASTER: u32 = 256;

/// UVs of every group of a file with their meshes, in the numbering of the file.
#[derive(Clone, Debug)]
pub struct WrittenUvs {
    pub groups: Vec<GroupUvs>,
    /// Number of primitives left out because they have no UVs.
    pub n_skipped: usize,
    pub v_axis: VAxis,
}

impl WrittenUvs {
    /// Reads what was just written. The notes name the UV set of each primitive.
    pub fn read(written: &Written, group_by: GroupBy, nodes: Nodes) -> Result<Self, PipelineError> {
        let notes = written.notes.primitives.iter();
        let sets: Vec<u32> = notes.map(|note| note.texcoord).collect();
        Self::of_sets(&written.read_again()?, group_by, nodes, &sets)
    }

    /// Gathers the UVs of a document; `sets` names the UV set of each primitive.
    pub fn of_sets(
        document: &Document,
        group_by: GroupBy,
        nodes: Nodes,
        sets: &[u32],
    ) -> Result<Self, PipelineError> {
        Self::gather(document, group_by, nodes, |primitive| {
            Some(sets.get(primitive).copied().unwrap_or(0))
        })
    }

    /// Gathers the UVs of a document that a question is about.
    pub fn asked(document: &Document, question: &Question) -> Result<Self, PipelineError> {
        let sets = question.set_of_each(document)?;
        let (group_by, nodes) = question.options.spaces(document);
        Self::gather(document, group_by, nodes, |primitive| sets[primitive])
    }

    /// Gathers all UVs of a set, grouped as the document's materials suggest. Leaves out primitives without the set.
    pub fn of_set(document: &Document, texcoord: u32) -> Result<Self, PipelineError> {
        let question = Question::of_options(&MeasureOptions {
            texcoord: Some(texcoord),
            skip_missing: true,
            ..MeasureOptions::default()
        });
        Self::asked(document, &question)
    }

    /// Gathers the UVs of a document. `set` returns the set of each primitive, or `None` to leave it out.
    pub fn gather(
        document: &Document,
        group_by: GroupBy,
        nodes: Nodes,
        set: impl Fn(usize) -> Option<u32>,
    ) -> Result<Self, PipelineError> {
        let is_skipped = |primitive: &usize| set(*primitive).is_none();
        let n_skipped = (0..document.primitives().len()).filter(is_skipped).count();
        let mut groups = document.groups(group_by);
        for group in &mut groups {
            group.primitives.retain(|&index| set(index).is_some());
        }
        groups.retain(|group| !group.primitives.is_empty());
        let primitives = nodes.primitives(document)?;
        if groups.is_empty() {
            return Err(PipelineError::NoTriangles);
        }
        let groups = groups
            .iter()
            .map(|group| GroupUvs::gather(document, &primitives, group, &set));
        Ok(Self {
            groups: groups.collect::<Result<_, _>>()?,
            n_skipped,
            v_axis: document.v_axis(),
        })
    }

    /// Measures and certifies every group, in texels of a texture.
    pub fn judge(&self, claims: &Claims, texture: Resolution) -> Vec<GroupReport> {
        let claims = self.told(claims);
        let first = self.first_of_content();
        let n_distinct = (first.iter().enumerate())
            .filter(|&(index, &first)| index == first)
            .count();
        let raster_texels = raster_texels(n_distinct);
        let measure = |(index, group): (usize, &GroupUvs)| {
            (first[index] == index).then(|| group.measure(claims.v_axis, texture, raster_texels))
        };
        let groups = || self.groups.par_iter().with_max_len(1);
        let (measured, certificates): (Vec<Option<Measures>>, Vec<Certificate>) = rayon::join(
            || groups().enumerate().map(measure).collect(),
            || groups().map(|group| group.certify(&claims)).collect(),
        );
        (self.groups.iter().zip(&first).zip(certificates))
            .filter_map(|((group, &first), certificate)| {
                Some(GroupReport::new(
                    group,
                    measured[first].clone()?,
                    certificate,
                    texture,
                ))
            })
            .collect()
    }

    /// Returns for each group the first group with equal data.
    fn first_of_content(&self) -> Vec<usize> {
        let mut firsts: HashMap<u64, Vec<usize>> = HashMap::new();
        let number = |(index, group): (usize, &GroupUvs)| {
            let of_hash = firsts.entry(group.hash()).or_default();
            let same = of_hash
                .iter()
                .copied()
                .find(|&first| self.groups[first].is_same(group));
            same.unwrap_or_else(|| {
                of_hash.push(index);
                index
            })
        };
        self.groups.iter().enumerate().map(number).collect()
    }

    /// Certifies every group.
    pub fn certify(&self, claims: &Claims) -> Vec<Certificate> {
        let certified = |group: &GroupUvs| group.certify(&self.told(claims));
        self.groups.par_iter().map(certified).collect()
    }

    /// Completes the claims with facts from the file.
    fn told(&self, claims: &Claims) -> Claims {
        Claims {
            v_axis: self.v_axis,
            ..*claims
        }
    }
}

/// Returns the side of the coverage raster for each of `n_groups` groups: the more groups, the coarser.
fn raster_texels(n_groups: usize) -> u32 {
    let of_each = MOST_RASTER_TEXELS / n_groups.max(1) as u64;
    let finest = measure::MeasureOptions::default().raster_texels;
    (1 << (of_each.max(1).ilog2() / 2)).clamp(COARSEST_RASTER, finest)
}
