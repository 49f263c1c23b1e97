//! Judging the UVs of a document as its bytes have them.

use rayon::prelude::*;
use serde::Serialize;

use super::PipelineError;
use super::arrays::in_pool;
use super::measure_options::MeasureOptions;
use super::nodes::Nodes;
use super::proven::Proven;
use super::report::{GroupReport, Report};
use crate::certificate::{Certificate, Claims, CornerUvs, Overlap, Resolution, certify};
use crate::document::{Document, Group, GroupBy, Primitive, Upload, Warning, Written};
use crate::measure::{self, Measures, VAxis};
use crate::numerics::vec3::{area_vector, norm};

/// Texels of all rasters together on which coverage is counted, and the least side of each: 256 groups have the finest.
const MOST_RASTER_TEXELS: u64 = 1 << 32;
const COARSEST_RASTER: u32 = 256;

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
    /// The texel density intended for each face; one for all if absent.
    pub(super) weights: Option<Vec<f64>>,
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
        let raster_texels = self.raster_texels();
        self.groups
            .par_iter()
            .map(|group| group.judge(&self.told(claims), texture, raster_texels))
            .collect()
    }

    /// The side of the raster on which the coverage of each group is counted: the rasters of many groups are coarser.
    fn raster_texels(&self) -> u32 {
        let of_each = MOST_RASTER_TEXELS / self.groups.len().max(1) as u64;
        let finest = measure::MeasureOptions::default().raster_texels;
        (1 << (of_each.max(1).ilog2() / 2)).clamp(COARSEST_RASTER, finest)
    }

    /// Certifies every group.
    fn verify(&self, claims: &Claims) -> Vec<VerifiedGroup> {
        let verified = |group: &GroupUvs| VerifiedGroup {
            name: group.name.clone(),
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

impl GroupUvs {
    fn gather(
        document: &Document,
        primitives: &[Primitive],
        group: &Group,
        set: &impl Fn(usize) -> u32,
    ) -> Result<Self, PipelineError> {
        let mut gathered = Self {
            name: group.name.clone(),
            positions: vec![],
            triangles: vec![],
            uvs: vec![],
            weights: None,
        };
        for &index in &group.primitives {
            let primitive = &primitives[index];
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

    /// The area of the surface enlarged by its weights, if it has any.
    fn intended_area(&self) -> Option<f64> {
        let area = |(t, weight): (&[u32; 3], &f64)| {
            let [a, b, c] = t.map(|v| self.positions[v as usize]);
            norm(area_vector(a, b, c)) / 2.0 * weight * weight
        };
        let weights = self.weights.as_ref()?;
        Some(self.triangles.iter().zip(weights).map(area).sum())
    }

    fn certify(&self, claims: &Claims) -> Certificate {
        certify(&self.positions, &self.triangles, &self.uvs, claims)
    }

    fn measure(&self, v_axis: VAxis, texture: Resolution, raster_texels: u32) -> Measures {
        let options = measure::MeasureOptions {
            raster_texels,
            aspect: texture.aspect(),
            weights: self.weights.as_deref(),
            ..measure::MeasureOptions::default()
        };
        measure::measure(
            &self.positions,
            &self.triangles,
            &self.uvs,
            v_axis,
            &options,
        )
    }

    fn judge(&self, claims: &Claims, texture: Resolution, raster_texels: u32) -> GroupReport {
        let (measures, certificate) = rayon::join(
            || self.measure(claims.v_axis, texture, raster_texels),
            || self.certify(claims),
        );
        let area = self.intended_area().unwrap_or(measures.size.area_3d);
        let squared = measures.size.area_uv / area;
        GroupReport {
            name: self.name.clone(),
            texels_per_unit: (area > 0.0).then(|| f64::from(texture.height) * squared.sqrt()),
            measures,
            certificate,
            defects: None,
            atlas: None,
        }
    }
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
