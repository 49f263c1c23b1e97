//! The primitives of a group as one mesh.

use super::texel_weight::face_weights;
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::arrays::seams::Seams;
use crate::arrays::soup::{Part, Soup};
use crate::options::{GivenSeams, NamedSeams, Options};
use unwrapd_files::document::{Document, Group, Primitive};
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// The primitives of a group as one mesh.
pub struct Merged {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub seams: Seams,
    /// Meshes that it was merged from.
    pub parts: Vec<Part>,
}

impl Merged {
    pub fn new(primitives: &[Primitive], group: &Group) -> Self {
        Self::of(group.primitives.iter().map(|&index| &primitives[index]))
    }

    fn of<'a>(primitives: impl Iterator<Item = &'a Primitive>) -> Self {
        let mut merged = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            seams: Seams::default(),
            parts: Vec::new(),
        };
        let mut last = None;
        for primitive in primitives {
            let first = merged.positions.len() as u32;
            let first_face = merged.triangles.len() as u32;
            let positions = primitive.positions.iter();
            (merged.positions).extend(positions.map(|p| p.map(f64::from)));
            let triangles = primitive.triangles.iter();
            merged
                .triangles
                .extend(triangles.map(|t| t.map(|v| v + first)));
            // Begin a part where the mesh changes; its primitives extend it.
            if last.replace(primitive.mesh) != Some(primitive.mesh) {
                merged.parts.push(Part {
                    vertices: first..first,
                    faces: first_face..first_face,
                });
            }
            if let Some(part) = merged.parts.last_mut() {
                part.vertices.end = merged.positions.len() as u32;
                part.faces.end = merged.triangles.len() as u32;
            }
        }
        merged
    }

    /// Merges a group and adds the seams that the options request. Seam edges must have been [checked](check_edges);
    /// `primitives` are those of the document, in any space.
    pub fn with_seams(
        document: &Document,
        primitives: &[Primitive],
        group: &Group,
        options: &Options,
        plan: &Plan,
    ) -> Result<Self, PipelineError> {
        let mut merged = Self::new(primitives, group);
        if plan.reads_uvs() {
            merged.seams.uvs = Some(corner_uvs(document, group, options.sets.source())?);
        }
        if options.material_borders {
            let labels = group.primitives.iter().flat_map(|&index| {
                let primitive = &primitives[index];
                let label = primitive.material.map_or(0, |material| 1 + material as u32);
                std::iter::repeat_n(label, primitive.triangles.len())
            });
            merged.seams.labels = Some(labels.collect());
        }
        if !options.texel_weight.is_empty() {
            let weights = face_weights(document, primitives, group, &options.texel_weight);
            merged.seams.weights = Some(weights?);
        }
        match &options.seams {
            Some(GivenSeams::Named(NamedSeams::Normals)) => {
                merged.seams.normals = Some(corner_normals(document, group)?);
            }
            Some(GivenSeams::Edges(edges)) => {
                merged.seams.edges = Some(edges_of_group(primitives, group, edges));
            }
            None => {}
        }
        Ok(merged)
    }

    pub fn soup(&self) -> Soup<'_> {
        Soup {
            positions: &self.positions,
            triangles: &self.triangles,
            seams: &self.seams,
            parts: &self.parts,
        }
    }
}

/// Returns the UVs of a group with v up.
pub fn corner_uvs(
    document: &Document,
    group: &Group,
    texcoord: u32,
) -> Result<Vec<CornerUvs>, PipelineError> {
    let mut all = Vec::new();
    for &index in &group.primitives {
        let uvs = document.corner_uvs(index, texcoord)?;
        all.extend(uvs.ok_or_else(|| PipelineError::NoUvs {
            group: group.label.clone(),
            texcoord,
        })?);
    }
    if document.v_axis() == VAxis::Down {
        for uv in all.as_flattened_mut() {
            uv[1] = 1.0 - uv[1];
        }
    }
    Ok(all)
}

fn corner_normals(document: &Document, group: &Group) -> Result<Vec<[[f64; 3]; 3]>, PipelineError> {
    let mut all = Vec::new();
    for &index in &group.primitives {
        let none = || PipelineError::Seams(format!("{} has no normals", group.label));
        all.extend(document.corner_normals(index)?.ok_or_else(none)?);
    }
    Ok(all)
}

/// Checks the edges that options name, which count vertices over all primitives.
pub fn check_edges(primitives: &[Primitive], options: &Options) -> Result<(), PipelineError> {
    let Some(GivenSeams::Edges(edges)) = &options.seams else {
        return Ok(());
    };
    let whole = Merged::of(primitives.iter());
    Seams::check_edges(edges, &whole.positions, &whole.triangles)
}

/// Selects the edges within a group from edges between vertices of the file, in the group's numbering.
fn edges_of_group(primitives: &[Primitive], group: &Group, edges: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let mut local = Vec::new();
    let mut next = 0;
    for (index, primitive) in primitives.iter().enumerate() {
        let is_inside = group.primitives.contains(&index);
        for _ in &primitive.positions {
            local.push(is_inside.then_some(next));
            next += u32::from(is_inside);
        }
    }
    let number = |v: u32| local.get(v as usize).copied().flatten();
    let inside = |&[a, b]: &[u32; 2]| Some([number(a)?, number(b)?]);
    edges.iter().filter_map(inside).collect()
}
