//! UVs of a group as stored in the bytes.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;

use crate::PipelineError;
use unwrapd_files::document::{Document, Group, JoinedPart, Primitive};
use unwrapd_maps::certificate::{Certificate, Claims, certify};
use unwrapd_maps::measure::{self, Measures};
use unwrapd_maps::mesh::{CornerUvs, Resolution, VAxis};
use unwrapd_method::numerics::vec3::{area_vector, norm};

/// UVs of a group with its mesh.
#[derive(Clone, Debug)]
pub struct GroupUvs {
    pub name: String,
    pub label: String,
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub uvs: Vec<CornerUvs>,
    /// Intended texel density of each face; `None` if it is uniform.
    pub weights: Option<Vec<f64>>,
}

impl GroupUvs {
    pub fn gather(
        document: &Document,
        primitives: &[Primitive],
        group: &Group,
        set: &impl Fn(usize) -> Option<u32>,
    ) -> Result<Self, PipelineError> {
        let mut gathered = Self {
            name: group.name.clone(),
            label: group.label.clone(),
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
            let uvs = document
                .corner_uvs(index, texcoord)?
                .ok_or_else(|| no_uvs(document, index, &group.label, texcoord))?;
            // Append the primitive, with its vertices renumbered.
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

    /// Sorts the faces by the primitives that they were parts of, which now follow one another in another order.
    pub fn sort_parts<'a>(&mut self, parts: impl Iterator<Item = &'a JoinedPart>) {
        let mut first = 0;
        let mut ranges: Vec<(usize, Range<usize>)> = parts
            .map(|part| {
                let faces = first..first + part.n_faces;
                first = faces.end;
                (part.primitive, faces)
            })
            .collect();
        ranges.sort_unstable_by_key(|(primitive, _)| *primitive);
        let order = || ranges.iter().flat_map(|(_, faces)| faces.clone());
        self.triangles = order().map(|face| self.triangles[face]).collect();
        self.uvs = order().map(|face| self.uvs[face]).collect();
    }

    /// Returns the area of the surface scaled by its weights; `None` without weights.
    pub fn intended_area(&self) -> Option<f64> {
        let weights = self.weights.as_ref()?;
        Some(
            self.triangles
                .iter()
                .zip(weights)
                .map(|(t, weight): (&[u32; 3], &f64)| {
                    let [a, b, c] = t.map(|v| self.positions[v as usize]);
                    norm(area_vector(a, b, c)) / 2.0 * weight * weight
                })
                .sum(),
        )
    }

    pub fn certify(&self, claims: &Claims) -> Certificate {
        certify(&self.positions, &self.triangles, &self.uvs, claims)
    }

    /// Measures the group. `raster_texels` is the side of the raster on which coverage is counted.
    pub fn measure(&self, v_axis: VAxis, texture: Resolution, raster_texels: u32) -> Measures {
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

    /// Hashes part of the data that [`is_same`](Self::is_same) compares.
    pub fn hash(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.triangles.hash(&mut hasher);
        let uvs = self.uvs.as_flattened().as_flattened();
        for x in uvs {
            x.to_bits().hash(&mut hasher);
        }
        hasher.finish()
    }

    /// Returns whether all data except the names are equal.
    pub fn is_same(&self, other: &Self) -> bool {
        self.triangles == other.triangles
            && self.positions == other.positions
            && self.uvs == other.uvs
            && self.weights == other.weights
    }
}

/// Returns the error of a primitive if some or all of its faces lack UVs.
fn no_uvs(document: &Document, index: usize, label: &str, texcoord: u32) -> PipelineError {
    let group = label.to_owned();
    let missing = document.faces_without_uvs(index);
    match document.primitives()[index].triangles.len() {
        triangles if missing < triangles => PipelineError::PartlyNoUvs {
            group,
            texcoord,
            missing,
            triangles,
        },
        _ => PipelineError::NoUvs { group, texcoord },
    }
}
