//! Judging the UVs of a document as its bytes have them.

use rayon::prelude::*;

use super::PipelineError;
use super::nodes::Nodes;
use super::question::Question;
use super::report::GroupReport;
use crate::certificate::{Certificate, Claims, CornerUvs, Resolution, certify, chart_ids};
use crate::document::{Document, Group, GroupBy, Primitive, Written};
use crate::measure::{self, Measures, VAxis};
use crate::numerics::vec3::{area_vector, norm};

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
        let document = written.read_again()?;
        let sets: Vec<u32> = written
            .notes
            .primitives
            .iter()
            .map(|note| note.texcoord)
            .collect();
        Self::gather(&document, (group_by, nodes), |primitive| {
            Some(sets.get(primitive).copied().unwrap_or(0))
        })
    }

    /// The UVs of a document that are asked for.
    pub(super) fn asked(document: &Document, question: &Question) -> Result<Self, PipelineError> {
        Self::gather(document, question.options.spaces(), |p| question.set_of(p))
    }

    /// Some charts of a document by themselves, counted over all that is asked for.
    pub(super) fn of_charts(
        document: &Document,
        question: &Question,
        charts: &[u32],
    ) -> Result<Self, PipelineError> {
        let spaces = (GroupBy::Scene, Nodes::Shared);
        let whole = Self::gather(document, spaces, |p| question.set_of(p))?;
        let groups = whole.groups.iter().flat_map(|group| group.charts(charts));
        Ok(Self {
            groups: groups.collect(),
            v_axis: whole.v_axis,
        })
    }

    /// Gathers the UVs of a document; `set` tells the set of each primitive that takes part.
    pub(super) fn gather(
        document: &Document,
        (group_by, nodes): (GroupBy, Nodes),
        set: impl Fn(usize) -> Option<u32>,
    ) -> Result<Self, PipelineError> {
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
            v_axis: document.v_axis(),
        })
    }

    /// Measures and certifies every group, in texels of a texture.
    pub(super) fn judge(&self, claims: &Claims, texture: Resolution) -> Vec<GroupReport> {
        self.groups
            .par_iter()
            .map(|group| group.judge(&self.told(claims), texture))
            .collect()
    }

    /// Certifies every group, by its name.
    pub(super) fn certify(&self, claims: &Claims) -> Vec<(String, Certificate)> {
        let certified = |group: &GroupUvs| (group.name.clone(), group.certify(&self.told(claims)));
        self.groups.par_iter().map(certified).collect()
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
        set: &impl Fn(usize) -> Option<u32>,
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
            let Some(texcoord) = set(index) else {
                continue;
            };
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

    /// Some of its charts, each as a group.
    fn charts(&self, numbers: &[u32]) -> Vec<Self> {
        let of_face = chart_ids(&self.positions, &self.triangles, &self.uvs);
        let chart = |&number: &u32| {
            let faces = || (0..of_face.len()).filter(|&face| of_face[face] == number);
            Self {
                name: format!("chart{number}"),
                positions: self.positions.clone(),
                triangles: faces().map(|face| self.triangles[face]).collect(),
                uvs: faces().map(|face| self.uvs[face]).collect(),
                weights: None,
            }
        };
        numbers.iter().map(chart).collect()
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

    fn measure(&self, v_axis: VAxis, texture: Resolution) -> Measures {
        let options = measure::MeasureOptions {
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

    fn judge(&self, claims: &Claims, texture: Resolution) -> GroupReport {
        let (measures, certificate) = rayon::join(
            || self.measure(claims.v_axis, texture),
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
