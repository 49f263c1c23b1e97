//! Effects of rules for islands, measured on the written bytes.

use super::group_uvs::GroupUvs;
use crate::Seams;
use crate::arrays::control::FaceRules;
use crate::arrays::plan::{Plan, Start};
use serde::Serialize;
use std::collections::BTreeMap;
use unwrapd_maps::certificate::chart_ids;
use unwrapd_maps::mesh::{CornerUvs, Resolution};
use unwrapd_method::numerics::vec2::doubled_area;
use unwrapd_method::numerics::vec3::{area_vector, norm};

/// Relative difference of texel densities from which on an island counts as changed: the accuracy to which rules are
/// kept. Rounding to the grid changes the area of an island of a hundred texels by less.
const CHANGED: f64 = 1e-3;

/// Effect of a rule for islands in one atlas.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RuleReport {
    /// The rule.
    pub rule: String,
    /// Islands of the result that it selects.
    pub islands: usize,
    /// Their mean number of texels per unit of length of the mesh; null if they have no area.
    pub texels_per_unit: Option<f64>,
    /// Those of a rule about density or scale whose texel density is another one than in the input, by more than 0.1 %;
    /// absent for other rules and for new charts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changed: Option<Vec<ChangedIsland>>,
}

/// An island with another texel density than in the input.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ChangedIsland {
    /// Its first face, counted over the atlas.
    pub face: u32,
    /// Texels per unit of length of the mesh in the input; null without area.
    pub before: Option<f64>,
    /// Texels per unit of length of the mesh now; null without area.
    pub now: Option<f64>,
}

/// FaceAreas of some faces: on the surface, and in UV.
#[derive(Clone, Copy, Default)]
struct FaceAreas {
    surface: f64,
    uv: f64,
}

impl FaceAreas {
    fn add(&mut self, uvs: &GroupUvs, corners: &CornerUvs, face: usize) {
        let [a, b, c] = *corners;
        self.uv += doubled_area(a, b, c).abs() / 2.0;
        let [a, b, c] = uvs.triangles[face].map(|v| uvs.positions[v as usize]);
        self.surface += norm(area_vector(a, b, c)) / 2.0;
    }

    /// Returns the number of texels per unit of length; `None` without area.
    fn density(&self, texture: Resolution) -> Option<f64> {
        let texels = f64::from(texture.width) * f64::from(texture.height);
        let density = (texels * self.uv / self.surface).sqrt();
        density.is_normal().then_some(density)
    }
}

/// Measures the effect of each rule on the UVs of a group, whose seams were made from its input.
pub fn rule_reports(seams: &Seams, uvs: &GroupUvs, texture: Resolution) -> Vec<RuleReport> {
    let Some(control) = &seams.control else {
        return Vec::new();
    };
    let now = chart_ids(&uvs.positions, &uvs.triangles, &uvs.uvs);
    let before = (seams.uvs.as_ref()).map(|given| {
        let islands = chart_ids(&uvs.positions, &uvs.triangles, given);
        (given, islands)
    });
    let reports = control.selected.iter().map(|(rule, faces)| {
        let mut all = FaceAreas::default();
        let mut islands: BTreeMap<u32, (u32, [FaceAreas; 2])> = BTreeMap::new();
        let mut charts: Vec<u32> = Vec::with_capacity(faces.len());
        for &number in faces {
            let face = number as usize;
            all.add(uvs, &uvs.uvs[face], face);
            charts.push(now[face]);
            if let Some((given, of_face)) = &before {
                let (_, areas) = islands
                    .entry(of_face[face])
                    .or_insert((number, Default::default()));
                areas[0].add(uvs, &given[face], face);
                areas[1].add(uvs, &uvs.uvs[face], face);
            }
        }
        charts.sort_unstable();
        charts.dedup();
        let changed = islands.into_values().filter_map(|(face, areas)| {
            let [before, now] = areas.map(|areas| areas.density(texture));
            let is_same = match before.zip(now) {
                Some((before, now)) => (now / before - 1.0).abs() <= CHANGED,
                None => before == now,
            };
            (!is_same).then_some(ChangedIsland { face, before, now })
        });
        let is_about_size = rule.contains(": density ") || rule.contains(": scale ");
        RuleReport {
            rule: rule.clone(),
            islands: charts.len(),
            texels_per_unit: all.density(texture),
            changed: (is_about_size && before.is_some()).then(|| changed.collect()),
        }
    });
    reports.collect()
}

/// Returns the intended texel density of each face of a written group: the weights, and for new maps the densities that
/// rules set, which are taken from the result. `None` if all are 1.
pub fn intended_weights(seams: &Seams, uvs: &GroupUvs, plan: &Plan) -> Option<Vec<f64>> {
    let weights = seams.weights.clone();
    let control = seams.control.as_ref();
    let sized = control.filter(|control| control.rules.iter().any(FaceRules::is_sized));
    let Some(control) = sized.filter(|_| plan.start != Start::Final) else {
        return weights;
    };
    let mut weights = weights.unwrap_or_else(|| vec![1.0; uvs.triangles.len()]);
    // The others have one density; if there are none, those of the first rules have weight 1.
    let of = |face: usize| {
        let rules = control.of_face[face];
        if control.rules[rules as usize].is_sized() {
            rules
        } else {
            0
        }
    };
    let mut areas: BTreeMap<u32, FaceAreas> = BTreeMap::new();
    for (face, weight) in weights.iter().enumerate() {
        let mut own = FaceAreas::default();
        own.add(uvs, &uvs.uvs[face], face);
        let sum = areas.entry(of(face)).or_default();
        sum.uv += own.uv;
        sum.surface += weight * weight * own.surface;
    }
    let density = |areas: &FaceAreas| (areas.uv / areas.surface).sqrt();
    let reference = areas.values().next().map_or(1.0, density);
    for (face, weight) in weights.iter_mut().enumerate() {
        let factor = density(&areas[&of(face)]) / reference;
        if factor.is_normal() {
            *weight *= factor;
        }
    }
    Some(weights)
}
