//! Judging the UVs of a document as its bytes have them.

use rayon::prelude::*;

use super::PipelineError;
use super::arrays::in_pool;
use super::options::MeasureOptions;
use super::report::{GroupReport, Report};
use crate::certificate::{Certificate, CornerUvs, Overlap, certify};
use crate::document::{Document, Group, GroupBy, Upload, Written};
use crate::measure::{self, Measures, VAxis};

/// The UVs of every group of a file with the meshes they belong to, in the numbers of the file.
#[derive(Clone, Debug)]
pub(super) struct WrittenUvs {
    pub(super) groups: Vec<GroupUvs>,
    pub(super) v_axis: VAxis,
}

/// The UVs of one group with its mesh.
#[derive(Clone, Debug)]
pub(super) struct GroupUvs {
    pub(super) name: String,
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) uvs: Vec<CornerUvs>,
}

impl WrittenUvs {
    /// Reads what was just written, each primitive's UVs from the set that the notes name.
    pub(super) fn read(written: &Written, group_by: GroupBy) -> Result<Self, PipelineError> {
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
        Self::gather(&document, group_by, |primitive| {
            sets.get(primitive).copied().unwrap_or(0)
        })
    }

    /// Gathers the UVs of a document; `set` tells the set of each primitive.
    fn gather(
        document: &Document,
        group_by: GroupBy,
        set: impl Fn(usize) -> u32,
    ) -> Result<Self, PipelineError> {
        let groups = document.groups(group_by);
        if groups.is_empty() {
            return Err(PipelineError::NoTriangles);
        }
        let groups = groups
            .iter()
            .map(|group| GroupUvs::gather(document, group, &set));
        Ok(Self {
            groups: groups.collect::<Result<_, _>>()?,
            v_axis: document.v_axis(),
        })
    }

    /// Measures and certifies every group.
    pub(super) fn judge(&self) -> Vec<GroupReport> {
        self.groups
            .par_iter()
            .map(|group| group.judge(self.v_axis))
            .collect()
    }
}

impl GroupUvs {
    fn gather(
        document: &Document,
        group: &Group,
        set: &impl Fn(usize) -> u32,
    ) -> Result<Self, PipelineError> {
        let mut gathered = Self {
            name: group.name.clone(),
            positions: vec![],
            triangles: vec![],
            uvs: vec![],
        };
        for &index in &group.primitives {
            let primitive = &document.primitives()[index];
            let texcoord = set(index);
            let uvs =
                document
                    .corner_uvs(index, texcoord)?
                    .ok_or_else(|| PipelineError::NoUvs {
                        group: group.name.clone(),
                        texcoord,
                    })?;
            let first = gathered.positions.len() as u32;
            gathered
                .positions
                .extend(primitive.positions.iter().map(|p| p.map(f64::from)));
            gathered
                .triangles
                .extend(primitive.triangles.iter().map(|t| t.map(|v| v + first)));
            gathered.uvs.extend(uvs);
        }
        Ok(gathered)
    }

    fn certify(&self, overlap: Overlap) -> Certificate {
        certify(&self.positions, &self.triangles, &self.uvs, overlap)
    }

    fn measure(&self, v_axis: VAxis) -> Measures {
        let options = measure::MeasureOptions::default();
        measure::measure(
            &self.positions,
            &self.triangles,
            &self.uvs,
            v_axis,
            &options,
        )
    }

    fn judge(&self, v_axis: VAxis) -> GroupReport {
        let (measures, certificate) =
            rayon::join(|| self.measure(v_axis), || self.certify(Overlap::Test));
        GroupReport {
            name: self.name.clone(),
            measures,
            certificate,
            defects: None,
            atlas: None,
        }
    }
}

/// Measures the UVs that a document has.
pub fn measure_document(
    upload: &Upload,
    options: &MeasureOptions,
) -> Result<Report, PipelineError> {
    with_uvs(upload, options, |uvs| Report::new(uvs.judge()))
}

/// Judges the UVs that a document has: a certificate per group, by name. Shares no code with the writer.
pub fn verify_document(
    upload: &Upload,
    options: &MeasureOptions,
    overlap: Overlap,
) -> Result<Vec<(String, Certificate)>, PipelineError> {
    with_uvs(upload, options, |uvs| {
        uvs.groups
            .par_iter()
            .map(|group| (group.name.clone(), group.certify(overlap)))
            .collect()
    })
}

/// Does something with the UVs that a document has, within the limits.
fn with_uvs<T: Send>(
    upload: &Upload,
    options: &MeasureOptions,
    judge: impl FnOnce(&WrittenUvs) -> T + Send,
) -> Result<T, PipelineError> {
    in_pool(options.limits.threads, || {
        let document = Document::read(upload)?;
        options.limits.check(&document)?;
        let uvs = WrittenUvs::gather(&document, options.group_by, |_| options.texcoord)?;
        Ok(judge(&uvs))
    })?
}
