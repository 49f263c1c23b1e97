//! Judgment of a document's UVs as stored in its bytes.

use super::group_uvs::GroupUvs;
use super::report::GroupReport;
use crate::PipelineError;
use crate::options::Nodes;
use crate::options::{CommandOptions, MeasureOptions};
use rayon::prelude::*;
use std::collections::HashMap;
use unwrapd_files::document::{
    Document, DocumentError, GroupBy, Mark, Marked, Sets, Warning, Written,
};
use unwrapd_maps::certificate::{Certificate, Claims, Overlap};
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
    /// Reads what was just written. The notes name the UV set of each primitive that got UVs.
    pub fn read(written: &Written, group_by: GroupBy, nodes: Nodes) -> Result<Self, PipelineError> {
        let notes = written.notes.primitives.iter();
        let sets: HashMap<[usize; 2], u32> = notes
            .map(|note| ([note.mesh, note.primitive], note.texcoord))
            .collect();
        let document = written.read_again()?.with_mapped_faces();
        let Some(joined) = &written.notes.joined else {
            return Self::of_sets(&document, group_by, nodes, &sets);
        };
        // All primitives with new textures have one set.
        let set = sets.values().next().copied();
        let mut uvs = Self::gather(&document, group_by, nodes, |_| set)?;
        // Put the faces in the order of the document before its primitives were joined.
        for (uvs, group) in uvs.groups.iter_mut().zip(document.groups(group_by)) {
            let parts = group
                .primitives
                .iter()
                .flat_map(|&index| &joined[index].parts);
            uvs.sort_parts(parts);
        }
        Ok(uvs)
    }

    /// Gathers the UVs of a document; `sets` has the UV set of each primitive with UVs, by its mesh and its number there.
    pub fn of_sets(
        document: &Document,
        group_by: GroupBy,
        nodes: Nodes,
        sets: &HashMap<[usize; 2], u32>,
    ) -> Result<Self, PipelineError> {
        let primitives = document.primitives();
        Self::gather(document, group_by, nodes, |index| {
            let primitive = &primitives[index];
            sets.get(&[primitive.mesh, primitive.primitive]).copied()
        })
    }

    /// Moves charts beyond the first tile back by one, exactly. Textures repeat, so charts of stacks share their texels where
    /// they were a tile apart; a chart across the border of both is then outside of the pages.
    pub fn fold(&mut self) {
        for face in self.groups.iter_mut().flat_map(|group| &mut group.uvs) {
            if face.iter().any(|[u, _]| *u > 1.0) {
                *face = face.map(|[u, v]| [u - 1.0, v]);
            }
        }
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
        let n_skipped = (0..document.primitives().len())
            .filter(|primitive: &usize| set(*primitive).is_none())
            .count();
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
        let groups = || self.groups.par_iter().with_max_len(1);
        let (measured, certificates): (Vec<Option<Measures>>, Vec<Certificate>) = rayon::join(
            || {
                groups()
                    .enumerate()
                    .map(|(index, group): (usize, &GroupUvs)| {
                        (first[index] == index)
                            .then(|| group.measure(claims.v_axis, texture, raster_texels))
                    })
                    .collect()
            },
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
        self.groups
            .par_iter()
            .map(|group: &GroupUvs| group.certify(&self.told(claims)))
            .collect()
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

// Selection of the UVs to judge, and the properties to judge.

/// UVs of a document to judge, and the properties to judge.
pub struct Question {
    /// Options, with the requirements that the record adds.
    pub options: MeasureOptions,
    /// Record of the document, if it matches the UVs and the caller named no set.
    pub mark: Option<Mark>,
    /// Warning about the record.
    pub warning: Option<Warning>,
}

impl Question {
    /// Creates the question that `options` ask of a document, with the requirements that its record adds.
    pub fn new(options: &MeasureOptions, document: &Document) -> Result<Self, PipelineError> {
        let marked = match options.texcoord {
            Some(_) => Marked::Not,
            None => document.marked()?,
        };
        let mut question = Self::of_options(options);
        match marked {
            Marked::Not => {}
            Marked::Stale => question.warning = Some(stale()),
            Marked::Fits(mark) => {
                let with_terms = options.with_terms(&mark.terms);
                // A record may hold numbers that options do not allow.
                if with_terms.check().is_ok() {
                    question.options = with_terms;
                    question.mark = Some(*mark);
                } else {
                    question.warning = Some(stale());
                }
            }
        }
        Ok(question)
    }

    /// Creates the question that `options` ask of UVs without a record.
    pub fn of_options(options: &MeasureOptions) -> Self {
        Self {
            options: options.clone(),
            mark: None,
            warning: None,
        }
    }

    /// Returns the UV sets to judge, by primitive.
    pub fn sets(&self) -> Sets {
        match &self.mark {
            Some(mark) => mark.sets.clone(),
            None => Sets::One(self.options.texcoord.unwrap_or(0)),
        }
    }

    /// Returns the UV set of every primitive; `None` for one that lacks the set and is left out at the caller's
    /// request.
    ///
    /// A primitive for which the record names no set is judged, too, in the lowest set that the record names; one without
    /// that set had no UVs when the record was made, and is left out.
    pub fn set_of_each(&self, document: &Document) -> Result<Vec<Option<u32>>, DocumentError> {
        let sets = self.sets();
        let lowest = sets.lowest().unwrap_or(0);
        let set = |primitive: usize| {
            let set = sets.of(primitive).unwrap_or(lowest);
            let is_unknown = self.mark.is_some() && sets.of(primitive).is_none();
            let is_left_out = (self.options.skip_missing || is_unknown)
                && document.corner_uvs(primitive, set)?.is_none();
            Ok((!is_left_out).then_some(set))
        };
        (0..document.primitives().len()).map(set).collect()
    }

    /// Returns whether pairs of faces have to be tested, if `asked` is what the caller requests.
    pub fn overlap(&self, asked: Overlap) -> Overlap {
        let options = &self.options;
        let needs_pairs = options.padding.is_some()
            || options.bits.is_some()
            || options.pages.is_some()
            || options.aligned;
        if needs_pairs {
            Overlap::Test
        } else {
            self.promised(asked)
        }
    }

    /// Returns whether faces may overlap: not if the record promises that they do not, whatever is `asked`.
    pub fn promised(&self, asked: Overlap) -> Overlap {
        match &self.mark {
            Some(mark) if !mark.terms.overlaps => Overlap::Test,
            _ => asked,
        }
    }
}

fn stale() -> Warning {
    Warning::new(
        "mark_stale",
        "the UVs changed since unwrapd recorded its options, so the record is ignored",
    )
}
