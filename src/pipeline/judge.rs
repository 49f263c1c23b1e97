//! Judging the UVs of a document as its bytes have them.

use std::collections::HashMap;

use rayon::prelude::*;
use serde::Serialize;

use super::PipelineError;
use super::arrays::in_pool;
use super::group_uvs::GroupUvs;
use super::measure_options::MeasureOptions;
use super::nodes::Nodes;
use super::proven::Proven;
use super::report::{GroupReport, Report};
use crate::certificate::{Certificate, Claims, Overlap, Resolution};
use crate::document::{Document, GroupBy, Upload, Warning, Written};
use crate::measure::{self, Measures, VAxis};

/// Texels of all rasters together on which coverage is counted, and the least side of each: 256 groups have the finest.
const MOST_RASTER_TEXELS: u64 = 1 << 32;
const COARSEST_RASTER: u32 = 256;

/// The UVs of every group of a file with the meshes they belong to, in the numbers of the file.
#[derive(Clone, Debug)]
pub(super) struct WrittenUvs {
    pub(super) groups: Vec<GroupUvs>,
    pub(super) v_axis: VAxis,
}

impl WrittenUvs {
    /// Reads what was just written, each primitive's UVs from the set that the notes name.
    pub(super) fn read(
        written: &Written,
        (group_by, nodes): (GroupBy, Nodes),
    ) -> Result<Self, PipelineError> {
        let mut files = written.files.iter().cloned();
        let (name, bytes) = files.next().unwrap_or_default();
        let document = Document::read(&Upload {
            name,
            bytes,
            resources: files.collect(),
        })?;
        let sets: Vec<u32> = written
            .notes
            .primitives
            .iter()
            .map(|note| note.texcoord)
            .collect();
        Self::gather(&document, (group_by, nodes), |primitive| {
            sets.get(primitive).copied().unwrap_or(0)
        })
    }

    /// Gathers the UVs of a document; `set` tells the set of each primitive.
    fn gather(
        document: &Document,
        (group_by, nodes): (GroupBy, Nodes),
        set: impl Fn(usize) -> u32,
    ) -> Result<Self, PipelineError> {
        let groups = document.groups(group_by);
        let primitives = nodes.primitives(document)?;
        if groups.is_empty() {
            return Err(PipelineError::NoTriangles);
        }
        let groups = groups
            .iter()
            .map(|group| GroupUvs::gather(document, &primitives, group, &set));
        Ok(Self {
            groups: groups.collect::<Result<_, _>>()?,
            v_axis: document.v_axis(),
        })
    }

    /// Measures and certifies every group, in texels of a texture.
    pub(super) fn judge(&self, claims: &Claims, texture: Resolution) -> Vec<GroupReport> {
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
                Some(group.report(measured[first].clone()?, certificate, texture))
            })
            .collect()
    }

    /// For each group the first with the same numbers in all.
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
    fn verify(&self, claims: &Claims) -> Vec<VerifiedGroup> {
        let verified = |group: &GroupUvs| VerifiedGroup {
            name: group.name.clone(),
            label: group.label.clone(),
            certificate: group.certify(&self.told(claims)),
        };
        self.groups.par_iter().map(verified).collect()
    }

    /// The claims with what only the file tells.
    fn told(&self, claims: &Claims) -> Claims {
        Claims {
            v_axis: self.v_axis,
            ..*claims
        }
    }
}

/// The side of the raster on which the coverage of each of so many groups is counted: the rasters of many are coarser.
fn raster_texels(n_groups: usize) -> u32 {
    let of_each = MOST_RASTER_TEXELS / n_groups.max(1) as u64;
    let finest = measure::MeasureOptions::default().raster_texels;
    (1 << (of_each.max(1).ilog2() / 2)).clamp(COARSEST_RASTER, finest)
}

/// The exact judgement of a document's UVs.
#[derive(Clone, Debug, Serialize)]
pub struct Verified {
    /// What holds of all groups.
    pub proven: Proven,
    /// A certificate per group.
    pub groups: Vec<VerifiedGroup>,
}

/// The exact judgement of a group's UVs.
#[derive(Clone, Debug, Serialize)]
pub struct VerifiedGroup {
    /// `mesh0`, `mesh0/prim0`, `material0` or `scene`.
    pub name: String,
    /// What the file calls it, for people: the name of the mesh or the material, else `mesh 0` or `material 0`.
    pub label: String,
    /// What is proven of it.
    pub certificate: Certificate,
}

/// Measures the UVs that a document has.
pub fn measure_document(
    upload: &Upload,
    options: &MeasureOptions,
) -> Result<Report, PipelineError> {
    with_uvs(upload, options, |uvs, warnings| {
        let groups = uvs.judge(&options.claims(Overlap::Test), options.resolution);
        Report::new(groups, warnings.to_vec())
    })
}

/// Judges the UVs that a document has. Shares no code with the writer.
pub fn verify_document(
    upload: &Upload,
    options: &MeasureOptions,
    overlap: Overlap,
) -> Result<Verified, PipelineError> {
    with_uvs(upload, options, |uvs, _| {
        let groups = uvs.verify(&options.claims(overlap));
        Verified {
            proven: Proven::of(groups.iter().map(|group| &group.certificate)),
            groups,
        }
    })
}

/// Does something with the UVs that a document has and with its warnings, within the limits.
fn with_uvs<T: Send>(
    upload: &Upload,
    options: &MeasureOptions,
    judge: impl FnOnce(&WrittenUvs, &[Warning]) -> T + Send,
) -> Result<T, PipelineError> {
    options.check()?;
    in_pool(options.limits.threads, || {
        let document = options.nodes().prepared(Document::read(upload)?)?;
        options.limits.check(&document)?;
        let spaces = (options.group_by, options.nodes());
        let uvs = WrittenUvs::gather(&document, spaces, |_| options.texcoord)?;
        Ok(judge(&uvs, document.warnings()))
    })?
}
